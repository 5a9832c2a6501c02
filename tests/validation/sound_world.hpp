// A small world that obeys METHOD 1 to 6, simulated in float64 and rounded once per recorded number: what a sound trace
// looks like, made without any code of the engines or the validators.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "bench/mutants/specimen.hpp"
#include "bench/mutants/specimen_scenes.hpp"
#include "core/method/frame_digest.hpp"
#include "core/scene/body_octree.hpp"
#include "core/scene/scene.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/statistics.hpp"
#include "core/trace/trace_header.hpp"
#include "validation/judge.hpp"

namespace broadside::tests {

using core::Box;
using core::Contact;
using core::FrameRecord;
using core::Kinematics;
using core::Pair;
using core::Vec3;

using Recording = bench::Specimen;

// A cube of side 1 around the origin whose faces carry a grid of `cells` x `cells` squares.
inline std::shared_ptr<const core::Mesh> grid_cube(int cells) {
  auto mesh = std::make_shared<core::Mesh>();
  mesh->name = "cube";
  mesh->source = "procedural";
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto vertex = [&](std::array<int, 3> at) {
    const auto [entry, is_new] = known.try_emplace(at, static_cast<std::uint32_t>(mesh->vertices.size()));
    const auto coordinate = [&](int k) { return static_cast<float>(k) / static_cast<float>(cells) - 0.5F; };
    if (is_new) mesh->vertices.push_back({coordinate(at[0]), coordinate(at[1]), coordinate(at[2])});
    return entry->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, cells})
      for (int p = 0; p < cells; ++p)
        for (int q = 0; q < cells; ++q) {
          const auto corner = [&](int dp, int dq) {
            std::array<int, 3> at{};
            at[axis] = side;
            at[(axis + 1) % 3] = p + dp;
            at[(axis + 2) % 3] = q + dq;
            return vertex(at);
          };
          mesh->triangles.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
          mesh->triangles.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
        }
  return mesh;
}

// By core/method, which the validators do not use.
inline std::uint64_t digest_of(const FrameRecord& frame) {
  std::uint64_t sum = 0;
  for (std::uint32_t i = 0; i < frame.position.size(); ++i)
    sum += core::body_digest(i, frame.position[i], frame.orientation[i], frame.velocity[i], frame.angular_velocity[i]);
  for (const Pair p : frame.confirmed) sum += core::confirmed_digest(p);
  for (const Contact& c : frame.contacts) sum += core::contact_digest(c);
  return sum;
}

inline core::Body body_at(Vec3 x, Vec3 v, float mass) {
  core::Body body;
  body.position = x;
  body.velocity = v;
  body.inverse_mass = mass > 0.0F ? 1.0F / mass : 0.0F;
  return body;
}

// The scene of the tamperings, with a cube made by this file.
inline core::Scene mixed_scene() {
  return bench::mixed_scene(grid_cube(4));
}

class SoundWorld {
 public:
  explicit SoundWorld(core::Scene scene) {
    recording_.header.scene = std::move(scene);
    core::Stamp& stamp = recording_.header.stamp;
    stamp.scene_name = recording_.header.scene.name;
    stamp.scene_digest = core::scene_digest(recording_.header.scene);
    stamp.engine = "octree-cpu";
    stamp.settings = "broad=tree,levels=flat,solver=colored,threads=1,variant=sound,vertex_stage=on";
    recording_.header.declaration = core::method_declaration();
    recording_.header.groups = core::bit(core::Group::kBodies) | core::bit(core::Group::kDetection) |
                               core::bit(core::Group::kPairs) | core::bit(core::Group::kConfirmed) |
                               core::bit(core::Group::kContacts);
  }

  Recording run() {
    for (const core::Body& body : scene().bodies) state_.push_back({body.position, body.velocity});
    local_ = core::bounds(*scene().meshes[0]);
    for (std::uint32_t step = 1; step <= scene().frames; ++step) advance(step);
    core::PenetrationCounter counter(scene().parameters.delta_m);
    for (const FrameRecord& frame : recording_.frames) counter.add(frame.step, frame.contacts);
    recording_.statistics = {*counter.rest()};  // fewer steps than a window has
    return std::move(recording_);
  }

 private:
  const core::Scene& scene() const { return recording_.header.scene; }

  void advance(std::uint32_t step) {
    FrameRecord frame;
    frame.step = step;
    frame.time_s = static_cast<double>(step) * scene().dt_s;
    for (std::size_t i = 0; i < state_.size(); ++i) {
      if (scene().bodies[i].inverse_mass > 0.0F) {
        for (int k = 0; k < 3; ++k) {
          state_[i].v[k] = static_cast<float>(double(state_[i].v[k]) + double(scene().dt_s) * scene().gravity_m_s2[k]);
          state_[i].x[k] = static_cast<float>(double(state_[i].x[k]) + double(scene().dt_s) * state_[i].v[k]);
        }
      }
      frame.detected_position.push_back(state_[i].x);
      frame.detected_velocity.push_back(state_[i].v);
      frame.boxes.push_back(box(state_[i].x));
    }
    find_pairs(frame);
    std::uint32_t color = 0;
    for (std::size_t k = 0; k < frame.confirmed.size(); ++k)
      if (frame.proximity[k].is_touching()) apply(frame, frame.confirmed[k].i, frame.confirmed[k].j, color++);
    for (std::uint32_t i = 0; i < state_.size(); ++i)
      for (std::uint32_t face = 0; face < 6; ++face) apply(frame, i, core::kFirstFace + face, core::kFaceColor);
    finish(frame);
    recording_.frames.push_back(std::move(frame));
  }

  Box box(Vec3 x) const { return {local_.min + x, local_.max + x}; }

  bool is_static(std::uint32_t i) const { return !(scene().bodies[i].inverse_mass > 0.0F); }

  void find_pairs(FrameRecord& frame) {
    for (std::uint32_t i = 0; i < state_.size(); ++i)
      for (std::uint32_t j = i + 1; j < state_.size(); ++j) {
        bool meet = !(is_static(i) && is_static(j));
        for (int k = 0; k < 3; ++k)
          meet =
              meet && frame.boxes[i].min[k] <= frame.boxes[j].max[k] && frame.boxes[j].min[k] <= frame.boxes[i].max[k];
        if (meet) frame.pairs.push_back({i, j});
      }
    frame.pairs_demanded = frame.pairs_raw = frame.pairs.size();
    frame.confirmed = frame.pairs;
    for (const Pair p : frame.confirmed) frame.proximity.push_back(nearest(p));
  }

  core::Proximity nearest(Pair p) const {
    const auto& vertices = scene().meshes[0]->vertices;
    core::Proximity best;
    double best2 = theta_m() * theta_m();
    for (std::uint32_t a = 0; a < vertices.size(); ++a)
      for (std::uint32_t b = 0; b < vertices.size(); ++b) {
        double d2 = 0.0;
        for (int k = 0; k < 3; ++k) {
          const double d = double(vertices[a][k] + state_[p.i].x[k]) - double(vertices[b][k] + state_[p.j].x[k]);
          d2 += d * d;
        }
        if (d2 < best2) {
          best2 = d2;
          best = {static_cast<float>(d2), a, b};
        }
      }
    return best;
  }

 public:
  // Mean edge of the grid cube of `cells` cells: per face, c (c+1) edges each way and c^2 diagonals; edges on the
  // cube's own edges are shared by two faces: 12 c distinct ones, counted twice.
  static double grid_cube_mean_edge_m(int cells) {
    const double c = cells;
    const double straight = 6.0 * 2.0 * c * (c + 1.0) - 12.0 * c;
    const double diagonal = 6.0 * c * c;
    return (straight + diagonal * std::sqrt(2.0)) / (straight + diagonal) / c;
  }

 private:
  double theta_m() const {
    return scene().parameters.theta_m > 0.0F ? double(scene().parameters.theta_m) : grid_cube_mean_edge_m(4);
  }

  // METHOD 4 to 6 for one pair, or one body and one face.
  void apply(FrameRecord& frame, std::uint32_t a, std::uint32_t b, std::uint32_t color) {
    const bool is_face = core::is_face(b);
    if (is_face && is_static(a)) return;
    Contact c;
    c.a = a;
    c.b = b;
    c.color = color;
    c.pre_a = state_[a];
    if (!is_face) c.pre_b = state_[b];
    int axis = 0;
    double sign = 1.0;
    double depth = 0.0;
    const Box box_a = box(c.pre_a.x);
    if (is_face) {
      const std::uint32_t face = b - core::kFirstFace;
      axis = static_cast<int>(face / 2);
      sign = face % 2 == 0 ? 1.0 : -1.0;
      depth = face % 2 == 0 ? double(scene().domain.min[axis]) - box_a.min[axis]
                            : double(box_a.max[axis]) - scene().domain.max[axis];
    } else {
      const Box box_b = box(c.pre_b.x);
      depth = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 3; ++k) {
        const double p = std::min<double>(box_a.max[k], box_b.max[k]) - std::max<double>(box_a.min[k], box_b.min[k]);
        if (p < depth) axis = k, depth = p;
      }
      sign = double(c.pre_a.x[axis]) - c.pre_b.x[axis] < 0.0 ? -1.0 : 1.0;
    }
    if (!(static_cast<float>(depth) > 0.0F)) return;
    c.depth_m = static_cast<float>(depth);
    c.normal[axis] = static_cast<float>(sign);
    solve(c, axis, sign, depth);
    state_[a] = c.post_a;
    if (!is_face) state_[b] = c.post_b;
    frame.contacts.push_back(c);
  }

  void solve(Contact& c, int axis, double sign, double depth) {
    const core::Parameters& p = scene().parameters;
    const double w_a = scene().bodies[c.a].inverse_mass;
    const double w_b = core::is_face(c.b) ? 0.0 : double(scene().bodies[c.b].inverse_mass);
    const double w = w_a + w_b;
    c.post_a = c.pre_a;
    c.post_b = c.pre_b;
    const double d = double(p.alpha) * p.beta * std::max(depth - p.delta_m, 0.0);
    c.post_a.x[axis] = static_cast<float>(c.pre_a.x[axis] + w_a / w * d * sign);
    c.post_b.x[axis] = static_cast<float>(c.pre_b.x[axis] - w_b / w * d * sign);

    std::array<double, 3> v{};
    for (int k = 0; k < 3; ++k) v[k] = double(c.pre_a.v[k]) - c.pre_b.v[k];
    const double v_n = v[axis] * sign;
    if (v_n >= 0.0) return;
    const double e = -v_n < p.v_threshold_m_s ? 0.0 : 0.3F;
    const double j_n = std::max(-(1.0 + e) * v_n / w, std::min<double>(p.impulse_min_n_s, -2.0 * v_n / w));
    c.normal_impulse_n_s = static_cast<float>(j_n);
    v[axis] = 0.0;
    const double slide = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const double stop = slide / w;
    const double j_t = stop <= double(0.6F) * j_n ? -stop : -double(0.5F) * j_n;
    if (slide > 0.0) c.tangent_impulse_n_s = static_cast<float>(j_t);
    for (int k = 0; k < 3; ++k) {
      const double t = slide > 0.0 ? v[k] / slide : 0.0;
      c.tangent[k] = static_cast<float>(t);
      const double impulse = (k == axis ? j_n * sign : 0.0) + j_t * t;
      c.post_a.v[k] = static_cast<float>(c.pre_a.v[k] + w_a * impulse);
      c.post_b.v[k] = static_cast<float>(c.pre_b.v[k] - w_b * impulse);
    }
  }

  void finish(FrameRecord& frame) {
    const float v_max = scene().parameters.v_max_m_s;
    for (std::size_t i = 0; i < state_.size(); ++i) {
      if (!is_static(static_cast<std::uint32_t>(i)))
        for (int k = 0; k < 3; ++k) state_[i].v[k] = std::clamp(state_[i].v[k], -v_max, v_max);
      frame.position.push_back(state_[i].x);
      frame.velocity.push_back(state_[i].v);
      frame.orientation.push_back(scene().bodies[i].orientation);
      frame.angular_velocity.push_back({});
    }
    frame.digest = digest_of(frame);
  }

  Recording recording_;
  Box local_;
  std::vector<Kinematics> state_;
};

inline Recording sound_recording() {
  return SoundWorld(mixed_scene()).run();
}

// One recording for all tests that only read or copy it.
inline const Recording& sound() {
  static const Recording kSound = sound_recording();
  return kSound;
}

inline std::vector<core::Verdict> judged(const Recording& subject, const Recording* baseline = nullptr,
                                         std::vector<std::string> only = {}) {
  auto result = bench::judge_specimen(subject, baseline, std::move(only));
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().line());
  return result.ok() ? std::move(result).value() : std::vector<core::Verdict>{};
}

inline core::Verdict verdict_of(const std::string& validator, const Recording& subject,
                                const Recording* baseline = nullptr) {
  const auto verdicts = judged(subject, baseline, {validator});
  return verdicts.empty() ? core::Verdict{} : verdicts.front();
}

inline std::string line(const core::Verdict& v) {
  return v.validator + ": " + std::string(core::outcome_word(v.outcome)) + ": " + v.explanation + " [" + v.origin + "]";
}

}  // namespace broadside::tests
