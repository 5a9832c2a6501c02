#include "validation/contraction.hpp"

#include <cmath>
#include <limits>

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
    if (!(depth > delta)) {
      ++inside_slop_;
      tally_.check(largest_component(moved), {0.0, "m", "inside the slop the correction is exactly zero (METHOD 5)"},
                   where);
      return;
    }
    const double corrected = static_cast<double>(parameters_.alpha) * parameters_.beta * (depth - delta);
    // Axis by axis: by how much the contact was moved too far or too little, and how much of that rounding explains.
    // The axis nearest to its limit, or farthest beyond it, stands for the contact.
    double off = 0.0;
    double limit = 0.0;
    double worst = -1.0;
    for (int k = 0; k < 3; ++k) {
      const double expected = corrected * app.normal[k];
      const double now = std::abs(moved[k] - expected);
      const double error = expected == 0.0 ? 0.0 : added(app, k) + rounding(7) * std::abs(expected) + 8.0 * kSubnormal;
      constexpr double kInf = std::numeric_limits<double>::infinity();
      const double ratio =
          now == 0.0 ? (error > 0.0 ? 0.0 : -0.5) : (error > 0.0 && !std::isnan(now) ? now / error : kInf);
      if (ratio > worst) worst = ratio, off = now, limit = error;
    }
    tally_.check(off,
                 {limit, "m", "u |x| per position addition and 7 operations on the displacement (METHOD 5, float32)"},
                 where);
  }

  // Rounding of the two position additions on one axis.
  static double added(const Application& app, int axis) {
    const core::Contact& c = *app.contact;
    return rounding(1) * ((app.w_a > 0.0 ? std::abs(static_cast<double>(c.post_a.x[axis])) : 0.0) +
                          (app.w_b > 0.0 ? std::abs(static_cast<double>(c.post_b.x[axis])) : 0.0));
  }

  core::Parameters parameters_;
  ContactBodies bodies_;
  Tally tally_{"contraction", "contact applications", "METHOD 5: d' - delta = (1 - alpha beta)(d - delta)"};
  std::uint64_t inside_slop_ = 0;
};

std::string why_not_contraction(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kContacts)); !text.empty()) return text;
  return why_not_method(subject.header);
}

}  // namespace

ValidatorRow contraction_row() {
  return {"contraction",
          "each application brings the depth to delta + (1 - alpha beta)(d - delta), and moves nothing below delta",
          "printed-E4; beta applied twice",
          core::bit(core::Group::kContacts),
          0,
          why_not_contraction,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Contraction>(subject); }};
}

}  // namespace broadside::validation
