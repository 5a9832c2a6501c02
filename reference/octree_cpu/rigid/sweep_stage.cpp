#include "reference/octree_cpu/rigid/sweep_stage.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>

#include "core/method/rigid/turned_box.hpp"
#include "reference/octree_cpu/rigid/in_parallel.hpp"

namespace broadside::reference {

using core::Pair;

namespace {

void lower(std::uint32_t& parts, std::uint32_t to) {
  const std::atomic_ref<std::uint32_t> shared(parts);
  std::uint32_t now = shared.load(std::memory_order_relaxed);
  while (to < now && !shared.compare_exchange_weak(now, to, std::memory_order_relaxed)) {
  }
}

}  // namespace

void SweepStage::load(const core::Scene& scene, const core::RigidBodies& bodies,
                      const MakeBroadPhase& make_broad_phase) {
  scene_ = &scene;
  make_broad_phase_ = make_broad_phase;
  broad_phase_.reset();
  stopped_ = 0;
  for (int k = 0; k < core::kFaceCount; ++k) {
    face_shapes_[static_cast<std::size_t>(k)] = core::domain_face_shape(k);
    face_poses_[static_cast<std::size_t>(k)] = core::domain_face_pose(scene.domain, k);
  }
  thinnest_m_ = INFINITY;
  for (const core::RigidShape& shape : bodies.shapes) thinnest_m_ = std::min(thinnest_m_, shape.half_thickness_m);
  boxes_.resize(bodies.count());
  next_parts_.resize(bodies.count());
  is_changed_.resize(bodies.count());
}

core::SweptWay SweepStage::way(const core::RigidBodies& bodies, std::uint32_t body) const {
  core::SweptWay way;
  way.start = bodies.pose(body);
  way.end = {bodies.state[body].x, bodies.state[body].q};
  way.swing_m = core::swing_of(way.start, way.end, bodies.shapes[bodies.shape[body]].balls.outer_m);
  return parts_.empty() ? way : core::part_of_way(way, parts_[body]);
}

core::Status SweepStage::find_pairs(const core::RigidBodies& bodies) {
  pairs_.clear();
  in_parallel(0, bodies.count(), [&](std::size_t k) {
    const auto i = static_cast<std::uint32_t>(k);
    const core::RigidShape& shape = bodies.shapes[bodies.shape[i]];
    const core::SweptWay way = this->way(bodies, i);
    const core::Box end = core::turned_box(shape.contact, shape.vertices(), way.end.x, way.end.q);
    boxes_[i] = core::box_of_way(bodies.shape_boxes[i], end, way.swing_m);
  });
  std::vector<Pair> near;
  if (make_broad_phase_) {
    if (!broad_phase_) {
      broad_phase_ = make_broad_phase_(*scene_);
      if (core::Status s = broad_phase_->load(boxes_, bodies.is_static); !s) return s;
    }
    if (core::Status s = broad_phase_->update(boxes_); !s) return s;
    if (core::Status s = broad_phase_->find(); !s) return s;
    auto found = broad_phase_->read_back();
    if (!found) return found.error();
    near = std::move(found).value().pairs;
  } else {
    for (std::uint32_t i = 0; i < bodies.count(); ++i)
      for (std::uint32_t j = i + 1; j < bodies.count(); ++j)
        if (core::overlaps(boxes_[i], boxes_[j])) near.push_back({i, j});
  }
  // Two bodies that do not move farther than the thinner one is thick cannot pass through each other, so they are left
  // out.
  for (const Pair p : near) {
    if (!bodies.are_followed(p) || (bodies.is_static[p.i] != 0 && bodies.is_static[p.j] != 0)) continue;
    if (core::moves_far(core::length_of(way(bodies, p.i)), core::length_of(way(bodies, p.j)), bodies.thinner_m(p)))
      pairs_.push_back(p);
  }
  at_faces_.clear();
  for (std::uint32_t i = 0; i < bodies.count(); ++i) {
    const core::SweptWay way = this->way(bodies, i);
    if (!bodies.is_followed(i) || bodies.is_static[i] != 0) continue;
    if (!(core::length_of(way) > core::swept_depth_m(bodies.thickness_m(i)))) continue;
    for (std::uint32_t face = 0; face < core::kFaceCount; ++face)
      if (core::may_reach_face(boxes_[i], 0.0F, scene_->domain, face)) {
        at_faces_.push_back(i);
        break;
      }
  }
  return core::Done{};
}

void SweepStage::shorten_at_faces(const core::RigidBodies& bodies, std::uint32_t body) {
  const float thin_m = bodies.thickness_m(body);
  for (std::uint32_t face = 0; face < core::kFaceCount; ++face) {
    if (!core::may_reach_face(boxes_[body], 0.0F, scene_->domain, face)) continue;
    const float share = core::clear_share(bodies.shapes[bodies.shape[body]].contact, way(bodies, body),
                                          face_shapes_[face], {face_poses_[face], face_poses_[face], 0.0F},
                                          core::swept_depth_m(thin_m), core::swept_done_m(thin_m));
    if (share < 1.0F) lower(next_parts_[body], static_cast<std::uint32_t>(share * static_cast<float>(parts_[body])));
  }
}

void SweepStage::shorten(const core::RigidBodies& bodies, Pair pair) {
  const float thinner_m = bodies.thinner_m(pair);
  const float share = core::clear_share(bodies.shapes[bodies.shape[pair.i]].contact, way(bodies, pair.i),
                                        bodies.shapes[bodies.shape[pair.j]].contact, way(bodies, pair.j),
                                        core::swept_depth_m(thinner_m), core::swept_done_m(thinner_m));
  if (!(share < 1.0F)) return;
  for (const std::uint32_t body : {pair.i, pair.j})
    lower(next_parts_[body], static_cast<std::uint32_t>(share * static_cast<float>(parts_[body])));
}

core::Status SweepStage::stop_short(core::RigidBodies& bodies) {
  parts_.clear();
  float longest = 0.0F;
  for (std::uint32_t i = 0; i < bodies.count(); ++i) longest = std::max(longest, core::length_of(way(bodies, i)));
  if (!(2.0F * longest > core::swept_depth_m(thinnest_m_))) return core::Done{};
  if (core::Status s = find_pairs(bodies); !s) return s;

  parts_.assign(bodies.count(), core::kPartsOfWay);
  is_changed_.assign(bodies.count(), 1);
  for (std::uint32_t round = 0;; ++round) {
    next_parts_ = parts_;
    in_parallel(0, pairs_.size(), [&](std::size_t k) {
      const Pair p = pairs_[k];
      if (is_changed_[p.i] == 0 && is_changed_[p.j] == 0) return;
      if (parts_[p.i] == 0 && parts_[p.j] == 0) return;
      shorten(bodies, p);
    });
    in_parallel(0, at_faces_.size(), [&](std::size_t k) {
      if (is_changed_[at_faces_[k]] != 0 && parts_[at_faces_[k]] != 0) shorten_at_faces(bodies, at_faces_[k]);
    });
    bool is_done = true;
    for (std::uint32_t i = 0; i < bodies.count(); ++i) {
      is_changed_[i] = next_parts_[i] < parts_[i] ? 1 : 0;
      if (is_changed_[i] == 0) continue;
      is_done = false;
      parts_[i] = round < core::kMostSweepRounds ? next_parts_[i] : 0;
    }
    if (is_done) break;
  }
  for (std::uint32_t i = 0; i < bodies.count(); ++i) {
    if (parts_[i] == core::kPartsOfWay || bodies.is_static[i] != 0) continue;
    const core::SweptWay gone = way(bodies, i);
    bodies.state[i].x = gone.end.x;
    bodies.state[i].q = gone.end.q;
    bodies.state[i].q_rest = {0.0F, 0.0F, 0.0F, 0.0F};
    ++stopped_;
  }
  return core::Done{};
}

}  // namespace broadside::reference
