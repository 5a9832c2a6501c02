// Contacts that were lost, invented or changed in a recording: the law of each kind names it.
#include <cmath>

#include "tests/validation/corruption.hpp"

namespace broadside::tests {
namespace {

// As if there had been no contact: both bodies end the frame with the states of detection, and nothing follows.
void pass_through(Recording& r) {
  FrameRecord& frame = frame_with(r, is_pair);
  frame.contacts.clear();
  frame.position = frame.detected_position;
  frame.velocity = frame.detected_velocity;
  cut_after(r, frame.step);
}

// A contact of these two that changes nothing.
void add_idle(FrameRecord& frame, Pair p) {
  Contact c;
  c.a = p.i;
  c.b = p.j;
  c.color = 100;
  c.depth_m = 1e-4F;
  c.normal = {1, 0, 0};
  c.pre_a = c.post_a = {frame.detected_position[p.i], frame.detected_velocity[p.i]};
  c.pre_b = c.post_b = {frame.detected_position[p.j], frame.detected_velocity[p.j]};
  frame.contacts.push_back(c);
}

constexpr Corruption kSets[] = {
    {"a contact lost", "two-body:head-on", "contact-set", [](Recording& r) { erase_contact(r, is_pair); }},
    {"the bodies pass through each other", "two-body:head-on", "contact-set", pass_through},
    {"the bodies pass through each other", "two-body:unequal", "contact-set", pass_through},
    {"a contact that changed nothing lost", "errata:E4", "contact-set",
     [](Recording& r) { erase_contact(r, is_idle_pair); }},
    {"a contact lost", "tower:cube:5", "contact-set", [](Recording& r) { erase_contact(r, is_pair); }},
    {"a contact that changed nothing lost", "tower:cube:5", "contact-set",
     [](Recording& r) { erase_contact(r, is_idle_pair); }},
    {"a contact that changed nothing lost", "wall:cube:12[frames=60]", "contact-set",
     [](Recording& r) { erase_contact(r, is_idle_pair); }},
    {"a contact with the floor that changed nothing lost", "mixed", "contact-set",
     [](Recording& r) { erase_contact(r, is_idle_face); }},
    {"a contact with the floor lost", "two-body:slide", "contact-set",
     [](Recording& r) { erase_contact(r, bench::is_on_face); }},
    {"all contacts of a frame lost", "pile", "contact-set",
     [](Recording& r) { frame_with(r, is_pair).contacts.clear(); }},
    {"a contact of bodies that are apart", "mixed", "contact-set",
     [](Recording& r) {
       add_idle(r.frames[3], {1, 5});
     }},
    {"a contact of a pair whose vertices are too far apart", "balls", "contact-set",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (std::size_t k = 0; k < frame.confirmed.size(); ++k)
           if (!frame.proximity[k].is_touching()) return add_idle(frame, frame.confirmed[k]);
       r.is_spoilable = false;
     }},
    {"one contact twice", "two-body:head-on", "contact-set",
     [](Recording& r) {
       FrameRecord& frame = frame_with(r, is_pair);
       frame.contacts.push_back(frame.contacts.front());
       frame.contacts.back().color += 1;
     }},
    {"a contact a frame later", "two-body:head-on", "contact-set",
     [](Recording& r) {
       FrameRecord& frame = frame_with(r, is_pair);
       r.frames[frame.step].contacts.insert(r.frames[frame.step].contacts.begin(), frame.contacts.front());
       frame.contacts.clear();
     }},
    {"a contact lost", "two-body:oblique solver=jacobi", "contact-set",
     [](Recording& r) { erase_contact(r, is_pair); }},
    {"a contact lost", "two-body:oblique vertex_stage=off", "contact-set",
     [](Recording& r) { erase_contact(r, is_pair); }},
    {"a contact given to another pair", "pile", "contact-set",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pair);
       c.b = c.b == 1 ? 2 : 1;
       if (c.a > c.b) std::swap(c.a, c.b);
     }},
};

TEST(Corruptions, OfTheSetOfContacts) {
  expect_rejected(kSets);
}

constexpr Corruption kGeometry[] = {
    {"a face's color", "two-body:rest", "contact-normal",
     [](Recording& r) { contact_that(r, bench::is_on_face).color = 3; }},
    {"a face that moves", "two-body:rest", "contact-normal",
     [](Recording& r) {
       Contact& c = contact_that(r, bench::is_on_face);
       c.pre_b.v = c.post_b.v = {1, 2, 3};
     }},
    {"a face at a place", "two-body:rest", "contact-normal",
     [](Recording& r) {
       Contact& c = contact_that(r, bench::is_on_face);
       c.pre_b.x = c.post_b.x = {0, 0, 1e-30F};
     }},
    {"another face", "two-body:rest", "contact-normal",
     [](Recording& r) { contact_that(r, bench::is_on_face).b ^= 1U; }},
    {"a depth one part in a million off", "two-body:head-on", "contact-normal",
     [](Recording& r) { contact_that(r, is_pair).depth_m *= 1.000002F; }},
    {"a depth of zero", "two-body:head-on", "contact-normal",
     [](Recording& r) { contact_that(r, is_pair).depth_m = 0; }},
    {"a normal the other way", "two-body:head-on", "contact-normal",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pair);
       c.normal = -1.0F * c.normal;
     }},
    {"a normal along another axis", "two-body:head-on", "contact-normal",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pair);
       c.normal = {c.normal.z, c.normal.x, c.normal.y};
     }},
    {"a normal that is a rounding too long", "two-body:head-on", "contact-normal",
     [](Recording& r) { contact_that(r, is_pair).normal.x *= 1.0000002F; }},
    {"two colors exchanged", "pile", "contact-normal",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (std::size_t k = 1; k < frame.contacts.size(); ++k) {
           Contact& c = frame.contacts[k - 1];
           Contact& d = frame.contacts[k];
           if (is_pair(c) && is_pair(d) && c.color != d.color && (c.a == d.a || c.b == d.b))
             return std::swap(c.color, d.color);
         }
       r.is_spoilable = false;
     }},
    {"a face before a pair", "pile", "contact-normal",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (const Contact& c : frame.contacts)
           for (Contact& other : frame.contacts)
             if (is_pair(other) && !is_pair(c) && (other.a == c.a || other.b == c.a))
               return std::swap(other, const_cast<Contact&>(c));
       r.is_spoilable = false;
     }},
};

TEST(Corruptions, OfTheGeometryOfContacts) {
  expect_rejected(kGeometry);
}

constexpr Corruption kChangedShares[] = {
    {"pushed a thousandth too far", "two-body:unequal", "contraction",
     [](Recording& r) {
       Contact& c = contact_that(r, bench::is_deep);
       c.post_a.x = c.post_a.x + 1e-3F * (c.post_a.x - c.pre_a.x);
       c.post_b.x = c.post_b.x + 1e-3F * (c.post_b.x - c.pre_b.x);
     }},
    {"moved inside the slop", "errata:E4", "contraction",
     [](Recording& r) { contact_that(r, is_idle_pair).post_a.x.x += 1e-6F; }},
    {"slop of the scene doubled", "two-body:head-on", "contraction",
     [](Recording& r) { r.header.scene.parameters.delta_m *= 2.0F; }},
    {"beta of the scene halved", "two-body:head-on", "contraction",
     [](Recording& r) { r.header.scene.parameters.beta *= 0.5F; }},
    {"alpha of the scene halved", "two-body:head-on", "contraction",
     [](Recording& r) { r.header.scene.parameters.alpha *= 0.5F; }},
    {"shares exchanged", "two-body:unequal", "center-of-mass",
     [](Recording& r) {
       Contact& c = contact_that(r, bench::is_deep);
       const Vec3 a = c.post_a.x - c.pre_a.x;
       c.post_a.x = c.pre_a.x - (c.post_b.x - c.pre_b.x);
       c.post_b.x = c.pre_b.x - a;
     }},
    {"an impulse on A alone", "two-body:unequal", "center-of-mass",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       c.post_b.v = c.pre_b.v;
     }},
    {"a mass of the scene doubled", "two-body:unequal", "center-of-mass",
     [](Recording& r) { r.header.scene.bodies[0].inverse_mass *= 0.5F; }},
    {"a static body that moved", "two-body:resting", "center-of-mass",
     [](Recording& r) {
       for (std::uint32_t i = 0; i < r.header.scene.body_count(); ++i)
         if (!(r.header.scene.bodies[i].inverse_mass > 0.0F)) r.frames[5].position[i].y += 1e-6F;
     }},
};

TEST(Corruptions, OfThePositionsThatContactsLeave) {
  expect_rejected(kChangedShares);
}

}  // namespace
}  // namespace broadside::tests
