#include <algorithm>
#include <vector>

#include "validation/mechanics/motion.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

class EnergyGrowth final : public Validator {
 public:
  explicit EnergyGrowth(const Subject& subject)
      : header_(subject.header),
        scene_(header_.scene),
        correction_(header_.declaration.text("correction")),
        rate_(header_.declaration.number("correction_rate")),
        accuracy_(header_.declaration.number("accuracy")),
        accumulations_(header_.declaration.number("iterations") * header_.declaration.number("substeps")) {
    for (const core::Body& b : scene_.bodies)
      bounce_ = std::max({bounce_, static_cast<double>(b.material.restitution),
                          static_cast<double>(scene_.face_material.restitution)});
  }

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    read_depths(evidence.frame, m.bodies.size());
    const std::size_t n = m.bodies.size();
    change_.assign(n, 0.0);
    allowed_.assign(n, 0.0);
    members_.assign(n, 0);
    double total = 0.0;
    double first = 0.0;
    double all = 0.0;
    double worked = 0.0;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (!m.facts[i].is_dynamic || m.facts[i].has_spring) continue;
      const std::uint32_t set = m.bodies[i].set;
      const double e0 = energy(m, i, m.bodies[i].before);
      const double done = work(m, i);
      const double e1 = energy(m, i, m.bodies[i].after) - done;
      worked += done;
      const double slack = allowance(m, i, std::abs(e0) + std::abs(e1));
      change_[set] += e1 - e0;
      allowed_[set] += slack;
      ++members_[set];
      first += e0;
      total += e1;
      all += slack;
    }
    if (header_.declaration.is_compliant()) {
      judge_stored(m, first - worked_, total - worked_, all);
      worked_ += worked;
      return;
    }
    for (std::uint32_t set = 0; set < n; ++set)
      if (members_[set] > 0)
        tally_.check(change_[set], {allowed_[set], "J", kOrigin}, Where::body(m.step, set, "energy"), [&] {
          return "the energy of " + std::to_string(members_[set]) + " bodies that may touch changed by " +
                 number_text(change_[set]) + " J";
        });
  }

  core::Verdict conclude() override { return tally_.conclude("no step of a moving body"); }

 private:
  [[nodiscard]] static double energy(const Motion& m, std::uint32_t i, const BodyState& s) {
    const BodyFacts& f = m.facts[i];
    return 0.5 * f.mass_kg * dot(s.v, s.v) + 0.5 * dot(s.w, s.angular_momentum) - f.mass_kg * dot(m.gravity, s.x);
  }

  // Work of the scene's wrenches in this step, J.
  [[nodiscard]] static double work(const Motion& m, std::uint32_t i) {
    const BodyStep& b = m.bodies[i];
    const Vec3d force = m.facts[i].mass_kg * (b.acceleration - m.gravity);
    return dot(force, b.after.x - b.before.x) + m.h * dot(b.torque, b.after.w);
  }

  // The deepest reported overlap of each body.
  void read_depths(const core::FrameRecord& frame, std::size_t bodies) {
    depth_.assign(bodies, 0.0);
    const auto note = [&](std::uint32_t body, double depth) {
      if (!core::is_face(body)) depth_[body] = std::max(depth_[body], depth);
    };
    for (const core::ContactPoint& p : frame.points) note(p.a, -p.gap_m), note(p.b, -p.gap_m);
    for (const core::Contact& c : frame.contacts) note(c.a, c.depth_m), note(c.b, c.depth_m);
  }

  [[nodiscard]] double allowance(const Motion& m, std::uint32_t i, double magnitude) const {
    const BodyFacts& f = m.facts[i];
    const BodyStep& b = m.bodies[i];
    const double g = length(b.acceleration);
    const double weight = f.mass_kg * g;
    const double speed = std::max(length(b.before.v), length(b.after.v));
    double sum = 0.5 * weight * g * m.h * m.h;
    // A step that takes the gyroscopic torque as it was at the start changes the spin by h w x L, across w, and gains
    // half of that times the change of w (explicit Euler; seen in two libraries, which gain all of it).
    if (f.has_inertia) {
      const double l = m.h * std::max(length(cross(b.before.w, b.before.angular_momentum)),
                                      length(cross(b.after.w, b.after.angular_momentum)));
      sum += 0.5 * l * l / f.least_moment;
    }
    // The same for a torque; where body axes turn, its work is that of its mean over the step.
    if (!b.is_torque_free)
      sum += m.h * (length(b.torque) * length(b.after.w - b.before.w) +
                    b.torque_slack * std::max(length(b.before.w), length(b.after.w)));
    sum += f.mass_kg * b.acceleration_slack * length(b.after.x - b.before.x);
    if (!b.is_alone) {
      // The moment in the step at which the body bounced, or was thrown up by its spin, is not known: gravity acts for
      // up to h on the way in and on the way out.
      const double rise = g > 0.0 ? std::max(0.0, -dot(b.after.v, m.gravity) / g) : 0.0;
      sum += weight * m.h * (std::max(rise, bounce_ * speed) + m.h * g);
      const double lifted = rate_ * depth_[i];
      if (correction_ == "position") sum += weight * lifted;
      if (correction_ == "velocity") sum += weight * lifted + 0.5 * f.mass_kg * (lifted / m.h) * (lifted / m.h);
    }
    const double position = length(b.after.x) + length(b.before.x);
    const double spin = std::max(length(b.before.w), length(b.after.w));
    const double scale = magnitude + f.mass_kg * speed * speed + f.largest_moment * spin * spin;
    // Error control lets each velocity and place be off by its accuracy, relative, and energy depends on their squares.
    return sum + 2.0 * accuracy_ * scale + m.rounding_of(8 + 2 * accumulations_) * scale +
           m.rounding_of(4) * weight * position + kSubnormal;
  }

  // A compliant contact stores energy and gives it back, so the energy may rise again, but not above the highest so
  // far. Both energies are taken without the work that the scene's wrenches did so far.
  void judge_stored(const Motion& m, double before, double after, double allowed) {
    if (!has_most_) most_ = before;
    has_most_ = true;
    slack_ += allowed;
    tally_.check(after - most_, {slack_, "J", kStored}, Where::frame(m.step, "energy"),
                 [&] { return "E = " + number_text(after) + " J, the most before was " + number_text(most_) + " J"; });
    most_ = std::max(most_, before);
  }

  static constexpr std::string_view kOrigin =
      "1/2 m g^2 h^2 for each body; m g h v for one that leaves a contact upward at v; what a declared correction may "
      "lift; twice the declared accuracy; and rounding";
  static constexpr std::string_view kStored =
      "compliant contacts: the largest energy before, and the sum of the steps' limits";
  const core::TraceHeader& header_;
  const core::Scene& scene_;
  std::string_view correction_;
  double rate_;
  double accuracy_;
  double accumulations_;
  double bounce_ = 0.0;  // largest restitution
  bool has_most_ = false;
  double most_ = 0.0;
  double slack_ = 0.0;
  double worked_ = 0.0;  // by wrenches in the steps before, J
  std::vector<double> depth_;
  std::vector<double> change_;
  std::vector<double> allowed_;
  std::vector<std::uint32_t> members_;
  Tally tally_{"energy-growth", "changes of energy", kOrigin};
};

std::string why_not_energy_growth(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kBodies)); !text.empty()) return text;
  if (subject.header.declaration.follows_method())
    return "the validator energy judges the work of each stage of the method";
  return {};
}

}  // namespace

ValidatorRow energy_growth_row() {
  return {"energy-growth",
          "the sum of kinetic and potential energy of bodies that may touch does not grow in a step",
          "restitution above 1; energy + 0.1 % a frame; exploding stacks",
          core::bit(core::Group::kBodies) | core::bit(core::Group::kPoints) | core::bit(core::Group::kContacts),
          0,
          why_not_energy_growth,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<EnergyGrowth>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
