#include "bench/python/native/frame_digest_of.hpp"

#include "bench/record/near_pairs.hpp"
#include "core/method/frame_digest.hpp"

namespace broadside::bench::python {
namespace {

std::uint64_t digest_of_states(const core::FrameRecord& f) {
  std::uint64_t sum = 0;
  for (std::uint32_t i = 0; i < f.position.size(); ++i)
    sum += core::body_digest(i, f.position[i], f.orientation[i], f.velocity[i], f.angular_velocity[i]);
  for (const core::Pair pair : f.confirmed) sum += core::confirmed_digest(pair);
  for (const core::Contact& contact : f.contacts) sum += core::contact_digest(contact);
  return sum;
}

}  // namespace

std::uint64_t digest_of(const core::FrameRecord& frame, std::uint32_t groups) {
  const auto has = [groups](core::Group g) { return (groups & core::bit(g)) != 0U; };
  if (has(core::Group::kBodies)) return digest_of_states(frame);
  if (has(core::Group::kNarrow)) return separation_digest(frame);
  return has(core::Group::kPairs) ? core::pair_digest(frame.pairs) : 0;
}

}  // namespace broadside::bench::python
