#include <algorithm>
#include <string>

#include "validation/mechanics/scene_answer.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

class ClosedForm final : public Validator {
 public:
  explicit ClosedForm(const Subject& subject)
      : scene_(subject.header.scene),
        order_(subject.header.declaration.number("order")),
        answer_(*find_answer(scene_.answer)) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    for (const ExactFigure& f : answer_.figures(scene_, m, order_)) {
      if (first_.empty()) first_ = f.what;
      if (f.what == first_) last_ = f.error;
      if (f.scale > 0.0) worst_share_ = std::max(worst_share_, f.error / f.scale);
      tally_.check(f.error, {f.limit, f.unit, f.scale > 0.0 ? kClasses : kOrigin}, Where::body(m.step, 0, f.what), [&] {
        return std::string(f.what) + " is off by " + number_text(f.error) + " " + std::string(f.unit) + " at " +
               number_text(static_cast<double>(m.step) * m.h) + " s, from " + std::string(answer_.what);
      });
    }
  }

  core::Verdict conclude() override {
    std::string text = std::string(first_) + " off by " + number_text(last_) + " at the end";
    if (worst_share_ >= 0.0)
      text += std::string(", class ") + (worst_share_ <= kClassA ? "A" : (worst_share_ <= kClassB ? "B" : "C"));
    return tally_.conclude("the formula says nothing about the recorded times",
                           text + "; " + std::string(answer_.what) + " (" + std::string(answer_.source) + ")");
  }

 private:
  static constexpr std::string_view kOrigin =
      "C h^p, p the declared order, C from the exact solution's derivative; where contacts begin or end, C h";
  static constexpr std::string_view kClasses = "no order is defined: class C, 20 % of the speed (A: 1 %, B: 5 %)";
  const core::Scene& scene_;
  double order_;
  const SceneAnswer& answer_;
  std::string_view first_;  // the figure that the explanation tells
  double last_ = 0.0;
  double worst_share_ = -1.0;  // of a scale; below zero = no figure had classes
  Tally tally_{"closed-form", "errors against the exact answer", kOrigin};
};

std::string why_not_closed_form(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kBodies)); !text.empty()) return text;
  const std::string& name = subject.header.scene.answer;
  if (name.empty()) return "the scene has no exact answer";
  if (name == kStands) return "the validator rest judges scenes that must stand";
  if (name == kReported) return "the scene has no agreed answer; what engines do is only reported";
  return find_answer(name) != nullptr ? "" : "the scene's answer '" + name + "' is not one that is known here";
}

}  // namespace

ValidatorRow closed_form_row() {
  return {"closed-form",
          "a scene with an exact answer ends where the answer says, within C h^p, where p is the declared order",
          "consistent errors, which no other law finds",
          core::bit(core::Group::kBodies),
          0,
          why_not_closed_form,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<ClosedForm>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
