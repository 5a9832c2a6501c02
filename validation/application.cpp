#include "validation/application.hpp"

#include <algorithm>
#include <cmath>

#include "validation/rounding.hpp"

namespace broadside::validation {

double Application::approach_rounding() const {
  return rounding(4) * along_before + 4.0 * kSubnormal;
}

double Application::sliding_rounding() const {
  return rounding(2) * length(sliding_before) + rounding(6) * along_before + std::sqrt(3.0 * kSubnormal);
}

double Application::leak() const {
  const double along = w_sum * std::abs(contact->tangent_impulse_n_s * dot(Vec3d(contact->tangent), normal));
  return std::min(along, sliding_rounding());
}

double Application::approach_after_rounding() const {
  return rounding(2) * along_after + rounding(3) * along_change + leak() + 8.0 * kSubnormal;
}

double Application::sliding_after_rounding() const {
  return rounding(2) * across_after + rounding(3) * across_change + leak() + 8.0 * kSubnormal;
}

bool ContactBodies::knows(std::uint32_t body) const {
  return body < scene_->body_count() ||
         (core::is_face(body) && body - core::kFirstFace < static_cast<std::uint32_t>(core::kFaceCount));
}

double ContactBodies::inverse_mass(std::uint32_t body) const {
  return core::is_face(body) ? 0.0 : static_cast<double>(scene_->bodies[body].inverse_mass);
}

const core::Material& ContactBodies::material(std::uint32_t body) const {
  return core::is_face(body) ? scene_->face_material : scene_->bodies[body].material;
}

std::optional<Application> ContactBodies::application(const core::Contact& contact) const {
  if (core::is_face(contact.a) || !knows(contact.a) || !knows(contact.b) || contact.a == contact.b) return std::nullopt;
  Application app;
  app.contact = &contact;
  app.w_a = inverse_mass(contact.a);
  app.w_b = inverse_mass(contact.b);
  app.w_sum = app.w_a + app.w_b;
  if (!(app.w_sum > 0.0)) return std::nullopt;

  const core::Material& a = material(contact.a);
  const core::Material& b = material(contact.b);
  app.surface.mu_static = std::sqrt(static_cast<double>(a.mu_static) * b.mu_static);
  app.surface.mu_kinetic = std::sqrt(static_cast<double>(a.mu_kinetic) * b.mu_kinetic);
  app.surface.restitution = std::max(a.restitution, b.restitution);

  app.normal = Vec3d(contact.normal);
  const Vec3d before = Vec3d(contact.pre_a.v) - Vec3d(contact.pre_b.v);
  const Vec3d after = Vec3d(contact.post_a.v) - Vec3d(contact.post_b.v);
  app.approach_before = dot(before, app.normal);
  app.approach_after = dot(after, app.normal);
  app.sliding_before = before - app.approach_before * app.normal;
  app.sliding_after = after - app.approach_after * app.normal;
  app.moved_a = Vec3d(contact.post_a.x) - Vec3d(contact.pre_a.x);
  app.moved_b = Vec3d(contact.post_b.x) - Vec3d(contact.pre_b.x);
  for (int k = 0; k < 3; ++k) {
    const double along = std::abs(app.normal[k]);
    const double across = std::sqrt(std::max(0.0, 1.0 - along * along));
    const double speeds = (app.w_a > 0.0 ? std::abs(static_cast<double>(contact.post_a.v[k])) : 0.0) +
                          (app.w_b > 0.0 ? std::abs(static_cast<double>(contact.post_b.v[k])) : 0.0);
    // Both impulses' parts by magnitude: they may cancel in a component.
    const double change = std::abs((app.approach_after - app.approach_before) * app.normal[k]) +
                          std::abs(app.sliding_after[k] - app.sliding_before[k]);
    app.along_before += along * std::abs(before[k]);
    app.along_after += along * speeds;
    app.along_change += along * change;
    app.across_after += across * speeds;
    app.across_change += across * change;
  }
  return app;
}

}  // namespace broadside::validation
