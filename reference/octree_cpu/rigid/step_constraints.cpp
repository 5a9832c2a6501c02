#include "reference/octree_cpu/rigid/step_constraints.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>

#include "core/contact.hpp"
#include "core/math/order_free_sum.hpp"
#include "core/method/rigid/conjugate_directions.hpp"
#include "core/method/rigid/kept_blows.hpp"
#include "core/method/rigid/unpushed_body.hpp"

namespace broadside::reference {

using core::PatchConstraint;
using core::PatchPoint;
using core::SolverBody;

namespace {

float largest_of(std::span<const float> values) {
  return values.empty() ? 0.0F : *std::max_element(values.begin(), values.end());
}

}  // namespace

// Sets the impulses to those that these two bodies gave each other in the last substep of the step before (warm start).
void StepConstraints::recall(const core::ContactPatch& patch, PatchConstraint& c) const {
  const auto remembered = memory_.of(patch.a, patch.b);
  for (int k = 0; k < c.count; ++k) {
    PatchPoint& p = c.points[k];
    const auto same = std::find_if(remembered.begin(), remembered.end(), [&](const RememberedPoint& r) {
      return r.feature == patch.manifold.points[k].feature;
    });
    if (same == remembered.end()) continue;
    p.normal_impulse = substep_s_ * same->normal_n;
    p.tangent_impulse_1 = substep_s_ * core::dot(same->friction_n, c.tangent_1);
    p.tangent_impulse_2 = substep_s_ * core::dot(same->friction_n, c.tangent_2);
  }
}

// Returns the patches that are to be solved. For the others, those of sleeping bodies, stores the impulses that they
// keep.
std::span<const core::ContactPatch> StepConstraints::awake_of(std::span<const core::ContactPatch> patches,
                                                              const RigidStep& step) {
  const std::span<const std::uint8_t> asleep = step.asleep;
  awake_patches_.clear();
  awake_.clear();
  asleep_.clear();
  if (std::find(asleep.begin(), asleep.end(), 1) == asleep.end()) return patches;
  for (std::uint32_t k = 0; k < patches.size(); ++k) {
    const core::ContactPatch& patch = patches[k];
    // The index of this patch among those of its pair. It was the same when the patch was remembered.
    std::uint32_t nth = 0;
    while (nth < k && patches[k - nth - 1].a == patch.a && patches[k - nth - 1].b == patch.b) ++nth;
    const bool is_awake = asleep[patch.a] == 0 && (core::is_face(patch.b) || asleep[patch.b] == 0);
    const std::uint32_t last = is_awake ? 0 : memory_.index_of(patch.a, patch.b) + nth;
    // A patch that is not remembered is solved, against a body that does not move.
    if (is_awake || !memory_.has_patch(last, patch.a, patch.b)) {
      awake_.push_back(k);
      awake_patches_.push_back(patch);
      continue;
    }
    AsleepPatch kept{k, impulses_[last], {}};
    for (core::Vec3& impulse : kept.given) impulse = step.asleep_share * impulse;
    const auto points = memory_.of_patch(last);
    std::copy(points.begin(), points.end(), kept.remembered.begin());
    asleep_.push_back(kept);
  }
  return awake_patches_;
}

void StepConstraints::begin(std::span<const core::RigidState> states, std::span<const core::ContactPatch> given,
                            const RigidStep& step, const core::SoftStep& numbers, const core::PatchLimits& limits) {
  substep_s_ = numbers.dt_s;
  bodies_.resize(states.size() + 1);
  bodies_.back() = {};
  const auto is_asleep = [&](std::size_t i) { return !step.asleep.empty() && step.asleep[i] != 0; };
  each_body([&](std::size_t i) {
    bodies_[i] = is_asleep(i) ? core::SolverBody{} : core::solver_body(states[i], step.masses[i]);
  });
  const std::span<const core::ContactPatch> patches = awake_of(given, step);
  stirred_.assign(bodies_.size(), 0);
  sweep_ = 0;
  coloring_.color(patches, step.masses);
  const auto faces = static_cast<std::uint32_t>(states.size());
  tiles_.arrange(patches, coloring_, faces);
  touched_.resize(tiles_.places());
  came_fast_.assign(tiles_.places(), 0);
  in_parallel(0, tiles_.count(), [&](std::size_t tile) {
    tiles_.clear_tile(tile);
    for (std::size_t place = tile * kTileLanes; place < (tile + 1) * kTileLanes; ++place) {
      touched_[place] = {faces, faces};
      if (tiles_.patch_at()[place] == PatchTiles::kNoPatch) continue;
      const core::ContactPatch& patch = patches[tiles_.patch_at()[place]];
      const bool is_face = core::is_face(patch.b);
      const std::uint32_t b = is_face ? faces : patch.b;
      const core::Material surface =
          core::combine(step.materials[patch.a], is_face ? step.face_material : step.materials[patch.b]);
      const core::Vec3 across = is_face ? core::Vec3{} : states[patch.b].x - states[patch.a].x;
      PatchConstraint c = core::make_constraint(patch.manifold, bodies_[patch.a], bodies_[b], across, surface);
      c.a = patch.a;
      c.b = b;
      core::set_limits(c, bodies_[c.a], bodies_[c.b], limits, step.dt_s);
      recall(patch, c);
      came_fast_[place] = core::note_approach(c, bodies_[c.a], bodies_[c.b], numbers) ? 1 : 0;
      tiles_.put(place, c);
      touched_[place] = {c.a, c.b};
    }
  });
  list_fast();
}

void StepConstraints::finish(std::span<core::RigidState> states, std::span<const core::ContactPatch> patches,
                             const RigidStep& step, std::uint32_t substeps) {
  is_pushed_body_.assign(bodies_.size(), 0);
  memory_.begin(patches);
  impulses_.resize(patches.size());
  const float per_s = 1.0F / substep_s_;
  in_parallel(0, tiles_.places(), [&](std::size_t place) {
    const std::uint32_t of_awake = tiles_.patch_at()[place];
    if (of_awake == PatchTiles::kNoPatch) return;
    const std::uint32_t patch = asleep_.empty() ? of_awake : awake_[of_awake];
    const PatchConstraint c = tiles_.get(place);
    if (core::has_pushed(c))
      for (const std::uint32_t body : {c.a, c.b})
        std::atomic_ref(is_pushed_body_[body]).store(1, std::memory_order_relaxed);
    impulses_[patch] = {};
    for (int k = 0; k < c.count; ++k) {
      const PatchPoint& p = c.points[k];
      impulses_[patch][static_cast<std::size_t>(k)] = core::total_impulse(c, p);
      const core::Vec3 friction = p.tangent_impulse_1 * c.tangent_1 + p.tangent_impulse_2 * c.tangent_2;
      memory_.keep(patch, k, {patches[patch].manifold.points[k].feature, per_s * p.normal_impulse, per_s * friction});
    }
  });
  for (const AsleepPatch& kept : asleep_) {
    impulses_[kept.patch] = kept.given;
    for (int k = 0; k < core::kManifoldPoints; ++k)
      memory_.keep(kept.patch, k, kept.remembered[static_cast<std::size_t>(k)]);
  }
  each_body([&](std::size_t i) {
    if (is_pushed_body_[i] == 0)
      core::forget_pushes(bodies_[i], states[i], step.gravity_m_s2, step.wrenches.empty() ? nullptr : &step.wrenches[i],
                          substep_s_, substeps);
    states[i] = core::state_after(bodies_[i], states[i]);
  });
}

// Several threads may stir one body at the same time, so the store is atomic; all of them store the same number. Bodies
// that never move are not stirred.
void StepConstraints::stir(std::size_t place, std::uint32_t sweep) {
  for (const std::uint32_t body : {touched_[place].a, touched_[place].b})
    if (core::is_moved(bodies_[body])) std::atomic_ref(stirred_[body]).store(sweep, std::memory_order_relaxed);
}

template <typename Work>
void StepConstraints::visit_by_color(const std::vector<std::uint32_t>& begin, const Work& work) {
  for (std::size_t color = 0; color + 1 < begin.size(); ++color) in_parallel(begin[color], begin[color + 1], work);
}

template <typename Work>
float StepConstraints::change(std::size_t place, const Work& work) {
  PatchConstraint c = tiles_.get(place);
  const float largest = work(c, bodies_[c.a], bodies_[c.b]);
  tiles_.put(place, c);
  return largest;
}

std::uint32_t StepConstraints::relax_until_done(const core::SoftStep& numbers, float done_m_s, std::uint32_t most) {
  followers_.assign(tiles_.count(), 0);
  of_tiles_.assign(tiles_.count(), 0.0F);
  changes_.assign(tiles_.places(), 0.0F);
  core::DirectionShare directions;
  StirredSweep sweep{sweep_, done_m_s, 0.0F, stirred_.data(), followers_.data(), of_tiles_.data(), changes_.data()};
  for (std::uint32_t k = 1;; ++k) {
    each_range_by_color([&](const TileRange& range) { tiles_.kernels().relax_stirred(range, numbers, sweep); });
    sweep.number = ++sweep_;
    const float largest = largest_of(of_tiles_);
    if (k >= most || !(largest > done_m_s)) return k;
    if (!core::has_directions(numbers)) continue;
    sweep.share = directions.after(core::order_free_sum(changes_));
    if (sweep.share > 0.0F)
      each_range_by_color([&](const TileRange& range) { tiles_.kernels().push_stirred(range, sweep); });
  }
}

void StepConstraints::note_pushed(std::span<const float> pushes, const core::SoftStep& numbers) {
  pushed_.clear();
  fastest_push_m_s_ = largest_of(pushes);
  if (!(fastest_push_m_s_ > numbers.kept_push_m_s)) fastest_push_m_s_ = 0.0F;
  if (!is_pushed()) return;
  for (std::size_t place = 0; place < pushes.size(); ++place) {
    if (tiles_.patch_at()[place] == PatchTiles::kNoPatch || !core::is_taken_back(pushes[place], numbers)) continue;
    pushed_.push_back({place, core::impulses_before(tiles_.get(place))});
  }
  driven_.resize(bodies_.size());
  each_body([&](std::size_t i) { driven_[i] = {bodies_[i].v, bodies_[i].angular_momentum}; });
}

void StepConstraints::take_back_impulses() {
  sweep_ += 2;  // above what was stirred by the last sweep before
  in_parallel(0, pushed_.size(), [&](std::size_t k) {
    const PushedPatch& pushed = pushed_[k];
    PatchConstraint c = tiles_.get(pushed.place);
    core::go_back_to(pushed.before, c);
    tiles_.put(pushed.place, c);
    stir(pushed.place, sweep_);
  });
  each_body([&](std::size_t i) {
    if (!core::is_moved(bodies_[i])) return;
    bodies_[i].v = driven_[i].v;
    bodies_[i].angular_momentum = driven_[i].angular_momentum;
  });
}

std::uint32_t StepConstraints::relax_pushed(const core::SoftStep& numbers) {
  const float done = core::relax_done_m_s(numbers, fastest_push_m_s_);
  return relax_until_done(numbers, done, numbers.most_relax_sweeps);
}

void StepConstraints::list_fast() {
  fast_.clear();
  fast_begin_.assign(1, 0);
  const auto begin = tiles_.color_begin();
  for (std::size_t color = 0; color + 1 < begin.size(); ++color) {
    for (std::size_t place = std::size_t{begin[color]} * kTileLanes; place < std::size_t{begin[color + 1]} * kTileLanes;
         ++place)
      if (came_fast_[place] != 0) fast_.push_back(static_cast<std::uint32_t>(place));
    fast_begin_.push_back(static_cast<std::uint32_t>(fast_.size()));
  }
}

float StepConstraints::stir_what_bounces() {
  of_places_.assign(std::max(fast_.size(), tiles_.places()), 0.0F);
  in_parallel(0, fast_.size(), [&](std::size_t k) {
    of_places_[k] = core::fastest_bounce(tiles_.get(fast_[k]));
    if (of_places_[k] > 0.0F) stir(fast_[k], sweep_);
  });
  return largest_of(of_places_);
}

bool StepConstraints::stir_what_relaxed(std::span<const float> relaxed, float from_m_s) {
  of_places_.assign(relaxed.size(), 0.0F);
  in_parallel(0, relaxed.size(), [&](std::size_t place) {
    if (tiles_.patch_at()[place] == PatchTiles::kNoPatch || !(relaxed[place] > from_m_s)) return;
    of_places_[place] = 1.0F;
    stir(place, sweep_);
  });
  return largest_of(of_places_) > 0.0F;
}

void StepConstraints::drop_blows(std::uint32_t since) {
  in_parallel(0, tiles_.places(), [&](std::size_t place) {
    if (tiles_.patch_at()[place] == PatchTiles::kNoPatch) return;
    if (stirred_[touched_[place].a] < since && stirred_[touched_[place].b] < since) return;
    PatchConstraint c = tiles_.get(place);
    core::drop_impulses(c);
    tiles_.put(place, c);
  });
}

void StepConstraints::bounce(const core::SoftStep& numbers, std::span<const float> relaxed, bool forgets_blows) {
  const bool begins = largest_of(relaxed) > numbers.begins_m_s;
  if (fast_.empty() && !begins) return;
  sweep_ += 2;  // above what was stirred by the last sweep before
  const std::uint32_t since = sweep_;
  const float fastest = stir_what_bounces();
  if (!(fastest > 0.0F) && !begins) return;
  float done = core::kBounceDone * fastest;
  if (stir_what_relaxed(relaxed, numbers.stirring_m_s)) done = std::max(done, numbers.stirring_m_s);
  if (!(done > 0.0F)) return;
  // A bounce gives back a share of the impulse that stopped its points, so that impulse is made accurate first.
  bounce_sweeps_ += relax_until_done(numbers, done, numbers.most_stop_sweeps);
  float largest = fastest;
  for (std::uint32_t k = 0; k < numbers.most_bounce_sweeps && largest > done; ++k) {
    of_places_.assign(fast_.size(), 0.0F);
    visit_by_color(fast_begin_, [&](std::size_t n) {
      of_places_[n] = change(fast_[n], [&](PatchConstraint& c, SolverBody& a, SolverBody& b) {
        if (k == 0) core::note_budget(c);
        return core::fastest_bounce(c) > 0.0F ? core::bounce(c, a, b, done) : 0.0F;
      });
    });
    ++bounce_sweeps_;
    largest = largest_of(of_places_);
  }
  if (forgets_blows) drop_blows(since);
}

}  // namespace broadside::reference
