// Contacts whose parts do not belong together: impulses, tangents, shares and depths that belong to other contacts, or
// are a little off.
#include <cmath>
#include <utility>

#include "tests/validation/corruption.hpp"

namespace broadside::tests {
namespace {

bool is_sliding(const Contact& c) {
  return c.tangent_impulse_n_s < 0.0F;
}

// The first two contacts of one frame for which the condition holds.
template <typename Fits>
std::pair<Contact*, Contact*> two_that(Recording& r, Fits fits) {
  for (FrameRecord& frame : r.frames) {
    Contact* first = nullptr;
    for (Contact& c : frame.contacts) {
      if (!fits(c)) continue;
      if (first != nullptr) return {first, &c};
      first = &c;
    }
  }
  r.is_spoilable = false;
  FrameRecord& frame = r.frames.front();
  frame.contacts.resize(2);
  return {&frame.contacts[0], &frame.contacts[1]};
}

Vec3 turned_about(Vec3 t, Vec3 n, float angle) {
  const Vec3 side{n.y * t.z - n.z * t.y, n.z * t.x - n.x * t.z, n.x * t.y - n.y * t.x};
  return std::cos(angle) * t + std::sin(angle) * side;
}

constexpr Corruption kExchanged[] = {
    {"normal impulses of two contacts exchanged", "pile", "normal-energy",
     [](Recording& r) {
       const auto [c, d] = two_that(r, is_pushing);
       std::swap(c->normal_impulse_n_s, d->normal_impulse_n_s);
     }},
    {"tangent impulses of two contacts exchanged", "pile", "friction-energy",
     [](Recording& r) {
       const auto [c, d] = two_that(r, is_sliding);
       std::swap(c->tangent_impulse_n_s, d->tangent_impulse_n_s);
     }},
    {"tangents of two contacts exchanged", "pile", "friction-energy",
     [](Recording& r) {
       const auto [c, d] = two_that(r, is_sliding);
       std::swap(c->tangent, d->tangent);
     }},
    {"depths of two contacts exchanged", "pile", "contact-normal",
     [](Recording& r) {
       const auto [c, d] = two_that(r, is_any);
       std::swap(c->depth_m, d->depth_m);
     }},
    {"normals of two contacts exchanged", "mixed", "contact-normal",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pair);
       Contact& d = contact_that(r, [&](const Contact& k) { return !(k.normal == c.normal); });
       std::swap(c.normal, d.normal);
     }},
    {"what two contacts left is exchanged", "pile", "state-sanity",
     [](Recording& r) {
       const auto [c, d] = two_that(r, is_pushing);
       std::swap(c->post_a, d->post_a);
     }},
};

TEST(Contradictions, OfContactsThatExchangedAPart) {
  expect_rejected(kExchanged);
}

constexpr Corruption kShares[] = {
    {"both bodies pushed along together", "two-body:unequal", "center-of-mass",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       for (core::Kinematics* side : {&c.post_a, &c.post_b}) side->v = side->v + 1e-3F * c.normal;
     }},
    {"both bodies pushed aside together", "two-body:unequal", "center-of-mass",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       for (core::Kinematics* side : {&c.post_a, &c.post_b}) side->v.z += 1e-3F;
     }},
    {"both bodies moved along together", "mixed", "center-of-mass",
     [](Recording& r) {
       Contact& c = contact_that(r, bench::is_shared);
       for (core::Kinematics* side : {&c.post_a, &c.post_b}) side->x = side->x + 1e-3F * c.normal;
     }},
    {"both bodies moved aside together", "mixed", "center-of-mass",
     [](Recording& r) {
       Contact& c = contact_that(r, bench::is_shared);
       for (core::Kinematics* side : {&c.post_a, &c.post_b})
         side->x = side->x + 1e-3F * Vec3{c.normal.y, c.normal.z, c.normal.x};
     }},
    {"friction on A alone", "two-body:oblique", "center-of-mass",
     [](Recording& r) {
       Contact& c = contact_that(r, is_sliding);
       const float w = r.header.scene.bodies[c.b].inverse_mass;
       c.post_b.v = c.post_b.v + (c.tangent_impulse_n_s * w) * c.tangent;
     }},
    {"a correction of A alone", "two-body:head-on", "center-of-mass",
     [](Recording& r) {
       Contact& c = contact_that(r, bench::is_deep);
       const Vec3 apart = (c.post_a.x - c.pre_a.x) - (c.post_b.x - c.pre_b.x);
       c.post_a.x = c.pre_a.x + apart;
       c.post_b.x = c.pre_b.x;
     }},
    {"a correction a hundredth too small", "two-body:head-on", "contraction",
     [](Recording& r) {
       Contact& c = contact_that(r, bench::is_deep);
       c.post_a.x = c.pre_a.x + 0.99F * (c.post_a.x - c.pre_a.x);
       c.post_b.x = c.pre_b.x + 0.99F * (c.post_b.x - c.pre_b.x);
     }},
    {"a correction along another axis", "two-body:head-on", "contraction",
     [](Recording& r) {
       Contact& c = contact_that(r, bench::is_deep);
       for (auto [before, after] : {std::pair{&c.pre_a, &c.post_a}, std::pair{&c.pre_b, &c.post_b}}) {
         const Vec3 moved = after->x - before->x;
         after->x = before->x + Vec3{moved.z, moved.x, moved.y};
       }
     }},
    {"a body at the floor that was not lifted", "two-body:slide", "contraction",
     [](Recording& r) {
       Contact& c = contact_that(r, [](const Contact& k) { return !(k.post_a.x == k.pre_a.x); });
       c.post_a.x = c.pre_a.x;
     }},
    {"a body lifted inside the slop of the floor", "mixed", "contraction",
     [](Recording& r) {
       Contact& c = contact_that(r, [](const Contact& k) { return core::is_face(k.b) && k.post_a.x == k.pre_a.x; });
       c.post_a.x = c.post_a.x + 1e-6F * c.normal;
     }},
};

TEST(Contradictions, OfSharesOfTwoBodies) {
  expect_rejected(kShares);
}

constexpr Corruption kImpulses[] = {
    {"an impulse ten parts in a million too large", "two-body:head-on", "normal-energy",
     [](Recording& r) { contact_that(r, is_pushing).normal_impulse_n_s *= 1.00001F; }},
    {"an impulse of nothing that acted", "two-body:head-on", "normal-energy",
     [](Recording& r) { contact_that(r, is_pushing).normal_impulse_n_s = 0.0F; }},
    {"an impulse of infinity", "two-body:head-on", "normal-energy",
     [](Recording& r) { contact_that(r, is_pushing).normal_impulse_n_s = INFINITY; }},
    {"a bounce off the floor with the speed it came with", "mixed", "restitution",
     [](Recording& r) {
       Contact& c = contact_that(r, [](const Contact& k) { return core::is_face(k.b) && k.normal_impulse_n_s > 0.5F; });
       const float v_n = c.pre_a.v.x * c.normal.x + c.pre_a.v.y * c.normal.y + c.pre_a.v.z * c.normal.z;
       const float now = c.post_a.v.x * c.normal.x + c.post_a.v.y * c.normal.y + c.post_a.v.z * c.normal.z;
       c.post_a.v = c.post_a.v + (-v_n - now) * c.normal;
     }},
    {"a contact that holds on", "two-body:head-on", "restitution",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       c.post_a.v = c.post_b.v = 0.5F * (c.post_a.v + c.post_b.v);
     }},
    {"a tangent turned by a thousandth", "two-body:oblique", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_sliding);
       c.tangent = turned_about(c.tangent, c.normal, 1e-3F);
     }},
    {"a tangent that leans to the normal", "two-body:oblique", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_sliding);
       c.tangent = c.tangent + 1e-3F * c.normal;
     }},
    {"friction ten parts in a million too strong", "two-body:oblique", "friction-energy",
     [](Recording& r) { contact_that(r, is_sliding).tangent_impulse_n_s *= 1.00001F; }},
    {"friction that was not told", "two-body:oblique", "friction-energy",
     [](Recording& r) { contact_that(r, is_sliding).tangent_impulse_n_s = 0.0F; }},
    {"friction that stops a little less than all", "two-body:glancing", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_sliding);
       const float w_a = r.header.scene.bodies[c.a].inverse_mass;
       const float w_b = r.header.scene.bodies[c.b].inverse_mass;
       const float less = -1e-3F * c.tangent_impulse_n_s;
       c.tangent_impulse_n_s += less;
       c.post_a.v = c.post_a.v + (less * w_a) * c.tangent;
       c.post_b.v = c.post_b.v - (less * w_b) * c.tangent;
     }},
    {"sliding that friction turned", "two-body:oblique", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_sliding);
       const Vec3 side = turned_about(c.tangent, c.normal, 1.5707963F);
       c.post_a.v = c.post_a.v + 1e-4F * side;
       c.post_b.v = c.post_b.v - 1e-4F * side;
     }},
    {"friction at a body that rests", "two-body:rest", "friction-energy",
     [](Recording& r) {
       Contact& c = contact_that(r, is_any);
       c.tangent = {1.0F, 0.0F, 0.0F};
       c.tangent_impulse_n_s = -1e-6F;
     }},
};

TEST(Contradictions, OfImpulses) {
  expect_rejected(kImpulses);
}

}  // namespace
}  // namespace broadside::tests
