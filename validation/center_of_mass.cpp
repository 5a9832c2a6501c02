#include "validation/center_of_mass.hpp"

#include <cmath>

#include "validation/application.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

class CenterOfMass final : public Validator {
 public:
  explicit CenterOfMass(const Subject& subject) : scene_(subject.header.scene), bodies_(scene_) {}

  void look(const Evidence& evidence) override {
    const std::uint64_t step = evidence.frame.step;
    for (const core::Contact& contact : evidence.frame.contacts) {
      const auto app = bodies_.application(contact);
      if (!app) continue;
      if (app->w_a > 0.0 && app->w_b > 0.0) {
        judge_dynamic(*app, step);
        continue;
      }
      if (app->w_a > 0.0)
        judge_static(contact.pre_b, contact.post_b, contact.b, step);
      else
        judge_static(contact.pre_a, contact.post_a, contact.a, step);
    }
    judge_static_bodies(evidence.frame);
  }

  core::Verdict conclude() override {
    return tally_.conclude("no contacts and no static body", std::to_string(shared_) + " between two dynamic bodies, " +
                                                                 std::to_string(static_) + " against something static");
  }

 private:
  void judge_dynamic(const Application& app, std::uint64_t step) {
    ++shared_;
    const core::Contact& c = *app.contact;
    const double m_a = 1.0 / app.w_a;
    const double m_b = 1.0 / app.w_b;
    const double moved = length(m_a * app.moved_a + m_b * app.moved_b);
    const double move_limit = m_a * moving(app, c.post_a, app.moved_a) + m_b * moving(app, c.post_b, app.moved_b);
    tally_.check(moved,
                 {move_limit, "kg m", "m (u |x| + 3 operations on the displacement), both bodies (METHOD 5, float32)"},
                 Where::pair(step, c.a, c.b, "contact.post.x"));

    const Vec3d gained_a = Vec3d(c.post_a.v) - Vec3d(c.pre_a.v);
    const Vec3d gained_b = Vec3d(c.post_b.v) - Vec3d(c.pre_b.v);
    const double momentum = length(m_a * gained_a + m_b * gained_b);
    const double momentum_limit = m_a * pushing(app, c.post_a, gained_a) + m_b * pushing(app, c.post_b, gained_b);
    tally_.check(momentum,
                 {momentum_limit, "kg m/s", "m (2 u |v| + 3 operations on both impulses), both bodies (float32)"},
                 Where::pair(step, c.a, c.b, "contact.post.v"));
  }

  // How far rounding takes one body's displacement from its share, m. On an axis where the normal is zero, zero is
  // added.
  static double moving(const Application& app, const core::Kinematics& post, Vec3d moved) {
    double square = 0.0;
    for (int k = 0; k < 3; ++k)
      if (app.normal[k] != 0.0) square += static_cast<double>(post.x[k]) * post.x[k];
    return rounding(1) * std::sqrt(square) + rounding(3) * length(moved) + 8.0 * kSubnormal;
  }

  // The same for the body's change of velocity, m/s.
  static double pushing(const Application& app, const core::Kinematics& post, Vec3d gained) {
    const double along = dot(gained, app.normal);
    return rounding(2) * length(Vec3d(post.v)) + rounding(3) * (std::abs(along) + length(gained - along * app.normal)) +
           8.0 * kSubnormal;
  }

  void judge_static(const core::Kinematics& pre, const core::Kinematics& post, std::uint32_t body, std::uint64_t step) {
    ++static_;
    tally_.check(largest_component(Vec3d(post.x) - Vec3d(pre.x)), {0.0, "m", kStaticOrigin},
                 Where::body(step, body, "contact.post.x"));
    tally_.check(largest_component(Vec3d(post.v) - Vec3d(pre.v)), {0.0, "m/s", kStaticOrigin},
                 Where::body(step, body, "contact.post.v"));
  }

  void judge_static_bodies(const core::FrameRecord& frame) {
    if (frame.position.size() != scene_.bodies.size()) return;
    for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
      if (scene_.bodies[i].inverse_mass > 0.0F) continue;
      tally_.check(largest_component(Vec3d(frame.position[i]) - Vec3d(scene_.bodies[i].position)),
                   {0.0, "m", kStaticOrigin}, Where::body(frame.step, i, "bodies.position"));
    }
  }

  static constexpr std::string_view kStaticOrigin = "a body of infinite mass takes a share of exactly zero (METHOD 5)";

  const core::Scene& scene_;
  ContactBodies bodies_;
  Tally tally_{"center-of-mass", "sums and static states",
               "METHOD 5 and 6: equal and opposite, shared by inverse mass"};
  std::uint64_t shared_ = 0;
  std::uint64_t static_ = 0;
};

std::string why_not_center_of_mass(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kContacts)); !text.empty()) return text;
  return why_not_method(subject.header);
}

}  // namespace

ValidatorRow center_of_mass_row() {
  return {"center-of-mass",
          "corrections and impulses leave sum(m x) and sum(m v) unchanged; static bodies do not move",
          "printed-E3; a moved static body",
          core::bit(core::Group::kContacts) | core::bit(core::Group::kBodies),
          0,
          why_not_center_of_mass,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<CenterOfMass>(subject); }};
}

}  // namespace broadside::validation
