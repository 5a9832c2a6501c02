#include <cmath>
#include <utility>

#include "bench/mutants/specimen_parts.hpp"
#include "bench/mutants/tamperings.hpp"

namespace broadside::bench {
namespace {

// Adds an impulse along the contact's normal to both bodies, as a consistent engine would, and records it.
void push(Specimen& r, Contact& c, double impulse_n_s) {
  const auto w = [&](std::uint32_t body) {
    return core::is_face(body) ? 0.0F : r.header.scene.bodies[body].inverse_mass;
  };
  const auto j = static_cast<float>(impulse_n_s);
  c.normal_impulse_n_s += j;
  c.post_a.v = c.post_a.v + (j * w(c.a)) * c.normal;
  c.post_b.v = c.post_b.v - (j * w(c.b)) * c.normal;
}

// The same along the recorded tangent.
void drag(Specimen& r, Contact& c, float impulse_n_s) {
  const auto w = [&](std::uint32_t body) {
    return core::is_face(body) ? 0.0F : r.header.scene.bodies[body].inverse_mass;
  };
  c.tangent_impulse_n_s += impulse_n_s;
  c.post_a.v = c.post_a.v + (impulse_n_s * w(c.a)) * c.tangent;
  c.post_b.v = c.post_b.v - (impulse_n_s * w(c.b)) * c.tangent;
}

double approach(const Contact& c) {
  return double(c.pre_a.v.x - c.pre_b.v.x) * c.normal.x + double(c.pre_a.v.y - c.pre_b.v.y) * c.normal.y +
         double(c.pre_a.v.z - c.pre_b.v.z) * c.normal.z;
}

double inverse_masses(const Specimen& r, const Contact& c) {
  const auto w = [&](std::uint32_t body) {
    return core::is_face(body) ? 0.0F : r.header.scene.bodies[body].inverse_mass;
  };
  return double(w(c.a)) + w(c.b);
}

// The approach is slower than v_th, so it must not bounce.
bool is_slow(const Contact& c) {
  return approach(c) < -0.05 && approach(c) > -0.25;
}

constexpr Tampering kVelocityTamperings[] = {
    {"restitution", "restitution below the threshold speed",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_slow);
       push(r, c, 0.3 * -approach(c) / inverse_masses(r, c));
     }},
    {"restitution", "no restitution above the threshold speed",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_bounce);
       push(r, c, 0.3 * approach(c) / inverse_masses(r, c));
     }},
    {"restitution", "the larger of two restitutions ignored",
     [](Specimen& r) {
       for (core::Body& body : r.header.scene.bodies) body.material.restitution = 0.6F;
     }},
    {"restitution", "a separating contact stopped",
     [](Specimen& r) {
       Contact& c = contact_that(r, [](const Contact& k) { return is_separating(k) && approach(k) > 0.01; });
       push(r, c, -approach(c) / inverse_masses(r, c));
     }},
    {"restitution", "an approaching contact let through",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_bounce);
       c.post_a.v = c.pre_a.v;
       c.post_b.v = c.pre_b.v;
     }},
    {"restitution", "half of the floor's impulse",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_bounce);
       r.header.scene.parameters.impulse_min_n_s = 1e6F;
       push(r, c, -0.5 * c.normal_impulse_n_s);
     }},
    {"restitution", "a floor that nothing reached",
     [](Specimen& r) { r.header.scene.parameters.impulse_min_n_s = 1e6F; }},
    {"restitution", "NaN", [](Specimen& r) { contact_that(r, is_bounce).post_a.v.y = kNoNumber; }},
    {"normal-energy", "a bounce faster than the approach",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_bounce);
       push(r, c, 0.71 * -approach(c) / inverse_masses(r, c));
     }},
    {"normal-energy", "a floor above the neutral impulse",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_slow);
       push(r, c, 0.5);
     }},
    {"normal-energy", "a contact that pulls",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_bounce);
       push(r, c, -2.0 * c.normal_impulse_n_s);
     }},
    {"normal-energy", "a recorded impulse that did not act",
     [](Specimen& r) { contact_that(r, is_bounce).normal_impulse_n_s *= 1.001F; }},
    {"normal-energy", "NaN", [](Specimen& r) { contact_that(r, is_bounce).normal_impulse_n_s = kNoNumber; }},
    {"friction-energy", "friction that accelerates",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_slide);
       drag(r, c, -2.0F * c.tangent_impulse_n_s);
     }},
    {"friction-energy", "sliding with the static coefficient",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_slide);
       drag(r, c, 0.2F * c.tangent_impulse_n_s);
     }},
    {"friction-energy", "sliding without friction",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_slide);
       drag(r, c, -c.tangent_impulse_n_s);
     }},
    {"friction-energy", "sticking past the stop",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_stick);
       drag(r, c, 0.5F * c.tangent_impulse_n_s);
     }},
    {"friction-energy", "half of what stops",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_stick);
       drag(r, c, -0.5F * c.tangent_impulse_n_s);
     }},
    {"friction-energy", "a recorded impulse that did not act",
     [](Specimen& r) { contact_that(r, is_slide).tangent_impulse_n_s *= 1.001F; }},
    {"friction-energy", "a tangent that is not the direction of sliding",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_slide);
       const float impulse = c.tangent_impulse_n_s;
       drag(r, c, -impulse);
       c.tangent = {c.tangent.z, c.tangent.y, -c.tangent.x};
       drag(r, c, impulse);
     }},
    {"friction-energy", "friction at a separating contact",
     [](Specimen& r) {
       Contact& c = contact_that(r, [](const Contact& k) { return is_separating(k) && approach(k) > 0.01; });
       c.tangent = {c.normal.y, c.normal.z, c.normal.x};
       drag(r, c, -0.01F);
     }},
    {"friction-energy", "a tangent at a separating contact",
     [](Specimen& r) {
       Contact& c = contact_that(r, [](const Contact& k) { return is_separating(k) && approach(k) > 0.01; });
       c.tangent = {c.normal.y, c.normal.z, c.normal.x};
     }},
    {"friction-energy", "NaN", [](Specimen& r) { contact_that(r, is_slide).tangent_impulse_n_s = kNoNumber; }},
    {"velocity-cap", "a component above v_max",
     [](Specimen& r) { r.frames[7].velocity[4].z = std::nextafter(50.0F, 51.0F); }},
    {"velocity-cap", "a component below -v_max", [](Specimen& r) { r.frames[7].velocity[4].x = -51.0F; }},
    {"velocity-cap", "NaN", [](Specimen& r) { r.frames[7].velocity[4].y = kNoNumber; }},
};

}  // namespace

std::span<const Tampering> velocity_tamperings() {
  return kVelocityTamperings;
}

}  // namespace broadside::bench
