#include <algorithm>
#include <vector>

#include "validation/mechanics/motion.hpp"
#include "validation/mechanics/sleeping.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

constexpr double kPointsOfAPatch = 4.0;
// Operations on a component of the velocity beside the applications: m dv and m g h, and two turns, of 5 each, in
// engines that hold velocities in the body's axes.
constexpr double kOfAxes = 14.0;

// What a body was given in one step.
struct Given {
  Vec3d impulse;           // N s
  double magnitude = 0.0;  // sum of |J|
  double pushed = 0.0;     // the fastest speed, m/s, at which a declared correction parts the body from another one
  double points = 0.0;
};

class Momentum final : public Validator {
 public:
  explicit Momentum(const Subject& subject)
      : header_(subject.header),
        has_points_(has_impulses(header_)),
        accumulations_(header_.declaration.number("iterations") * header_.declaration.number("substeps")),
        rate_(correction_rate(header_)),
        sleep_speed_m_s_(header_.declaration.number("sleep_speed_m_s")) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    if (has_points_)
      judge_bodies(*evidence.motion, evidence.frame);
    else
      judge_sets(*evidence.motion);
  }

  core::Verdict conclude() override {
    return tally_.conclude("no step could be judged, neither of one body nor of a group of touching bodies");
  }

 private:
  void judge_bodies(const Motion& m, const core::FrameRecord& frame) {
    given_.swap(before_);
    if (m.step != last_step_ + 1) before_.clear();
    last_step_ = m.step;
    before_.resize(m.bodies.size());
    given_.assign(m.bodies.size(), {});
    const auto give = [&](std::uint32_t body, double sign, Vec3d j, double depth_m) {
      if (core::is_face(body)) return;
      given_[body].pushed = std::max(given_[body].pushed, rate_ * depth_m / m.h);
      given_[body].impulse = given_[body].impulse + sign * j;
      given_[body].magnitude += length(j);
      given_[body].points += 1.0;
    };
    for (const core::ContactPoint& p : frame.points) {
      give(p.a, 1.0, Vec3d(p.impulse), -p.gap_m);
      give(p.b, -1.0, Vec3d(p.impulse), -p.gap_m);
    }
    for (std::uint32_t i = 0; i < m.bodies.size(); ++i) {
      const BodyFacts& f = m.facts[i];
      if (!f.is_dynamic || f.has_spring) continue;
      if (has_moved(m.bodies[i])) tally_.note_moved();
      const BodyStep& b = m.bodies[i];
      const Vec3d change = f.mass_kg * (b.after.v - b.before.v);
      const Vec3d expected = (f.mass_kg * m.h) * b.acceleration + given_[i].impulse;
      // Solvers begin with the impulses of the step before, and take back what is too much. They also take back the
      // speed at which a correction parts bodies.
      const double speed = length(b.before.v) + length(b.after.v) + m.h * length(b.acceleration) + given_[i].pushed +
                           (given_[i].magnitude + before_[i].magnitude) / f.mass_kg;
      // A touching body may get impulses that are taken back later, so that no point records them: those of one patch.
      const double applied = given_[i].points + (b.is_alone ? 0.0 : kPointsOfAPatch);
      // Each application adds to the velocity once, in the engine's precision; impulses are recorded in float32.
      const double limit = m.rounding_of(kOfAxes + 2 * accumulations_ * applied) * f.mass_kg * speed +
                           rounding(4) * given_[i].magnitude + kSubnormal + f.mass_kg * m.h * b.acceleration_slack +
                           f.mass_kg * slack_of_sleep_m_s(b, f, sleep_speed_m_s_);
      tally_.check(
          length(change - expected), {limit, "N s", kOfBodies}, Where::body(m.step, i, "bodies.velocity"),
          [&] { return "m dv = " + vector_text(change) + " N s, m g h + sum J = " + vector_text(expected) + " N s"; });
    }
  }

  void judge_sets(const Motion& m) {
    const std::size_t n = m.bodies.size();
    change_.assign(n, {});
    expected_.assign(n, {});
    scale_.assign(n, 0.0);
    slack_.assign(n, 0.0);
    members_.assign(n, 0);
    moving_.assign(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      const BodyFacts& f = m.facts[i];
      const std::uint32_t set = m.bodies[i].set;
      if (!f.is_dynamic || m.set_is_free[set] == 0) continue;
      const BodyStep& b = m.bodies[i];
      change_[set] = change_[set] + f.mass_kg * (b.after.v - b.before.v);
      expected_[set] = expected_[set] + (f.mass_kg * m.h) * b.acceleration;
      slack_[set] += f.mass_kg * m.h * b.acceleration_slack;
      scale_[set] += f.mass_kg * (length(b.before.v) + length(b.after.v) + m.h * length(b.acceleration));
      ++members_[set];
      if (has_moved(b)) ++moving_[set];
    }
    for (std::uint32_t set = 0; set < n; ++set) {
      if (members_[set] < 2) continue;  // a body alone is ballistic's
      if (moving_[set] > 0) tally_.note_moved();
      // Where no points are recorded, every body of a set may have pushed every other.
      const double limit =
          m.rounding_of(4 + 2 * accumulations_ * static_cast<double>(members_[set])) * scale_[set] + slack_[set];
      tally_.check(length(change_[set] - expected_[set]), {limit, "N s", kOfSets},
                   Where::body(m.step, set, "bodies.velocity"), [&] {
                     return "sum m dv = " + vector_text(change_[set]) +
                            " N s, sum m g h = " + vector_text(expected_[set]) + " N s over " +
                            std::to_string(members_[set]) + " bodies";
                   });
    }
  }

  static constexpr std::string_view kOfBodies =
      "rounding: one addition an application, of impulses of this step and of the one before, with which solvers "
      "begin, and of the speed at which a declared correction parts bodies; impulses recorded in float32; twice the "
      "declared speed of sleep of a body that stands still; for the exact solve nothing else";
  static constexpr std::string_view kOfSets = "rounding: one addition an application";
  const core::TraceHeader& header_;
  bool has_points_;
  double accumulations_;
  double rate_;
  double sleep_speed_m_s_;
  std::vector<Given> given_;
  std::vector<Given> before_;  // in the step before
  std::uint64_t last_step_ = 0;
  std::vector<Vec3d> change_;
  std::vector<Vec3d> expected_;
  std::vector<double> scale_;
  std::vector<double> slack_;
  std::vector<std::uint32_t> members_;
  std::vector<std::uint32_t> moving_;
  Tally tally_{"momentum", "momenta", kOfBodies};
};

std::string why_not_momentum(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kBodies)); !text.empty()) return text;
  // METHOD clips velocities, and center-of-mass judges each of its applications.
  if (subject.header.declaration.follows_method())
    return "the validator center-of-mass judges each application of the method";
  return {};
}

}  // namespace

ValidatorRow momentum_row() {
  return {"momentum",
          "m dv = m g h + the impulses reported for the body; where none are reported, summed over each set of "
          "bodies that touch",
          "an impulse on one side only; invented or lost momentum",
          core::bit(core::Group::kBodies) | core::bit(core::Group::kPoints),
          0,
          why_not_momentum,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Momentum>(subject); },
          false,
          true,
          true};
}

}  // namespace broadside::validation
