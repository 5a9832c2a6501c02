// Wrong contacts of the catalogue: normals, position corrections and impulses.
#pragma once

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tests/validation/mutations.hpp"

namespace broadside::tests {

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

inline void scale(Vec3& v, float by) {
  v = by * v;
}

// The state that a contact left, moved further along the way that it moved, by this factor.
inline void restate(Contact& c, float factor) {
  for (int k = 0; k < 3; ++k) {
    c.post_a.x[k] = c.pre_a.x[k] + factor * (c.post_a.x[k] - c.pre_a.x[k]);
    c.post_b.x[k] = c.pre_b.x[k] + factor * (c.post_b.x[k] - c.pre_b.x[k]);
  }
}

// Adds an impulse along the contact's normal to both bodies, as a consistent engine would, and records it.
inline void push(Recording& r, Contact& c, double impulse_n_s) {
  const auto w = [&](std::uint32_t body) {
    return core::is_face(body) ? 0.0F : r.header.scene.bodies[body].inverse_mass;
  };
  const auto j = static_cast<float>(impulse_n_s);
  c.normal_impulse_n_s += j;
  c.post_a.v = c.post_a.v + (j * w(c.a)) * c.normal;
  c.post_b.v = c.post_b.v - (j * w(c.b)) * c.normal;
}

// The same along the recorded tangent.
inline void drag(Recording& r, Contact& c, float impulse_n_s) {
  const auto w = [&](std::uint32_t body) {
    return core::is_face(body) ? 0.0F : r.header.scene.bodies[body].inverse_mass;
  };
  c.tangent_impulse_n_s += impulse_n_s;
  c.post_a.v = c.post_a.v + (impulse_n_s * w(c.a)) * c.tangent;
  c.post_b.v = c.post_b.v - (impulse_n_s * w(c.b)) * c.tangent;
}

inline double approach(const Contact& c) {
  return double(c.pre_a.v.x - c.pre_b.v.x) * c.normal.x + double(c.pre_a.v.y - c.pre_b.v.y) * c.normal.y +
         double(c.pre_a.v.z - c.pre_b.v.z) * c.normal.z;
}

inline double inverse_masses(const Recording& r, const Contact& c) {
  const auto w = [&](std::uint32_t body) {
    return core::is_face(body) ? 0.0F : r.header.scene.bodies[body].inverse_mass;
  };
  return double(w(c.a)) + w(c.b);
}

// Approaching slower than v_th, so it must not bounce.
inline bool is_slow(const Contact& c) {
  return approach(c) < -0.05 && approach(c) > -0.25;
}

inline const std::vector<Mutation> kNormalMutations = {
    {"contact-normal", "a flipped sign", [](Recording& r) { scale(contact_that(r, is_shared).normal, -1.0F); }},
    {"contact-normal", "a flipped sign at a face",
     [](Recording& r) { scale(contact_that(r, is_on_face).normal, -1.0F); }},
    {"contact-normal", "a normal of length 1.001",
     [](Recording& r) { scale(contact_that(r, is_shared).normal, 1.001F); }},
    {"contact-normal", "no normal", [](Recording& r) { contact_that(r, is_shared).normal = {}; }},
    {"contact-normal", "an oblique unit normal",
     [](Recording& r) {
       contact_that(r, is_shared).normal = {0.6F, 0.8F, 0.0F};
     }},
    {"contact-normal", "a non-minimal axis",
     [](Recording& r) {
       Contact& c = contact_that(r, is_shared);
       c.normal = {c.normal.y, c.normal.z, c.normal.x};
     }},
    {"contact-normal", "a depth 1 % off", [](Recording& r) { contact_that(r, is_shared).depth_m *= 1.01F; }},
    {"contact-normal", "a negative depth",
     [](Recording& r) {
       Contact& c = contact_that(r, is_on_face);
       c.depth_m = -c.depth_m;
     }},
    {"contact-normal", "NaN", [](Recording& r) { scale(contact_that(r, is_on_face).normal, kNoNumber); }},
    {"contact-normal", "a depth at a face that is off",
     [](Recording& r) { contact_that(r, is_on_face).depth_m += 1e-3F; }},
    {"contact-normal", "a face that was not reached",
     [](Recording& r) { contact_that(r, is_on_face).b = core::kFirstFace + 5; }},
    {"contact-normal", "two faces in the wrong order",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (std::size_t k = 1; k < frame.contacts.size(); ++k)
           if (is_on_face(frame.contacts[k - 1]) && frame.contacts[k - 1].a == frame.contacts[k].a)
             return std::swap(frame.contacts[k], frame.contacts[k - 1]);
       FAIL() << "no body meets two faces in one frame";
     }},
    {"contact-normal", "one contact twice in one color",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (const Contact& c : frame.contacts)
           if (is_shared(c)) {
             const Contact again = c;
             frame.contacts.insert(frame.contacts.begin(), again);
             return;
           }
     }},
};

inline const std::vector<Mutation> kPositionMutations = {
    {"contraction", "beta applied twice", [](Recording& r) { restate(contact_that(r, is_deep), 0.6F); }},
    {"contraction", "alpha applied twice", [](Recording& r) { restate(contact_that(r, is_deep), 0.9F); }},
    {"contraction", "corrected past the slop", [](Recording& r) { restate(contact_that(r, is_deep), 2.5F); }},
    {"contraction", "not corrected", [](Recording& r) { restate(contact_that(r, is_deep), 0.0F); }},
    {"contraction", "corrected the wrong way", [](Recording& r) { restate(contact_that(r, is_deep), -1.0F); }},
    {"contraction", "deepened inside the slop",
     [](Recording& r) {
       Contact& c = contact_that(r, is_in_slop);
       c.post_a.x = c.post_a.x - (0.01F - c.depth_m) * c.normal;
     }},
    {"contraction", "moved across the normal",
     [](Recording& r) {
       Contact& c = contact_that(r, is_deep);
       c.post_a.x = c.post_a.x + 1e-4F * Vec3{c.normal.y, c.normal.z, c.normal.x};
     }},
    {"contraction", "NaN", [](Recording& r) { contact_that(r, is_deep).post_a.x.x = kNoNumber; }},
    {"center-of-mass", "shares swapped",
     [](Recording& r) {
       Contact& c = contact_that(r, is_shared);
       const Vec3 a = c.post_a.x - c.pre_a.x;
       const Vec3 b = c.post_b.x - c.pre_b.x;
       c.post_a.x = c.pre_a.x - b;
       c.post_b.x = c.pre_b.x - a;
     }},
    {"center-of-mass", "half of the correction each",
     [](Recording& r) {
       Contact& c = contact_that(r, is_shared);
       const Vec3 apart = (c.post_a.x - c.pre_a.x) - (c.post_b.x - c.pre_b.x);
       c.post_a.x = c.pre_a.x + 0.5F * apart;
       c.post_b.x = c.pre_b.x - 0.5F * apart;
     }},
    {"center-of-mass", "an impulse on one body alone",
     [](Recording& r) {
       Contact& c = contact_that(r, is_shared);
       c.post_b.v = c.pre_b.v;
     }},
    {"center-of-mass", "a moved static body",
     [](Recording& r) {
       Contact& c = contact_that(r, [](const Contact& k) { return k.a == 2 || k.b == 2; });
       (c.a == 2 ? c.post_a : c.post_b).x.y -= 1e-6F;
     }},
    {"center-of-mass", "a pushed static body",
     [](Recording& r) {
       Contact& c = contact_that(r, [](const Contact& k) { return k.a == 2 || k.b == 2; });
       (c.a == 2 ? c.post_a : c.post_b).v.y -= 1e-6F;
     }},
    {"center-of-mass", "a moved face", [](Recording& r) { contact_that(r, is_on_face).post_b.x.y = -0.01F; }},
    {"center-of-mass", "a static body that wandered off between contacts",
     [](Recording& r) { r.frames.back().position[2].x += 1e-6F; }},
};

inline const std::vector<Mutation> kVelocityMutations = {
    {"restitution", "restitution below the threshold speed",
     [](Recording& r) {
       Contact& c = contact_that(r, is_slow);
       push(r, c, 0.3 * -approach(c) / inverse_masses(r, c));
     }},
    {"restitution", "no restitution above the threshold speed",
     [](Recording& r) {
       Contact& c = contact_that(r, is_bounce);
       push(r, c, 0.3 * approach(c) / inverse_masses(r, c));
     }},
    {"restitution", "the larger of two restitutions ignored",
     [](Recording& r) {
       for (core::Body& body : r.header.scene.bodies) body.material.restitution = 0.6F;
     }},
    {"restitution", "a separating contact stopped",
     [](Recording& r) {
       Contact& c = contact_that(r, [](const Contact& k) { return is_separating(k) && approach(k) > 0.01; });
       push(r, c, -approach(c) / inverse_masses(r, c));
     }},
    {"restitution", "an approaching contact let through",
     [](Recording& r) {
       Contact& c = contact_that(r, is_bounce);
       c.post_a.v = c.pre_a.v;
       c.post_b.v = c.pre_b.v;
     }},
    {"restitution", "NaN", [](Recording& r) { contact_that(r, is_bounce).post_a.v.y = kNoNumber; }},
    {"normal-energy", "a bounce faster than the approach",
     [](Recording& r) {
       Contact& c = contact_that(r, is_bounce);
       push(r, c, 0.71 * -approach(c) / inverse_masses(r, c));
     }},
    {"normal-energy", "a floor above the neutral impulse",
     [](Recording& r) {
       Contact& c = contact_that(r, is_slow);
       push(r, c, 0.5);
     }},
    {"normal-energy", "a contact that pulls",
     [](Recording& r) {
       Contact& c = contact_that(r, is_bounce);
       push(r, c, -2.0 * c.normal_impulse_n_s);
     }},
    {"normal-energy", "a recorded impulse that did not act",
     [](Recording& r) { contact_that(r, is_bounce).normal_impulse_n_s *= 1.001F; }},
    {"normal-energy", "NaN", [](Recording& r) { contact_that(r, is_bounce).normal_impulse_n_s = kNoNumber; }},
    {"friction-energy", "friction that accelerates",
     [](Recording& r) {
       Contact& c = contact_that(r, is_slide);
       drag(r, c, -2.0F * c.tangent_impulse_n_s);
     }},
    {"friction-energy", "sliding with the static coefficient",
     [](Recording& r) {
       Contact& c = contact_that(r, is_slide);
       drag(r, c, 0.2F * c.tangent_impulse_n_s);
     }},
    {"friction-energy", "sliding without friction",
     [](Recording& r) {
       Contact& c = contact_that(r, is_slide);
       drag(r, c, -c.tangent_impulse_n_s);
     }},
    {"friction-energy", "sticking past the stop",
     [](Recording& r) {
       Contact& c = contact_that(r, is_stick);
       drag(r, c, 0.5F * c.tangent_impulse_n_s);
     }},
    {"friction-energy", "half of what stops",
     [](Recording& r) {
       Contact& c = contact_that(r, is_stick);
       drag(r, c, -0.5F * c.tangent_impulse_n_s);
     }},
    {"friction-energy", "a recorded impulse that did not act",
     [](Recording& r) { contact_that(r, is_slide).tangent_impulse_n_s *= 1.001F; }},
    {"friction-energy", "a tangent that is not the direction of sliding",
     [](Recording& r) {
       Contact& c = contact_that(r, is_slide);
       const float impulse = c.tangent_impulse_n_s;
       drag(r, c, -impulse);
       c.tangent = {c.tangent.z, c.tangent.y, -c.tangent.x};
       drag(r, c, impulse);
     }},
    {"friction-energy", "friction at a separating contact",
     [](Recording& r) {
       Contact& c = contact_that(r, [](const Contact& k) { return is_separating(k) && approach(k) > 0.01; });
       c.tangent = {c.normal.y, c.normal.z, c.normal.x};
       drag(r, c, -0.01F);
     }},
    {"friction-energy", "NaN", [](Recording& r) { contact_that(r, is_slide).tangent_impulse_n_s = kNoNumber; }},
    {"velocity-cap", "a component above v_max",
     [](Recording& r) { r.frames[7].velocity[4].z = std::nextafter(50.0F, 51.0F); }},
    {"velocity-cap", "a component below -v_max", [](Recording& r) { r.frames[7].velocity[4].x = -51.0F; }},
    {"velocity-cap", "NaN", [](Recording& r) { r.frames[7].velocity[4].y = kNoNumber; }},
};

}  // namespace broadside::tests
