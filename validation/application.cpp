#include "validation/application.hpp"

#include <algorithm>
#include <cmath>

#include "validation/rounding.hpp"

namespace broadside::validation {

double Application::relative_velocity_rounding() const {
  return rounding(4) * speeds_before;
}

double Application::velocity_after_rounding() const {
  const double change = length(sliding_after - sliding_before) + std::abs(approach_after - approach_before);
  return rounding(8) * (speeds_before + speeds_after + change) + 8.0 * kSubnormal;
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
  if (!knows(contact.a) || !knows(contact.b) || contact.a == contact.b) return std::nullopt;
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
  app.speeds_before = length(Vec3d(contact.pre_a.v)) + length(Vec3d(contact.pre_b.v));
  app.speeds_after = length(Vec3d(contact.post_a.v)) + length(Vec3d(contact.post_b.v));
  return app;
}

}  // namespace broadside::validation
