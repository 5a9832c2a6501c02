#include "reference/octree_cpu/rigid/push_stage.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/method/rigid/pushed_motion.hpp"

namespace broadside::reference {

using core::Pair;

namespace {

void raise(core::PushWord& push, core::PushWord to) {
  if (to == 0) return;
  const std::atomic_ref<core::PushWord> shared(push);
  core::PushWord now = shared.load(std::memory_order_relaxed);
  while (now < to && !shared.compare_exchange_weak(now, to, std::memory_order_relaxed)) {
  }
}

void raise_both(const core::RigidBodies& bodies, Pair pair, const core::Pusher& a, const core::Pusher& b,
                std::vector<core::PushWord>& pushes) {
  const float restitution = std::max(bodies.material[pair.i].restitution, bodies.material[pair.j].restitution);
  raise(pushes[pair.i], core::push_by(a, b, restitution));
  raise(pushes[pair.j], core::push_by(b, a, restitution));
}

core::Pusher told_pusher(const core::RigidBodies& bodies, std::uint32_t body) {
  const core::PushWord push = bodies.push[body];
  return core::told_of(bodies.pusher(body), push, bodies.drift[core::pusher_of(push)]);
}

}  // namespace

void note_pushes(core::RigidBodies& bodies, Pair pair) {
  raise_both(bodies, pair, bodies.pusher(pair.i), bodies.pusher(pair.j), bodies.push);
}

void pass_on_pushes(core::RigidBodies& bodies, std::span<const Pair> confirmed) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, confirmed.size(), 256), [&](const auto& range) {
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      const Pair pair = confirmed[k];
      raise_both(bodies, pair, told_pusher(bodies, pair.i), told_pusher(bodies, pair.j), bodies.passed_on);
    }
  });
}

}  // namespace broadside::reference
