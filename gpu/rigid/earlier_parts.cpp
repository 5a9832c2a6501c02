#include "gpu/rigid/earlier_parts.hpp"

#include <utility>

#include "core/method/rigid/step_in_parts.hpp"

namespace broadside::gpu {

core::Status EarlierParts::keep(const RigidLeft& part, StreamHandle stream) {
  if (count_ == parts_.size()) parts_.push_back(std::make_unique<Part>());
  Part& kept = *parts_[count_];
  const std::size_t n = part.bodies.state.size();
  BROADSIDE_TRY(kept.state.copy(part.state, n, stream, "parts"));
  BROADSIDE_TRY(kept.detected.copy(part.detected, n, stream, "parts"));
  BROADSIDE_TRY(kept.boxes.copy(part.boxes, n, stream, "parts"));
  BROADSIDE_TRY(kept.pairs.copy(part.pairs, part.pair_count, stream, "parts"));
  BROADSIDE_TRY(kept.confirmed.copy(part.confirmed, part.counts.confirmed, stream, "parts"));
  BROADSIDE_TRY(kept.patches.copy(part.patches, part.counts.patches, stream, "parts"));
  BROADSIDE_TRY(kept.impulses.copy(part.impulses, 4 * part.counts.patches, stream, "parts"));
  kept.pair_count = part.pair_count;
  kept.counts = part.counts;
  ++count_;
  return core::Done{};
}

core::Status EarlierParts::join(const core::RigidBodies& bodies, core::FrameRecord& last,
                                core::RecordLevel level) const {
  core::StepInParts step;
  for (std::size_t k = 0; k < count_; ++k) {
    const Part& p = *parts_[k];
    core::FrameRecord part;
    BROADSIDE_TRY(read_back_rigid(
        {bodies, p.state, p.detected, p.boxes, p.pairs, p.confirmed, p.patches, p.impulses, p.pair_count, p.counts},
        part));
    step.add(std::move(part));
  }
  step.join(last, level);
  return core::Done{};
}

std::uint64_t EarlierParts::bytes() const {
  std::uint64_t sum = 0;
  for (const auto& p : parts_)
    sum += p->state.bytes() + p->detected.bytes() + p->boxes.bytes() + p->pairs.bytes() + p->confirmed.bytes() +
           p->patches.bytes() + p->impulses.bytes();
  return sum;
}

}  // namespace broadside::gpu
