#include <algorithm>
#include <vector>

#include "validation/mechanics/motion.hpp"
#include "validation/mechanics/scene_answer.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

// How far a body may settle, as a share of its smallest side: a hundredth on rigid contacts, a twentieth on compliant
// ones, which sink in. A minute of creep afterwards may move it as far again.
constexpr double kRigidShare = 0.01;
constexpr double kCompliantShare = 0.05;
constexpr double kMinute_s = 60.0;
// Bodies settle within this; creep is measured after it.
constexpr double kSettled_s = 1.0;

class Rest final : public Validator {
 public:
  explicit Rest(const Subject& subject)
      : share_(subject.header.declaration.is_compliant() ? kCompliantShare : kRigidShare),
        slop_m_(subject.header.scene.parameters.delta_m) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    const double time = static_cast<double>(m.step) * m.h;
    if (start_.empty())
      for (const BodyStep& b : m.bodies) start_.push_back(b.before.x);
    if (settled_.empty() && time >= kSettled_s) {
      for (const BodyStep& b : m.bodies) settled_.push_back(b.after.x);
      settled_at_ = time;
    }
    for (std::uint32_t i = 0; i < m.bodies.size(); ++i) {
      const BodyFacts& f = m.facts[i];
      if (!f.is_dynamic) continue;
      const double allowed = share_ * f.smallest_side_m + slop_m_ * static_cast<double>(m.bodies.size());
      const Vec3d moved = m.bodies[i].after.x - start_[i];
      tally_.check(length(moved), {allowed * (1.0 + time / kMinute_s), "m", kOrigin},
                   Where::body(m.step, i, "bodies.position"),
                   [&] { return "the body has moved by " + vector_text(moved) + " m in " + number_text(time) + " s"; });
      // A second of creep is the shortest that a speed is taken from.
      if (settled_.empty() || time - settled_at_ < kSettled_s) continue;
      const double creep = length(m.bodies[i].after.x - settled_[i]) / (time - settled_at_);
      tally_.check(creep, {share_ * f.smallest_side_m / kMinute_s + slop_m_ / (time - settled_at_), "m/s", kCreep},
                   Where::body(m.step, i, "bodies.position"),
                   [&] { return "it has crept at " + number_text(creep) + " m/s since it settled"; });
    }
  }

  core::Verdict conclude() override { return tally_.conclude("no step of a moving body"); }

 private:
  static constexpr std::string_view kOrigin =
      "1 % of the smallest side (5 % where contacts are compliant) and one slop for each body; as much again for each "
      "minute";
  static constexpr std::string_view kCreep = "1 % of the smallest side a minute (5 % where contacts are compliant)";
  double share_;
  double slop_m_;
  std::vector<Vec3d> start_;
  std::vector<Vec3d> settled_;
  double settled_at_ = 0.0;
  Tally tally_{"rest", "displacements", kOrigin};
};

std::string why_not_rest(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kBodies)); !text.empty()) return text;
  return subject.header.scene.answer == kStands ? "" : "the scene is not one that must stand";
}

}  // namespace

ValidatorRow rest_row() {
  return {"rest",
          "a structure that stands by the laws of statics keeps standing: its bodies stay in place and do not creep",
          "a stack that creeps 1 mm/s; a collapse",
          core::bit(core::Group::kBodies),
          0,
          why_not_rest,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Rest>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
