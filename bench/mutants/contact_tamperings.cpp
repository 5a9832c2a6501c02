#include <cmath>
#include <utility>

#include "bench/mutants/specimen_parts.hpp"
#include "bench/mutants/tamperings.hpp"

namespace broadside::bench {
namespace {

void scale(Vec3& v, float by) {
  v = by * v;
}

// Scales by this factor how far the contact moved its bodies from their states before.
void restate(Contact& c, float factor) {
  for (int k = 0; k < 3; ++k) {
    c.post_a.x[k] = c.pre_a.x[k] + factor * (c.post_a.x[k] - c.pre_a.x[k]);
    c.post_b.x[k] = c.pre_b.x[k] + factor * (c.post_b.x[k] - c.pre_b.x[k]);
  }
}

// The first contact of this kind is taken out of its frame.
template <typename Fits>
void erase_contact(Specimen& r, Fits fits) {
  for (FrameRecord& frame : r.frames)
    for (auto c = frame.contacts.begin(); c != frame.contacts.end(); ++c)
      if (fits(*c)) {
        frame.contacts.erase(c);
        return;
      }
  r.is_spoilable = false;
}

// Inside the slop and separating: no state changes.
bool is_idle(const Contact& c) {
  return c.pre_a == c.post_a && c.pre_b == c.post_b;
}

constexpr Tampering kContactTamperings[] = {
    {"contact-set", "a lost contact", [](Specimen& r) { erase_contact(r, is_shared); }},
    {"contact-set", "a lost contact that changed nothing", [](Specimen& r) { erase_contact(r, is_idle); }},
    {"contact-set", "a lost contact with a face", [](Specimen& r) { erase_contact(r, is_on_face); }},
    {"contact-set", "a contact of bodies that are apart",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_shared);
       c.a = 1;
       c.b = 5;
     }},
    {"contact-set", "one contact twice",
     [](Specimen& r) {
       for (FrameRecord& frame : r.frames)
         for (const Contact& c : frame.contacts)
           if (is_shared(c)) {
             const Contact again = c;
             frame.contacts.push_back(again);
             return;
           }
     }},
    {"contact-normal", "a face that moves",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_on_face);
       c.pre_b.v = c.post_b.v = {1.0F, 0.0F, 0.0F};
     }},
    {"contact-normal", "a face with a color of its own", [](Specimen& r) { contact_that(r, is_on_face).color = 3; }},
    {"contact-normal", "a flipped sign", [](Specimen& r) { scale(contact_that(r, is_shared).normal, -1.0F); }},
    {"contact-normal", "a flipped sign at a face",
     [](Specimen& r) { scale(contact_that(r, is_on_face).normal, -1.0F); }},
    {"contact-normal", "a normal of length 1.001",
     [](Specimen& r) { scale(contact_that(r, is_shared).normal, 1.001F); }},
    {"contact-normal", "no normal", [](Specimen& r) { contact_that(r, is_shared).normal = {}; }},
    {"contact-normal", "an oblique unit normal",
     [](Specimen& r) {
       contact_that(r, is_shared).normal = {0.6F, 0.8F, 0.0F};
     }},
    {"contact-normal", "a non-minimal axis",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_shared);
       c.normal = {c.normal.y, c.normal.z, c.normal.x};
     }},
    {"contact-normal", "a depth 1 % off", [](Specimen& r) { contact_that(r, is_shared).depth_m *= 1.01F; }},
    {"contact-normal", "a negative depth",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_on_face);
       c.depth_m = -c.depth_m;
     }},
    {"contact-normal", "NaN", [](Specimen& r) { scale(contact_that(r, is_on_face).normal, kNoNumber); }},
    {"contact-normal", "a depth at a face that is off",
     [](Specimen& r) { contact_that(r, is_on_face).depth_m += 1e-3F; }},
    {"contact-normal", "a face that was not reached",
     [](Specimen& r) { contact_that(r, is_on_face).b = core::kFirstFace + 5; }},
    {"contact-normal", "two faces in the wrong order",
     [](Specimen& r) {
       for (FrameRecord& frame : r.frames)
         for (std::size_t k = 1; k < frame.contacts.size(); ++k)
           if (is_on_face(frame.contacts[k - 1]) && frame.contacts[k - 1].a == frame.contacts[k].a)
             return std::swap(frame.contacts[k], frame.contacts[k - 1]);
       r.is_spoilable = false;
     }},
    {"contact-normal", "one contact twice in one color",
     [](Specimen& r) {
       for (FrameRecord& frame : r.frames)
         for (const Contact& c : frame.contacts)
           if (is_shared(c)) {
             const Contact again = c;
             frame.contacts.insert(frame.contacts.begin(), again);
             return;
           }
     }},
    {"contraction", "beta applied twice", [](Specimen& r) { restate(contact_that(r, is_deep), 0.6F); }},
    {"contraction", "alpha applied twice", [](Specimen& r) { restate(contact_that(r, is_deep), 0.9F); }},
    {"contraction", "corrected past the slop", [](Specimen& r) { restate(contact_that(r, is_deep), 2.5F); }},
    {"contraction", "not corrected", [](Specimen& r) { restate(contact_that(r, is_deep), 0.0F); }},
    {"contraction", "corrected the wrong way", [](Specimen& r) { restate(contact_that(r, is_deep), -1.0F); }},
    {"contraction", "deepened inside the slop",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_in_slop);
       c.post_a.x = c.post_a.x - (0.01F - c.depth_m) * c.normal;
     }},
    {"contraction", "moved across the normal",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_deep);
       c.post_a.x = c.post_a.x + 1e-4F * Vec3{c.normal.y, c.normal.z, c.normal.x};
     }},
    {"contraction", "NaN", [](Specimen& r) { contact_that(r, is_deep).post_a.x.x = kNoNumber; }},
    {"center-of-mass", "shares swapped",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_shared);
       const Vec3 a = c.post_a.x - c.pre_a.x;
       const Vec3 b = c.post_b.x - c.pre_b.x;
       c.post_a.x = c.pre_a.x - b;
       c.post_b.x = c.pre_b.x - a;
     }},
    {"center-of-mass", "half of the correction each",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_shared);
       const Vec3 apart = (c.post_a.x - c.pre_a.x) - (c.post_b.x - c.pre_b.x);
       c.post_a.x = c.pre_a.x + 0.5F * apart;
       c.post_b.x = c.pre_b.x - 0.5F * apart;
     }},
    {"center-of-mass", "an impulse on one body alone",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_shared);
       c.post_b.v = c.pre_b.v;
     }},
    {"center-of-mass", "a moved static body",
     [](Specimen& r) {
       Contact& c = contact_that(r, [](const Contact& k) { return k.a == 2 || k.b == 2; });
       (c.a == 2 ? c.post_a : c.post_b).x.y -= 1e-6F;
     }},
    {"center-of-mass", "a pushed static body",
     [](Specimen& r) {
       Contact& c = contact_that(r, [](const Contact& k) { return k.a == 2 || k.b == 2; });
       (c.a == 2 ? c.post_a : c.post_b).v.y -= 1e-6F;
     }},
    {"center-of-mass", "a moved face", [](Specimen& r) { contact_that(r, is_on_face).post_b.x.y = -0.01F; }},
    {"center-of-mass", "a static body that wandered off between contacts",
     [](Specimen& r) { r.frames.back().position[2].x += 1e-6F; }},
};

}  // namespace

std::span<const Tampering> contact_tamperings() {
  return kContactTamperings;
}

}  // namespace broadside::bench
