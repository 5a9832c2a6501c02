#include "validation/velocity_cap.hpp"

#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"
#include "validation/vec3d.hpp"

namespace broadside::validation {
namespace {

class VelocityCap final : public Validator {
 public:
  explicit VelocityCap(const Subject& subject) : scene_(subject.header.scene) {}

  void look(const Evidence& evidence) override {
    const auto& velocity = evidence.frame.velocity;
    for (std::uint32_t i = 0; i < velocity.size() && i < scene_.body_count(); ++i) {
      if (!(scene_.bodies[i].inverse_mass > 0.0F)) continue;
      tally_.check(largest_component(Vec3d(velocity[i])),
                   {scene_.parameters.v_max_m_s, "m/s", "P(23): v_max, a comparison, which does not round"},
                   Where::body(evidence.frame.step, i, "bodies.velocity"));
    }
  }

  core::Verdict conclude() override { return tally_.conclude("no dynamic body in any recorded frame"); }

 private:
  const core::Scene& scene_;
  Tally tally_{"velocity-cap", "velocities", "P(23): v_max, a comparison, which does not round"};
};

std::string why_not_velocity_cap(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kBodies)); !text.empty()) return text;
  return why_not_method(subject.header);
}

}  // namespace

ValidatorRow velocity_cap_row() {
  return {"velocity-cap",
          "every velocity component ends a frame within v_max",
          "a component above v_max; NaN",
          core::bit(core::Group::kBodies),
          0,
          why_not_velocity_cap,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<VelocityCap>(subject); }};
}

}  // namespace broadside::validation
