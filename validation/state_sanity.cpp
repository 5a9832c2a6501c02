#include "validation/state_sanity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/scene/shapes.hpp"
#include "validation/application.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

using core::FrameRecord;
using core::Kinematics;
using core::Vec3;

bool is_finite(core::Quat q) {
  return std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
}

class StateSanity final : public Validator {
 public:
  explicit StateSanity(const Subject& subject)
      : header_(subject.header),
        scene_(header_.scene),
        bodies_(scene_),
        is_method_(why_not_method(header_).empty() && header_.driver.empty()),
        translates_(is_method_ && has(header_, core::Group::kDetection)),
        is_colored_(is_method_ && setting(header_.stamp, "solver") == "colored" &&
                    setting(header_.stamp, "variant") != "printed-E8" && has(header_, core::Group::kContacts)) {
    const core::ShapeTable table = core::build_shapes(scene_);
    for (const std::uint32_t shape : table.shape_of_body) local_.push_back(table.shapes[shape].octree.boxes[0]);
    has_spring_.assign(scene_.bodies.size(), 0);
    for (const core::Spring& s : scene_.springs)
      if (s.body < has_spring_.size()) has_spring_[s.body] = 1;
  }

  void look(const Evidence& evidence) override {
    const FrameRecord& frame = evidence.frame;
    step_ = frame.step;
    const double time = static_cast<double>(frame.step) * scene_.dt_s;
    tally_.check(std::abs(frame.time_s - time),
                 {0x1p-52 * time, "s", "time = step * dt, one product in double here and there"},
                 Where::frame(step_, "time"));
    const bool has_end = has(header_, core::Group::kBodies) && judge_end_states(frame);
    const bool has_detection = has(header_, core::Group::kDetection) && judge_detection(frame);
    if (!is_method_) return;
    if (has_detection) judge_integration(frame, evidence.previous);
    if (has(header_, core::Group::kContacts)) judge_ids(frame);
    if (is_colored_ && has_detection && has_end) {
      judge_chain(frame);
      judge_domain(frame);
    }
  }

  core::Verdict conclude() override {
    std::string notes;
    if (outside_ > 0)
      notes = std::to_string(outside_) + " times a body ended outside the domain by more than the slop, at most " +
              number_text(deepest_m_) + " m, with its face contact recorded";
    return tally_.conclude("no frames", notes);
  }

 private:
  bool has_size(std::size_t size, std::string_view field) {
    const bool ok = size == scene_.bodies.size();
    if (!ok) tally_.require(false, "one entry per body of the scene", Where::frame(step_, field));
    return ok;
  }

  bool judge_end_states(const FrameRecord& frame) {
    if (!has_size(frame.position.size(), "bodies.position") || !has_size(frame.velocity.size(), "bodies.velocity") ||
        !has_size(frame.orientation.size(), "bodies.orientation") ||
        !has_size(frame.angular_velocity.size(), "bodies.angular_velocity"))
      return false;
    for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
      judge_finite(frame.position[i], i, "bodies.position");
      judge_finite(frame.velocity[i], i, "bodies.velocity");
      judge_finite(frame.angular_velocity[i], i, "bodies.angular_velocity");
      const core::Quat q = frame.orientation[i];
      tally_.require(is_finite(q), kFinite, Where::body(step_, i, "bodies.orientation"));
      const double square = double(q.w) * q.w + double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z;
      tally_.check(std::abs(square - 1.0),
                   {2.0 * rounding(5), "", "normalizing in float: 5 operations a component, doubled by the square"},
                   Where::body(step_, i, "bodies.orientation"));
      if (translates_) judge_turning(frame, i);
      if (!is_method_ && header_.driver.empty()) judge_static(frame, i);
    }
    return true;
  }

  // What cannot move stays where the scene put it. An engine may hold the center of mass, in float32, and give the
  // origin back. (center-of-mass judges the method's.)
  void judge_static(const FrameRecord& frame, std::uint32_t i) {
    const core::Body& body = scene_.bodies[i];
    if (body.inverse_mass > 0.0F) return;
    const double size = length(Vec3d(local_[i].min)) + length(Vec3d(local_[i].max));
    tally_.check(largest_component(Vec3d(frame.position[i]) - Vec3d(body.position)),
                 {rounding(8) * (length(Vec3d(body.position)) + size) + kSubnormal, "m", kStays},
                 Where::body(step_, i, "bodies.position"));
    const core::Quat p = frame.orientation[i];
    const core::Quat q = body.orientation;
    // q and -q are one orientation.
    const double sign =
        double(p.w) * q.w + double(p.x) * q.x + double(p.y) * q.y + double(p.z) * q.z < 0.0 ? -1.0 : 1.0;
    const double turned = std::max({std::abs(p.w - sign * q.w), std::abs(p.x - sign * q.x), std::abs(p.y - sign * q.y),
                                    std::abs(p.z - sign * q.z)});
    tally_.check(turned, {rounding(8), "", kStays}, Where::body(step_, i, "bodies.orientation"));
  }

  // A body of the method translates only: it keeps the orientation that it had, and has no angular velocity.
  void judge_turning(const FrameRecord& frame, std::uint32_t i) {
    if (!(scene_.bodies[i].angular_velocity == Vec3{})) return;
    tally_.require(frame.angular_velocity[i] == Vec3{}, kTranslates, Where::body(step_, i, "bodies.angular_velocity"));
    tally_.require(frame.orientation[i] == scene_.bodies[i].orientation, kTranslates,
                   Where::body(step_, i, "bodies.orientation"));
  }

  bool judge_detection(const FrameRecord& frame) {
    if (!has_size(frame.detected_position.size(), "detection.position") ||
        !has_size(frame.detected_velocity.size(), "detection.velocity") || !has_size(frame.boxes.size(), "boxes"))
      return false;
    for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
      judge_finite(frame.detected_position[i], i, "detection.position");
      judge_finite(frame.detected_velocity[i], i, "detection.velocity");
      const core::Box& box = frame.boxes[i];
      judge_finite(box.min, i, "boxes");
      judge_finite(box.max, i, "boxes");
      tally_.require(box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z, "a box has min <= max",
                     Where::body(step_, i, "boxes"));
      if (is_method_) judge_box(box, frame.detected_position[i], i);
    }
    return true;
  }

  void judge_finite(Vec3 v, std::uint32_t body, std::string_view field) {
    tally_.require(validation::is_finite(v), kFinite, Where::body(step_, body, field));
  }

  void judge_box(const core::Box& box, Vec3 x, std::uint32_t body) {
    for (int k = 0; k < 3; ++k) {
      judge_bound(box.min[k], static_cast<double>(local_[body].min[k]) + x[k], body);
      judge_bound(box.max[k], static_cast<double>(local_[body].max[k]) + x[k], body);
    }
  }

  void judge_bound(float bound, double expected, std::uint32_t body) {
    tally_.check(
        std::abs(bound - expected),
        {rounding(1) * std::abs(expected) + kSubnormal, "m", "P(5): the shape's box moved, one addition (float32)"},
        Where::body(step_, body, "boxes"));
  }

  void judge_integration(const FrameRecord& frame, const FrameRecord* previous) {
    const bool is_first = frame.step == 1;
    const bool follows = previous != nullptr && previous->step + 1 == frame.step &&
                         previous->position.size() == scene_.bodies.size() &&
                         previous->velocity.size() == scene_.bodies.size();
    if (!is_first && !follows) return;
    for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
      const Vec3 x0 = is_first ? scene_.bodies[i].position : previous->position[i];
      const Vec3 v0 = is_first ? scene_.bodies[i].velocity : previous->velocity[i];
      const Vec3 x1 = frame.detected_position[i];
      const Vec3 v1 = frame.detected_velocity[i];
      const bool is_static = !(scene_.bodies[i].inverse_mass > 0.0F);
      const double dt = scene_.dt_s;
      for (int k = 0; k < 3; ++k) {
        const double pull = is_static ? 0.0 : dt * scene_.gravity_m_s2[k];
        const double move = is_static ? 0.0 : dt * v1[k];
        const double v_limit = is_static ? 0.0 : rounding(1) * (std::abs(v1[k]) + std::abs(pull)) + 2.0 * kSubnormal;
        const double x_limit = is_static ? 0.0 : rounding(1) * (std::abs(x1[k]) + std::abs(move)) + 2.0 * kSubnormal;
        // What springs add to gravity is checked by stability.
        if (has_spring_[i] == 0)
          tally_.check(std::abs(v1[k] - (v0[k] + pull)), {v_limit, "m/s", kIntegration},
                       Where::body(step_, i, "detection.velocity"));
        tally_.check(std::abs(x1[k] - (x0[k] + move)), {x_limit, "m", kIntegration},
                     Where::body(step_, i, "detection.position"));
      }
    }
  }

  void judge_ids(const FrameRecord& frame) {
    for (const core::Contact& c : frame.contacts)
      tally_.require(!core::is_face(c.a) && c.a < c.b && bodies_.application(c).has_value(),
                     "a contact names two different bodies, a below b, of which one can move",
                     Where::pair(step_, c.a, c.b, "contacts"));
  }

  // Each contact starts where the body's last one ended; the frame ends there too, clipped.
  void judge_chain(const FrameRecord& frame) {
    state_.resize(scene_.bodies.size());
    for (std::uint32_t i = 0; i < scene_.body_count(); ++i)
      state_[i] = {frame.detected_position[i], frame.detected_velocity[i]};
    for (const core::Contact& c : frame.contacts) {
      if (!bodies_.application(c)) continue;
      link(c.pre_a, c.post_a, c.a);
      if (!core::is_face(c.b)) link(c.pre_b, c.post_b, c.b);
    }
    for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
      // Whether a static body may move at all is checked by center-of-mass.
      if (!(scene_.bodies[i].inverse_mass > 0.0F)) {
        tally_.check(largest_component(Vec3d(frame.velocity[i]) - Vec3d(frame.detected_velocity[i])),
                     {0.0, "m/s", kChain}, Where::body(step_, i, "bodies.velocity"));
        continue;
      }
      const double v_max = scene_.parameters.v_max_m_s;
      const Vec3d clipped{std::clamp<double>(state_[i].v.x, -v_max, v_max),
                          std::clamp<double>(state_[i].v.y, -v_max, v_max),
                          std::clamp<double>(state_[i].v.z, -v_max, v_max)};
      tally_.check(largest_component(Vec3d(frame.position[i]) - Vec3d(state_[i].x)), {0.0, "m", kChain},
                   Where::body(step_, i, "bodies.position"));
      tally_.check(largest_component(Vec3d(frame.velocity[i]) - clipped), {0.0, "m/s", kChain},
                   Where::body(step_, i, "bodies.velocity"));
    }
  }

  void link(const Kinematics& pre, const Kinematics& post, std::uint32_t body) {
    if (!(scene_.bodies[body].inverse_mass > 0.0F)) return;
    const double off = std::max(largest_component(Vec3d(pre.x) - Vec3d(state_[body].x)),
                                largest_component(Vec3d(pre.v) - Vec3d(state_[body].v)));
    tally_.check(off, {0.0, "m or m/s", kChain}, Where::body(step_, body, "contact.pre"));
    state_[body] = post;
  }

  void judge_domain(const FrameRecord& frame) {
    met_.assign(scene_.bodies.size(), 0);
    for (const core::Contact& c : frame.contacts)
      if (core::is_face(c.b) && bodies_.application(c)) met_[c.a] |= 1U << (c.b - core::kFirstFace);
    for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
      if (!(scene_.bodies[i].inverse_mass > 0.0F)) continue;
      for (std::uint32_t face = 0; face < static_cast<std::uint32_t>(core::kFaceCount); ++face)
        judge_face(frame.position[i], i, face);
    }
  }

  void judge_face(Vec3 x, std::uint32_t body, std::uint32_t face) {
    const int axis = static_cast<int>(face >> 1U);
    const bool is_upper = (face & 1U) != 0;
    const double local = is_upper ? local_[body].max[axis] : local_[body].min[axis];
    const double wall = is_upper ? scene_.domain.max[axis] : scene_.domain.min[axis];
    const double bound = local + x[axis];
    const double outside = is_upper ? bound - wall : wall - bound;
    const double error = rounding(1) * std::abs(bound);
    // A body pushed in by the opposite face, later in the order, may stick out here when the domain is narrower.
    const bool is_met = (met_[body] & (1U << face | 1U << (face ^ 1U))) != 0;
    if (!is_met) {
      tally_.check(outside, {error, "m", "outside a face without a contact with it: u |bound| (METHOD 4, float32)"},
                   Where::pair(step_, body, core::kFirstFace + face, "bodies.position"));
      return;
    }
    if (outside > scene_.parameters.delta_m + error) {
      ++outside_;
      deepest_m_ = std::max(deepest_m_, outside);
    }
  }

  static constexpr std::string_view kFinite = "every number of a state is finite";
  static constexpr std::string_view kIntegration = "P(2), P(3): one product and one addition (float32)";
  static constexpr std::string_view kTranslates = "METHOD 1: bodies only translate, so they keep their orientation";
  static constexpr std::string_view kStays = "a static body stays: rounding of its pose (float32)";
  static constexpr std::string_view kChain = "states are handed on from contact to contact unchanged";

  const core::TraceHeader& header_;
  const core::Scene& scene_;
  ContactBodies bodies_;
  bool is_method_;
  bool translates_;
  bool is_colored_;
  std::vector<core::Box> local_;
  std::vector<std::uint8_t> has_spring_;
  std::vector<Kinematics> state_;
  std::vector<std::uint32_t> met_;
  std::uint64_t step_ = 0;
  Tally tally_{"state-sanity", "properties of states", "finite, unit, and one step after the frame before"};
  std::uint64_t outside_ = 0;
  double deepest_m_ = 0.0;
};

std::string why_not(const Subject& subject) {
  if (!has(subject.header, core::Group::kBodies) && !has(subject.header, core::Group::kDetection))
    return "the trace records no states";
  return {};
}

}  // namespace

ValidatorRow state_sanity_row() {
  return {"state-sanity",
          "states are finite, orientations unit, bodies inside the domain or reported, and each frame follows from the "
          "last",
          "NaN; drift; a stale state",
          core::bit(core::Group::kBodies) | core::bit(core::Group::kDetection) | core::bit(core::Group::kContacts),
          0,
          why_not,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<StateSanity>(subject); }};
}

}  // namespace broadside::validation
