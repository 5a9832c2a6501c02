// How far bodies may push each other in the next step: pushes are noted along candidate pairs, and passed on along
// confirmed pairs.
#pragma once

#include <cstdint>

#include "core/method/rigid/pushed_motion.hpp"
#include "core/pair.hpp"
#include "gpu/rigid/contact_view.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

__device__ inline core::Pusher pusher_of(const ContactView& f, std::uint32_t body) {
  const PackedPusher p = f.pushers[body];
  return {f.before[body].x,           p.drift.v, p.pushed.v, p.drift.w, f.mass[body].inverse_mass, body,
          __float_as_uint(p.pushed.w)};
}

__device__ inline void raise_both(const ContactView& f, core::Pair pair, const core::Pusher& a, const core::Pusher& b,
                                  unsigned long long* pushes) {
  const float restitution = max(f.material[pair.i].restitution, f.material[pair.j].restitution);
  if (const unsigned long long push = core::push_by(a, b, restitution); push != 0) atomicMax(&pushes[pair.i], push);
  if (const unsigned long long push = core::push_by(b, a, restitution); push != 0) atomicMax(&pushes[pair.j], push);
}

// Notes how far the bodies of a candidate pair may push each other in the next step.
__device__ inline void note_pushes(const ContactView& f, core::Pair pair) {
  raise_both(f, pair, pusher_of(f, pair.i), pusher_of(f, pair.j), f.push);
}

__device__ inline core::Pusher told_pusher(const ContactView& f, std::uint32_t body) {
  const core::PushWord push = f.push[body];
  return core::told_of(pusher_of(f, body), push, f.pushers[core::pusher_of(push)].drift.v);
}

// Notes the pushes that a confirmed pair passes on. Call after note_pushes of all candidates and a barrier.
__device__ inline void pass_on_pushes(const ContactView& f, core::Pair pair) {
  raise_both(f, pair, told_pusher(f, pair.i), told_pusher(f, pair.j), f.passed_on);
}

}  // namespace broadside::gpu
