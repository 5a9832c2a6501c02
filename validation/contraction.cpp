#include "validation/contraction.hpp"

#include <cmath>

#include "validation/application.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

class Contraction final : public Validator {
 public:
  explicit Contraction(const Subject& subject)
      : parameters_(subject.header.scene.parameters), bodies_(subject.header.scene) {}

  void look(const Evidence& evidence) override {
    for (const core::Contact& contact : evidence.frame.contacts) {
      const auto app = bodies_.application(contact);
      if (app) judge(*app, Where::pair(evidence.frame.step, contact.a, contact.b, "contact.post.x"));
    }
  }

  core::Verdict conclude() override {
    return tally_.conclude("no contacts", std::to_string(inside_slop_) + " contacts were inside the slop");
  }

 private:
  void judge(const Application& app, const Where& where) {
    const core::Contact& c = *app.contact;
    const Vec3d moved = app.moved_a - app.moved_b;
    const double depth = c.depth_m;
    const double delta = parameters_.delta_m;
    if (!(depth >= delta)) {
      ++inside_slop_;
      tally_.check(largest_component(moved), {0.0, "m", "inside the slop the correction is exactly zero (METHOD 5)"},
                   where);
      return;
    }
    const double displacement = dot(moved, app.normal);
    const double kept = 1.0 - static_cast<double>(parameters_.alpha) * parameters_.beta;
    const double expected_depth = delta + kept * (depth - delta);
    const double along = std::abs((depth - displacement) - expected_depth);
    const double across = length(moved - displacement * app.normal);
    const double positions =
        length(Vec3d(c.pre_a.x)) + length(Vec3d(c.pre_b.x)) + length(Vec3d(c.post_a.x)) + length(Vec3d(c.post_b.x));
    const double limit = rounding(1) * positions + rounding(8) * depth + 8.0 * kSubnormal;
    tally_.check(std::isnan(along) ? along : std::max(along, across),
                 {limit, "m", "u |x| per position addition and 8 operations on the displacement (METHOD 5, float32)"},
                 where);
  }

  core::Parameters parameters_;
  ContactBodies bodies_;
  Tally tally_{"contraction", "contact applications", "METHOD 5: d' - delta = (1 - alpha beta)(d - delta)"};
  std::uint64_t inside_slop_ = 0;
};

std::string why_not(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kContacts)); !text.empty()) return text;
  return why_not_method_response(subject.header);
}

}  // namespace

ValidatorRow contraction_row() {
  return {"contraction",
          "each application brings the depth to delta + (1 - alpha beta)(d - delta), and moves nothing below delta",
          "printed-E4; beta applied twice",
          core::bit(core::Group::kContacts),
          0,
          why_not,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Contraction>(subject); }};
}

}  // namespace broadside::validation
