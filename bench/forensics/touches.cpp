#include "bench/forensics/touches.hpp"

#include "core/contact.hpp"

namespace broadside::bench {
namespace {

using core::bit;
using core::Group;

}  // namespace

std::uint32_t Touches::groups_read(std::uint32_t groups) {
  for (const Group group : {Group::kContacts, Group::kPoints, Group::kPairs})
    if ((groups & bit(group)) != 0) return bit(group);
  return 0;
}

void Touches::touch(std::uint32_t body, std::uint64_t step) {
  if (core::is_face(body) || is_touched_[body] != 0) return;
  is_touched_[body] = 1;
  ++count_;
  if (first_ == 0) first_ = step;
}

void Touches::note(const core::FrameRecord& frame, std::uint32_t groups, const validation::Motion* motion) {
  const std::uint32_t read = groups_read(groups);
  if (read == bit(Group::kContacts)) {
    for (const core::Contact& c : frame.contacts) touch(c.a, frame.step), touch(c.b, frame.step);
  } else if (read == bit(Group::kPoints)) {
    for (const core::ContactPoint& p : frame.points)
      if (p.gap_m <= 0.0F || !(p.impulse == core::Vec3{})) touch(p.a, frame.step), touch(p.b, frame.step);
  } else if (read == bit(Group::kPairs)) {
    for (const core::Pair p : frame.pairs) touch(p.i, frame.step), touch(p.j, frame.step);
  }
  // Without contacts or points the trace does not say which bodies met a face: only the motion of their boxes can.
  if (motion == nullptr || read == bit(Group::kContacts) || read == bit(Group::kPoints)) return;
  for (std::uint32_t i = 0; i < motion->bodies.size(); ++i)
    if (motion->facts[i].is_dynamic && !motion->bodies[i].is_alone) touch(i, frame.step);
}

}  // namespace broadside::bench
