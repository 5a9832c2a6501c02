#include "validation/state_sanity.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/scene/shapes.hpp"
#include "validation/application.hpp"
#include "validation/hand_over.hpp"
#include "validation/part_laws.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

using core::FrameRecord;
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
                    setting(header_.stamp, "variant") != "printed-E8" && has(header_, core::Group::kContacts)),
        is_summed_(is_method_ && setting(header_.stamp, "solver") == "jacobi" && has(header_, core::Group::kContacts)),
        hand_over_(header_, bodies_, local_, is_summed_) {
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
    record_.check(std::abs(frame.time_s - time),
                  {0x1p-52 * time, "s", "time = step * dt, one product in double here and there"},
                  Where::frame(step_, "time"));
    const bool has_end = has(header_, core::Group::kBodies) && judge_end_states(frame);
    const bool has_detection = has(header_, core::Group::kDetection) && judge_detection(frame);
    if (!is_method_) return;
    if (has_detection) judge_integration(frame, evidence.previous);
    if (has(header_, core::Group::kContacts)) judge_ids(frame);
    if ((is_colored_ || is_summed_) && has_detection && has_end) hand_over_.look(frame);
  }

  core::Verdict conclude() override {
    const PartLaw laws[] = {
        {record_, "time is step times dt, every body has its entry, and contacts name bodies that exist", "no frames"},
        {finite_, "every number of a state is finite, and boxes have min <= max", "no frames"},
        {unit_, "orientations are unit quaternions", "the trace records no end-of-frame states"},
        {translation_, "bodies of the method only translate", "no body of the method starts without turning"},
        {static_, "a body that cannot move stays where the scene put it",
         "no static body of an engine of another method"},
        {boxes_, "a body's box is its shape's box, moved to its position", "no boxes of the method"},
        {integration_, "each frame starts from the one before, moved by P(1) to P(3)",
         "no two steps of the method in a row, with states at detection"},
        {hand_over_.hand_over(), "a contact starts from the state that the body's previous contact left",
         "no contacts of the solvers colored and jacobi"},
        {hand_over_.domain(), "a body that ends outside a face has a contact with it",
         "no contacts of the solvers colored and jacobi"},
    };
    return sum_up(
        laws,
        {"state-sanity", "properties of states", "finite, unit quaternions, and one step after the previous frame"},
        "no frames", hand_over_.notes());
  }

 private:
  bool has_size(std::size_t size, std::string_view field) {
    const bool ok = size == scene_.bodies.size();
    if (!ok) record_.require(false, "one entry per body of the scene", Where::frame(step_, field));
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
      finite_.require(is_finite(q), kFinite, Where::body(step_, i, "bodies.orientation"));
      const double square = double(q.w) * q.w + double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z;
      unit_.check(std::abs(square - 1.0), {2.0 * rounding(5), "", kUnit}, Where::body(step_, i, "bodies.orientation"));
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
    static_.check(largest_component(Vec3d(frame.position[i]) - Vec3d(body.position)),
                  {rounding(8) * (length(Vec3d(body.position)) + size) + kSubnormal, "m", kStays},
                  Where::body(step_, i, "bodies.position"));
    const core::Quat p = frame.orientation[i];
    const core::Quat q = body.orientation;
    // q and -q are one orientation.
    const double sign =
        double(p.w) * q.w + double(p.x) * q.x + double(p.y) * q.y + double(p.z) * q.z < 0.0 ? -1.0 : 1.0;
    const double turned = std::max({std::abs(p.w - sign * q.w), std::abs(p.x - sign * q.x), std::abs(p.y - sign * q.y),
                                    std::abs(p.z - sign * q.z)});
    static_.check(turned, {rounding(8), "", kStays}, Where::body(step_, i, "bodies.orientation"));
  }

  // A body of the method translates only: it keeps the orientation that it had, and has no angular velocity.
  void judge_turning(const FrameRecord& frame, std::uint32_t i) {
    if (!(scene_.bodies[i].angular_velocity == Vec3{})) return;
    translation_.require(frame.angular_velocity[i] == Vec3{}, kTranslates,
                         Where::body(step_, i, "bodies.angular_velocity"));
    translation_.require(frame.orientation[i] == scene_.bodies[i].orientation, kTranslates,
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
      finite_.require(box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z,
                      "a box has min <= max", Where::body(step_, i, "boxes"));
      if (is_method_) judge_box(box, frame.detected_position[i], i);
    }
    return true;
  }

  void judge_finite(Vec3 v, std::uint32_t body, std::string_view field) {
    finite_.require(validation::is_finite(v), kFinite, Where::body(step_, body, field));
  }

  void judge_box(const core::Box& box, Vec3 x, std::uint32_t body) {
    for (int k = 0; k < 3; ++k) {
      judge_bound(box.min[k], static_cast<double>(local_[body].min[k]) + x[k], body);
      judge_bound(box.max[k], static_cast<double>(local_[body].max[k]) + x[k], body);
    }
  }

  void judge_bound(float bound, double expected, std::uint32_t body) {
    boxes_.check(std::abs(bound - expected), {rounding(1) * std::abs(expected) + kSubnormal, "m", kBoxes},
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
      if (!is_static && has_spring_[i] == 0 && !(x0 == x1 && v0 == v1)) integration_.note_moved();
      for (int k = 0; k < 3; ++k) {
        const double pull = is_static ? 0.0 : dt * scene_.gravity_m_s2[k];
        const double move = is_static ? 0.0 : dt * v1[k];
        const double v_limit = is_static ? 0.0 : rounding(1) * (std::abs(v1[k]) + std::abs(pull)) + 2.0 * kSubnormal;
        const double x_limit = is_static ? 0.0 : rounding(1) * (std::abs(x1[k]) + std::abs(move)) + 2.0 * kSubnormal;
        // What springs add to gravity is checked by stability.
        if (has_spring_[i] == 0)
          integration_.check(std::abs(v1[k] - (v0[k] + pull)), {v_limit, "m/s", kIntegration},
                             Where::body(step_, i, "detection.velocity"));
        integration_.check(std::abs(x1[k] - (x0[k] + move)), {x_limit, "m", kIntegration},
                           Where::body(step_, i, "detection.position"));
      }
    }
  }

  void judge_ids(const FrameRecord& frame) {
    for (const core::Contact& c : frame.contacts)
      record_.require(!core::is_face(c.a) && c.a < c.b && bodies_.application(c).has_value(),
                      "a contact names two different bodies, a below b, of which one can move",
                      Where::pair(step_, c.a, c.b, "contacts"));
  }

  static constexpr std::string_view kFinite = "every number of a state is finite";
  static constexpr std::string_view kUnit = "normalizing in float: 5 operations a component, doubled by the square";
  static constexpr std::string_view kBoxes = "P(5): the shape's box moved, one addition (float32)";
  static constexpr std::string_view kIntegration = "P(2), P(3): one product and one addition (float32)";
  static constexpr std::string_view kTranslates = "METHOD 1: bodies only translate, so they keep their orientation";
  static constexpr std::string_view kStays = "a static body stays: rounding of its pose (float32)";

  const core::TraceHeader& header_;
  const core::Scene& scene_;
  ContactBodies bodies_;
  bool is_method_;
  bool translates_;
  bool is_colored_;
  bool is_summed_;  // jacobi
  std::vector<core::Box> local_;
  std::vector<std::uint8_t> has_spring_;
  std::uint64_t step_ = 0;
  HandOver hand_over_;
  Tally record_{"record", "frames, lists and contacts", "one entry per body of the scene"};
  Tally finite_{"finite", "numbers of states", kFinite};
  Tally unit_{"unit-orientation", "orientations", kUnit};
  Tally translation_{"translation", "orientations and angular velocities", kTranslates};
  Tally static_{"static", "poses of static bodies", kStays};
  Tally boxes_{"moved-boxes", "sides of boxes", kBoxes};
  Tally integration_{"integration", "components of integrated states", kIntegration};
};

std::string why_not_state_sanity(const Subject& subject) {
  if (!has(subject.header, core::Group::kBodies) && !has(subject.header, core::Group::kDetection))
    return "the trace records no states";
  return {};
}

}  // namespace

ValidatorRow state_sanity_row() {
  return {"state-sanity",
          "states are finite, orientations are unit quaternions, bodies are inside the domain or in contact with "
          "its faces, and each frame follows from the previous one",
          "NaN; drift; a stale state",
          core::bit(core::Group::kBodies) | core::bit(core::Group::kDetection) | core::bit(core::Group::kContacts),
          0,
          why_not_state_sanity,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<StateSanity>(subject); },
          false,
          false,
          true};
}

}  // namespace broadside::validation
