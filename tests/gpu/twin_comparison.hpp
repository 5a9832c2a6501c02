// Steps two pipelines side by side: at every frame their digests must be equal, bit for bit.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "core/engine/dynamics.hpp"
#include "core/method/frame_digest.hpp"
#include "core/method/rigid/point_digest.hpp"
#include "core/scene/scene.hpp"

namespace broadside::gpu {

// Names what differs first, in the order in which the pipeline makes it.
inline std::string first_difference(const core::FrameRecord& p, const core::FrameRecord& q) {
  if (p.detected_position != q.detected_position) return "positions at detection";
  if (p.boxes != q.boxes) return "boxes";
  if (p.confirmed != q.confirmed)
    return "confirmed pairs: " + std::to_string(p.confirmed.size()) + " against " + std::to_string(q.confirmed.size());
  if (p.proximity != q.proximity) return "nearest vertices";
  if (p.contacts.size() != q.contacts.size())
    return "contacts: " + std::to_string(p.contacts.size()) + " against " + std::to_string(q.contacts.size());
  for (std::size_t k = 0; k < p.contacts.size(); ++k) {
    const core::Contact& c = p.contacts[k];
    const core::Contact& d = q.contacts[k];
    const std::string name =
        "contact " + std::to_string(k) + " (" + std::to_string(c.a) + ", " + std::to_string(c.b) + ")";
    if (c.a != d.a || c.b != d.b || c.color != d.color) return name + ": bodies or color";
    if (core::contact_digest(c) == core::contact_digest(d)) continue;
    if (c.depth_m != d.depth_m || c.normal != d.normal) return name + ": depth or normal";
    if (c.pre_a != d.pre_a || c.pre_b != d.pre_b) return name + ": state before";
    if (c.tangent != d.tangent) return name + ": tangent";
    if (c.normal_impulse_n_s != d.normal_impulse_n_s || c.tangent_impulse_n_s != d.tangent_impulse_n_s)
      return name + ": impulses";
    if (c.post_a.x != d.post_a.x || c.post_b.x != d.post_b.x) return name + ": positions after";
    if (c.post_a.v != d.post_a.v || c.post_b.v != d.post_b.v) return name + ": velocities after";
    return name + ": the sign of a zero";
  }
  if (p.points.size() != q.points.size())
    return "points: " + std::to_string(p.points.size()) + " against " + std::to_string(q.points.size());
  for (std::size_t k = 0; k < p.points.size(); ++k) {
    const core::ContactPoint& c = p.points[k];
    const core::ContactPoint& d = q.points[k];
    if (core::point_digest(c) == core::point_digest(d)) continue;
    const std::string name =
        "point " + std::to_string(k) + " (" + std::to_string(c.a) + ", " + std::to_string(c.b) + ")";
    if (c.a != d.a || c.b != d.b || c.feature != d.feature) return name + ": bodies or feature";
    if (c.gap_m != d.gap_m || c.normal != d.normal || c.point != d.point) return name + ": place, gap or normal";
    return name + ": impulse";
  }
  if (p.orientation != q.orientation) return "orientations";
  if (p.position != q.position) return "positions";
  if (p.velocity != q.velocity) return "velocities";
  return "nothing that is recorded";
}

// Steps both pipelines for so many frames; ends at the first frame that differs. Every `full_every` frames everything
// is read back, otherwise the digest alone. Returns the number of contacts and points in the frames that were read in
// full, so that a test can tell that something happened.
inline std::uint64_t compare_pipelines(const core::Scene& scene, core::Dynamics& subject, core::Dynamics& twin,
                                       int frames, int full_every = 10) {
  EXPECT_TRUE(core::check_scene(scene).ok()) << core::check_scene(scene).error().line();
  const auto good = [](const core::Status& s) {
    EXPECT_TRUE(s.ok()) << s.error().line();
    return s.ok();
  };
  if (!good(subject.load(scene)) || !good(twin.load(scene))) return 0;
  std::uint64_t contacts = 0;
  for (int k = 0; k < frames; ++k) {
    core::FrameRecord p;
    core::FrameRecord q;
    if (!good(subject.step(scene.dt_s)) || !good(twin.step(scene.dt_s))) return contacts;
    const auto level = k % full_every == 0 ? core::RecordLevel::kFull : core::RecordLevel::kDigest;
    if (!good(subject.read_back(p, level)) || !good(twin.read_back(q, level))) return contacts;
    contacts += p.contacts.size() + p.points.size();
    const bool has_pairs = !p.pairs.empty() || !q.pairs.empty();
    if (p.digest == q.digest &&
        !(has_pairs && (subject.groups() & twin.groups() & core::bit(core::Group::kPairs)) != 0 && p.pairs != q.pairs))
      continue;
    EXPECT_TRUE(subject.read_back(p, core::RecordLevel::kFull).ok());
    EXPECT_TRUE(twin.read_back(q, core::RecordLevel::kFull).ok());
    ADD_FAILURE() << "frame " << k + 1 << " differs in "
                  << (p.digest == q.digest ? std::string("candidate pairs") : first_difference(p, q));
    return contacts;
  }
  return contacts;
}

}  // namespace broadside::gpu
