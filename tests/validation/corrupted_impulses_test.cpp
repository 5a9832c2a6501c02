// Impulses that were changed in a recording, or judged by other parameters: the law of each kind names it.
#include <cmath>

#include "tests/validation/corruption.hpp"

namespace broadside::tests {
namespace {

// A further impulse along the contact's normal on both bodies, recorded as it acted.
void push(const Recording& r, Contact& c, float impulse_n_s) {
  c.normal_impulse_n_s += impulse_n_s;
  c.post_a.v = c.post_a.v + (impulse_n_s * r.header.scene.bodies[c.a].inverse_mass) * c.normal;
  if (core::is_face(c.b)) return;
  c.post_b.v = c.post_b.v - (impulse_n_s * r.header.scene.bodies[c.b].inverse_mass) * c.normal;
}

void drag(const Recording& r, Contact& c, float impulse_n_s) {
  c.tangent_impulse_n_s += impulse_n_s;
  c.post_a.v = c.post_a.v + (impulse_n_s * r.header.scene.bodies[c.a].inverse_mass) * c.tangent;
  if (core::is_face(c.b)) return;
  c.post_b.v = c.post_b.v - (impulse_n_s * r.header.scene.bodies[c.b].inverse_mass) * c.tangent;
}

bool is_sliding_hard(const Contact& c) {
  return c.tangent_impulse_n_s < -1e-4F;
}
bool is_straight(const Contact& c) {
  return c.normal_impulse_n_s > 0.0F && c.tangent_impulse_n_s == 0.0F;
}

constexpr Corruption kNormal[] = {
    {"half of the floor's impulse", "errata:E5", "restitution",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       push(r, c, -0.5F * c.normal_impulse_n_s);
     }},
    {"a hundredth less than the floor's impulse", "errata:E5", "restitution",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       push(r, c, -0.01F * c.normal_impulse_n_s);
     }},
    {"no impulse where the floor asks for one", "errata:E5", "restitution",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       push(r, c, -c.normal_impulse_n_s);
     }},
    {"a floor of a million in the scene", "two-body:head-on", "restitution",
     [](Recording& r) { r.header.scene.parameters.impulse_min_n_s = 1e6F; }},
    {"a floor of a million in the scene", "pile", "restitution",
     [](Recording& r) { r.header.scene.parameters.impulse_min_n_s = 1e6F; }},
    {"no floor in the scene", "errata:E5", "restitution",
     [](Recording& r) { r.header.scene.parameters.impulse_min_n_s = 0.0F; }},
    {"a bounce a thousandth too high", "two-body:head-on", "restitution",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       push(r, c, 1e-3F * c.normal_impulse_n_s);
     }},
    {"a bounce a thousandth too low", "two-body:head-on", "restitution",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       push(r, c, -1e-3F * c.normal_impulse_n_s);
     }},
    {"another restitution in the scene", "two-body:head-on", "restitution",
     [](Recording& r) {
       for (core::Body& b : r.header.scene.bodies) b.material.restitution *= 0.9F;
     }},
    {"another threshold speed in the scene", "two-body:head-on", "restitution",
     [](Recording& r) { r.header.scene.parameters.v_threshold_m_s = 10.0F; }},
    {"a contact that separates is pushed", "mixed", "restitution",
     [](Recording& r) { push(r, contact_that(r, bench::is_separating), 1e-3F); }},
    {"a bounce faster than the approach", "two-body:head-on", "normal-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       push(r, c, c.normal_impulse_n_s);
     }},
    {"twice the neutral impulse", "errata:E5", "normal-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       push(r, c, c.normal_impulse_n_s);
     }},
    {"an impulse that did not act", "two-body:head-on", "normal-energy",
     [](Recording& r) { contact_that(r, is_pushing).normal_impulse_n_s *= 1.00001F; }},
    {"an impulse that pulls", "two-body:head-on", "normal-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       push(r, c, -1.5F * c.normal_impulse_n_s);
     }},
    {"an impulse recorded with the other sign", "two-body:head-on", "normal-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       c.normal_impulse_n_s = -c.normal_impulse_n_s;
     }},
    {"an impulse recorded at a contact that separates", "mixed", "normal-energy",
     [](Recording& r) { contact_that(r, bench::is_separating).normal_impulse_n_s = 1e-3F; }},
};

TEST(Corruptions, OfNormalImpulses) {
  expect_rejected(kNormal);
}

constexpr Corruption kFriction[] = {
    {"a tangent impulse without sliding", "two-body:head-on", "friction-energy",
     [](Recording& r) { contact_that(r, is_straight).tangent_impulse_n_s = -1e-9F; }},
    {"a tangent impulse of much without sliding", "two-body:head-on", "friction-energy",
     [](Recording& r) { contact_that(r, is_straight).tangent_impulse_n_s = -1.0F; }},
    {"a tangent without sliding", "two-body:head-on", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_straight);
       c.tangent = {c.normal.y, c.normal.z, c.normal.x};
     }},
    {"a tangent at a contact that separates", "mixed", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, bench::is_separating);
       c.tangent = {c.normal.y, c.normal.z, c.normal.x};
     }},
    {"a tangent the other way", "two-body:oblique", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_sliding_hard);
       c.tangent = -1.0F * c.tangent;
     }},
    {"tangent and impulse turned round", "two-body:oblique", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_sliding_hard);
       c.tangent = -1.0F * c.tangent;
       c.tangent_impulse_n_s = -c.tangent_impulse_n_s;
     }},
    {"a tangent that is not unit", "two-body:oblique", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_sliding_hard);
       c.tangent = 0.999F * c.tangent;
     }},
    {"no tangent where something slides", "two-body:oblique", "friction-energy",
     [](Recording& r) { contact_that(r, is_sliding_hard).tangent = {}; }},
    {"friction a hundredth too strong", "two-body:oblique", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_sliding_hard);
       drag(r, c, 0.01F * c.tangent_impulse_n_s);
     }},
    {"friction a hundredth too weak", "two-body:oblique", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_sliding_hard);
       drag(r, c, -0.01F * c.tangent_impulse_n_s);
     }},
    {"no friction", "two-body:glancing", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_sliding_hard);
       drag(r, c, -c.tangent_impulse_n_s);
     }},
    {"friction that speeds up", "two-body:slide", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_sliding_hard);
       drag(r, c, -2.0F * c.tangent_impulse_n_s);
     }},
    {"kinetic friction of the scene doubled", "two-body:oblique", "friction-energy",
     [](Recording& r) {
       for (core::Body& b : r.header.scene.bodies) b.material.mu_kinetic *= 2.0F;
     }},
    {"static friction of the scene taken away", "two-body:glancing", "friction-energy",
     [](Recording& r) {
       for (core::Body& b : r.header.scene.bodies) b.material.mu_static = 0.0F;
     }},
    {"an impulse that did not act", "two-body:oblique", "friction-energy",
     [](Recording& r) { contact_that(r, is_sliding_hard).tangent_impulse_n_s *= 1.00001F; }},
};

TEST(Corruptions, OfFriction) {
  expect_rejected(kFriction);
}

}  // namespace
}  // namespace broadside::tests
