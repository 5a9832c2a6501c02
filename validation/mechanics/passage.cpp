#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>

#include "validation/mechanics/mesh_passage.hpp"
#include "validation/mechanics/motion.hpp"
#include "validation/mechanics/oriented_box.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

// A depth that exceeds the limit by at most this share of it, for a short part of the motion, may go unseen. This
// bounds the number of halvings, because the motion of each half is half as long.
constexpr double kUnseenShare = 0.125;

class Passage final : public Validator {
 public:
  explicit Passage(const Subject& subject) : scene_(subject.header.scene), shapes_(scene_), meshes_(scene_) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    for (const core::Pair p : m.near)
      for (std::size_t part = 0; part < m.parts(); ++part) judge({m, p, part});
  }

  core::Verdict conclude() override {
    return tally_.conclude("no two bodies moved fast enough past each other to pass through");
  }

 private:
  struct Pose {
    Vec3d x;
    Quatd q;
  };
  // Two bodies in a part of a step: all of it where no pose is known between its ends.
  struct Encounter {
    const Motion& m;
    core::Pair pair;
    std::size_t part;

    [[nodiscard]] const BodyState& from(std::uint32_t body) const { return m.pose_after(part, body); }
    [[nodiscard]] const BodyState& to(std::uint32_t body) const { return m.pose_after(part + 1, body); }
    // rad at most, by the speeds that are recorded
    [[nodiscard]] double turns(std::uint32_t body) const {
      const BodyStep& b = m.bodies[body];
      if (m.parts() == 1) return m.h * length(b.before.w);
      return m.h / static_cast<double>(m.parts()) * std::max(length(b.before.w), length(b.after.w));
    }
  };

  // Between two recorded poses: the center of mass on a line, the turn at a constant rate.
  [[nodiscard]] static Pose pose_at(const Encounter& e, std::uint32_t i, double t) {
    const BodyState& from = e.from(i);
    const BodyState& to = e.to(i);
    const Quatd turn = to.q * conjugate(from.q);
    const double angle = angle_of(turn);
    const double sign = turn.w < 0.0 ? -1.0 : 1.0;
    const Vec3d axis{sign * turn.x, sign * turn.y, sign * turn.z};
    const double size = length(axis);
    const Quatd q = size > 0.0 ? turn_by((t * angle / size) * axis) * from.q : from.q;
    return {from.x + t * (to.x - from.x), q};
  }

  // A lower bound of the distance: where boxes around the shapes are apart, the distance of the boxes.
  [[nodiscard]] double distance_at(const Encounter& e, double t) const {
    const Motion& m = e.m;
    const core::Pair pair = e.pair;
    const Pose p = pose_at(e, pair.i, t);
    const Pose q = pose_at(e, pair.j, t);
    const auto origin = [&](std::uint32_t i, const Pose& at) {
      return at.x - matrix_of(at.q) * m.facts[i].center_of_mass;
    };
    const BodyFacts& fa = m.facts[pair.i];
    const BodyFacts& fb = m.facts[pair.j];
    const OrientedBox box_a = oriented_box(fa, origin(pair.i, p), matrix_of(p.q));
    const OrientedBox box_b = oriented_box(fb, origin(pair.j, q), matrix_of(q.q));
    const double overlap = overlap_bound(box_a, box_b);
    if (overlap < 0.0) return -overlap;
    if (!shapes_.knows(fa.mesh))
      return distance_of_vertices(fa.mesh, origin(pair.i, p), p.q, box_b,
                                  shapes_.placed(fb.mesh, origin(pair.j, q), q.q));
    if (!shapes_.knows(fb.mesh))
      return distance_of_vertices(fb.mesh, origin(pair.j, q), q.q, box_a,
                                  shapes_.placed(fa.mesh, origin(pair.i, p), p.q));
    return exact::signed_distance(shapes_.placed(fa.mesh, origin(pair.i, p), p.q),
                                  shapes_.placed(fb.mesh, origin(pair.j, q), q.q))
        .distance_m;
  }

  // A mesh that is not convex is represented by its vertices: how far the nearest is from the other body, or how deep
  // the deepest is in it. No mesh is less deep than any of its vertices. A lower bound of the distance, as above.
  [[nodiscard]] double distance_of_vertices(std::uint32_t mesh, Vec3d origin, Quatd q, const OrientedBox& box,
                                            const exact::ConvexCore& other) const {
    const Mat3d r = matrix_of(q);
    double least = std::numeric_limits<double>::infinity();
    exact::ConvexCore point;
    point.vertices.resize(1);
    for (const core::Vec3 v : scene_.meshes[mesh]->vertices) {
      const Vec3d at = origin + r * Vec3d{v.x, v.y, v.z};
      const double outside = distance_outside(box, at);
      point.vertices[0] = to_point(at);
      least = std::min(least, outside > 0.0 ? outside : exact::signed_distance(point, other).distance_m);
    }
    return least;
  }

  void judge(const Encounter& e) {
    const Motion& m = e.m;
    const core::Pair pair = e.pair;
    const BodyFacts& fa = m.facts[pair.i];
    const BodyFacts& fb = m.facts[pair.j];
    const auto swing = [&e](std::uint32_t i) {
      return e.m.facts[i].reach_m * angle_of(e.to(i).q * conjugate(e.from(i).q));
    };
    // No two points of the bodies come closer by more than this in this part.
    const double moved = length((e.to(pair.i).x - e.from(pair.i).x) - (e.to(pair.j).x - e.from(pair.j).x)) +
                         swing(pair.i) + swing(pair.j);
    const bool knows_a = shapes_.knows(fa.mesh);
    const bool knows_b = shapes_.knows(fb.mesh);
    const bool is_by_vertices = knows_a != knows_b;
    // A vertex in the middle of a plate is half of its thickness deep, and no vertex is deeper in it.
    const double allowed = is_by_vertices ? 0.25 * (knows_a ? fa : fb).smallest_side_m
                                          : 0.5 * std::min(fa.smallest_side_m, fb.smallest_side_m);
    // Bodies that are not deep at the ends cannot have been much deeper in between; penetration judges the ends.
    if (moved <= allowed) return;
    // The body turns so fast that its poses do not say which way it turned.
    if (std::max(e.turns(pair.i), e.turns(pair.j)) >= std::numbers::pi) return;
    const double first = overlap_bound(oriented_box(fa, e.from(pair.i)), oriented_box(fb, e.from(pair.j)));
    const double last = overlap_bound(oriented_box(fa, e.to(pair.i)), oriented_box(fb, e.to(pair.j)));
    if (0.5 * (first + last + moved) <= allowed && tally_.check_bound(std::max({0.0, first, last}), allowed)) return;
    if (!knows_a && !knows_b) {
      judge_meshes(e, moved, allowed);
      return;
    }
    const double d0 = distance_at(e, 0.0);
    const double d1 = distance_at(e, 1.0);
    const double limit = allowed + std::max({0.0, -d0, -d1});
    const double deepest = deepest_between({e, limit, kUnseenShare * allowed}, {0.0, d0}, {1.0, d1}, moved);
    tally_.check(deepest, {limit, "m", is_by_vertices ? kOriginOfVertices : kOrigin},
                 Where::pair(m.step, pair.i, pair.j, "bodies.position"), [&] {
                   return "apart by " + number_text(d0) + " and " + number_text(d1) + " m at the two ends, and " +
                          number_text(deepest) + " m deep between them";
                 });
  }

  // By the arbiter of first touches: meshes that never touch did not pass through each other, and those that touch for
  // a short time were not deep. For the others two surfaces alone do not say how deep they were.
  void judge_meshes(const Encounter& e, double moved, double allowed) {
    const Motion& m = e.m;
    const core::Pair pair = e.pair;
    const double deepest = meshes_.deepest_m(m, pair, e.part, moved);
    if (deepest > allowed) {
      tally_.leave_undecided();
      return;
    }
    tally_.check(deepest, {allowed, "m", kOrigin}, Where::pair(m.step, pair.i, pair.j, "bodies.position"));
  }

  struct Sample {
    double t;
    double d;
  };
  // What a search is for: deeper than limit; unseen: what may be missed beyond it.
  struct Search {
    const Encounter& encounter;
    double limit;
    double unseen;
  };

  // The deepest overlap found. The search ends as soon as one breaks the limit. Where the certified bound, (d0 + d1 -
  // M) / 2 for a motion of at most M, holds, no more is looked for.
  [[nodiscard]] double deepest_between(const Search& s, Sample p, Sample q, double moved) const {
    const double found = std::max(-p.d, -q.d);
    if (found > s.limit || 0.5 * (p.d + q.d - moved) >= -s.limit - s.unseen) return found;
    const double t = 0.5 * (p.t + q.t);
    const Sample middle{t, distance_at(s.encounter, t)};
    const double left = deepest_between(s, p, middle, 0.5 * moved);
    return left > s.limit ? left : std::max(left, deepest_between(s, middle, q, 0.5 * moved));
  }

  static constexpr std::string_view kOrigin =
      "half of the smaller body's smallest side, beyond the depth at the ends: certified by conservative advancement";
  static constexpr std::string_view kOriginOfVertices =
      "a quarter of the convex body's smallest side, which is half of the depth that a vertex can have in it, beyond "
      "the depth at the ends: certified by conservative advancement";
  const core::Scene& scene_;
  ExactShapes shapes_;
  MeshPassage meshes_;
  Tally tally_{"passage", "fast encounters", kOrigin};
};

}  // namespace

ValidatorRow passage_row() {
  return {"passage",
          "between two frames no body passes through another one",
          "tunnelling",
          core::bit(core::Group::kBodies) | core::bit(core::Group::kPartPoses),
          0,
          [](const Subject& subject) { return lacking(subject.header, core::bit(core::Group::kBodies)); },
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Passage>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
