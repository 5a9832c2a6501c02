#include "validation/friction_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/application.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

class FrictionEnergy final : public Validator {
 public:
  explicit FrictionEnergy(const Subject& subject) : bodies_(subject.header.scene) {}

  void look(const Evidence& evidence) override {
    double frame_work = 0.0;
    for (const core::Contact& contact : evidence.frame.contacts) {
      const auto app = bodies_.application(contact);
      if (app) frame_work += judge(*app, evidence.frame.step);
    }
    work_j_ += frame_work;
    if (frame_work < hardest_frame_j_) {
      hardest_frame_j_ = frame_work;
      hardest_step_ = evidence.frame.step;
    }
  }

  core::Verdict conclude() override {
    std::string notes = "friction did " + number_text(work_j_) + " J of work in all";
    if (hardest_frame_j_ < 0.0)
      notes +=
          ", most of it in step " + std::to_string(hardest_step_) + " with " + number_text(hardest_frame_j_) + " J";
    notes += "; " + std::to_string(sticking_) + " stuck, " + std::to_string(sliding_) + " slid";
    return tally_.conclude("no contacts", notes);
  }

 private:
  // Returns the work that friction did, J.
  double judge(const Application& app, std::uint64_t step) {
    const core::Contact& c = *app.contact;
    const double band = app.approach_rounding();
    const double slide = app.sliding_rounding();
    const double after_error = app.sliding_after_rounding();
    const double speed = length(app.sliding_before);
    const double speed_after = length(app.sliding_after);
    const auto at = [&](std::string_view field) { return Where::pair(step, c.a, c.b, field); };

    if (app.approach_before >= band) {
      const double changed = length(app.sliding_after - app.sliding_before) + std::abs(c.tangent_impulse_n_s);
      tally_.check(changed, {0.0, "m/s", "a separating contact changes nothing (METHOD 6)"}, at("contact.post.v"));
      tally_.check(largest_component(Vec3d(c.tangent)), {0.0, "", kNoTangent}, at("contact.tangent"));
      return 0.0;
    }

    const double work = 0.5 * (speed_after - speed) * (speed_after + speed) / app.w_sum;
    const double error = slide + rounding(9) * speed + after_error;
    tally_.check(work,
                 {speed_after * error / app.w_sum, "J",
                  "|v_t'| E / (wA + wB), E = 11 operations on v_t and the additions to both velocities (float32)"},
                 at("contact.post.v"));

    const double recorded = c.tangent_impulse_n_s;
    const Vec3d tangent(c.tangent);
    const Vec3d unexplained = (app.sliding_after - app.sliding_before) - (app.w_sum * recorded) * tangent;
    tally_.check(length(unexplained),
                 {after_error, "m/s",
                  "the recorded impulse accounts for the change of v_t, within the rounding of the "
                  "additions to both velocities"},
                 at("contact.tangent_impulse"));
    // Along an axis neither the normal's products nor the difference of equal components round: zero is exact.
    if (is_axis(app.normal) && speed == 0.0) {
      tally_.check(std::abs(recorded), {0.0, "N s", kNoTangent}, at("contact.tangent_impulse"));
      tally_.check(largest_component(tangent), {0.0, "", kNoTangent}, at("contact.tangent"));
    }
    // A direction is meaningful only when the sliding is larger than its own rounding error. A contact that may have
    // counted as separating may have none.
    const bool has_none = app.approach_before >= -band && recorded == 0.0 && c.tangent == core::Vec3{};
    if (speed > slide && !has_none) {
      const double off = length(tangent - (1.0 / speed) * app.sliding_before);
      tally_.check(off, {slide / (speed - 0.5 * slide) + rounding(4), "rad", "tangent = v_t / |v_t|, to S / |v_t|"},
                   at("contact.tangent"));
    }
    judge_cone(app, speed, slide, band, at("contact.tangent_impulse"));
    return work;
  }

  void judge_cone(const Application& app, double speed, double slide, double band, const Where& where) {
    const double normal = std::max(0.0F, app.contact->normal_impulse_n_s);
    const double recorded = app.contact->tangent_impulse_n_s;
    const double stop = speed / app.w_sum;
    const double cone = app.surface.mu_static * normal;
    const double stop_error = slide / app.w_sum + rounding(5) * stop;
    const bool may_stick = stop <= cone + stop_error + rounding(3) * cone;
    const bool may_slide = stop >= cone - stop_error - rounding(3) * cone;
    ++(may_slide ? sliding_ : sticking_);
    // Of the answers that rounding leaves open, the one nearest to the record.
    double off = std::numeric_limits<double>::infinity();
    double limit = 0.0;
    const auto allow = [&](double expected, double error) {
      const double now = std::abs(recorded - expected);
      if (!(now - error < off - limit)) return;
      off = now;
      limit = error;
    };
    if (may_stick) allow(-stop, stop_error);
    if (may_slide) allow(-app.surface.mu_kinetic * normal, rounding(3) * app.surface.mu_kinetic * normal + kSubnormal);
    // The sliding may be all rounding error, or the contact may have counted as separating: then no friction is right
    // too.
    if (speed <= slide || app.approach_before >= -band) allow(0.0, 0.0);
    if (std::isnan(recorded) || std::isnan(speed)) off = std::numeric_limits<double>::quiet_NaN();
    tally_.check(
        off,
        {limit, "N s",
         "stick: -|v_t| / (wA + wB) up to mu_s J_n, S and 5 operations; slide: -mu_k J_n, 3 operations (METHOD 6)"},
        where);
  }

  static bool is_axis(Vec3d n) {
    int others = 0;
    for (int k = 0; k < 3; ++k) others += n[k] == 0.0 ? 1 : 0;
    return others == 2;
  }

  static constexpr std::string_view kNoTangent = "where nothing slides there is no tangent and no friction (METHOD 6)";

  ContactBodies bodies_;
  Tally tally_{"friction-energy", "energies, impulses and directions", "METHOD 6 and E6: friction opposes sliding"};
  double work_j_ = 0.0;
  double hardest_frame_j_ = 0.0;
  std::uint64_t hardest_step_ = 0;
  std::uint64_t sticking_ = 0;
  std::uint64_t sliding_ = 0;
};

std::string why_not_friction_energy(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kContacts)); !text.empty()) return text;
  return why_not_method(subject.header);
}

}  // namespace

ValidatorRow friction_energy_row() {
  return {
      "friction-energy",
      "friction never adds energy, opposes sliding, and stays in its cone",
      "printed-E6",
      core::bit(core::Group::kContacts),
      0,
      why_not_friction_energy,
      [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<FrictionEnergy>(subject); }};
}

}  // namespace broadside::validation
