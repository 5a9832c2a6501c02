// Contacts in another order, handed on to another body, or applied to a body that stood elsewhere.
#include <algorithm>
#include <utility>

#include "tests/validation/corruption.hpp"

namespace broadside::tests {
namespace {

constexpr const char* kJacobi = "pile solver=jacobi";
constexpr Vec3 kAside{1e-3F, 0.0F, 0.0F};

bool is_static(const Recording& r, std::uint32_t i) {
  return !core::is_face(i) && !(r.header.scene.bodies[i].inverse_mass > 0.0F);
}

// The first frame in whose list of contacts two neighbors meet the condition; returns these two.
template <typename Fits>
std::pair<Contact*, Contact*> neighbors(Recording& r, Fits fit) {
  for (FrameRecord& frame : r.frames)
    for (std::size_t k = 1; k < frame.contacts.size(); ++k)
      if (fit(frame.contacts[k - 1], frame.contacts[k])) return {&frame.contacts[k - 1], &frame.contacts[k]};
  r.is_spoilable = false;
  FrameRecord& frame = r.frames.front();
  frame.contacts.resize(2);
  return {&frame.contacts[0], &frame.contacts[1]};
}

bool share_a_body(const Contact& c, const Contact& d) {
  return c.a == d.a || c.a == d.b || c.b == d.a || (!core::is_face(c.b) && c.b == d.b);
}

// The static body of a contact, as it was when the contact was applied.
struct StaticSide {
  core::Kinematics* before;
  core::Kinematics* after;
  Contact* contact;
};

template <typename Fits>
StaticSide static_side(Recording& r, Fits fits) {
  Contact& c = contact_that(
      r, [&](const Contact& k) { return !core::is_face(k.b) && (is_static(r, k.a) || is_static(r, k.b)) && fits(k); });
  return is_static(r, c.a) ? StaticSide{&c.pre_a, &c.post_a, &c} : StaticSide{&c.pre_b, &c.post_b, &c};
}

// A direction across the normal, so that the depth does not change.
Vec3 across(const Contact& c) {
  return {c.normal.y * c.normal.y + c.normal.z * c.normal.z > 0.5F ? 1.0F : 0.0F, c.normal.x * c.normal.x, 0.0F};
}

constexpr Corruption kOrder[] = {
    {"two contacts of unlike colors exchanged, of unlike bodies", "pile", "contact-normal",
     [](Recording& r) {
       const auto [c, d] = neighbors(r, [](const Contact& k, const Contact& l) {
         return !core::is_face(l.b) && k.color < l.color && !share_a_body(k, l);
       });
       std::swap(*c, *d);
     }},
    {"a contact with a face before one of two other bodies", "pile", "contact-normal",
     [](Recording& r) {
       const auto [c, d] = neighbors(r, [](const Contact& k, const Contact& l) {
         return !core::is_face(k.b) && core::is_face(l.b) && !share_a_body(k, l);
       });
       std::swap(*c, *d);
     }},
    {"a color of a million", "pile", "contact-set",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (auto c = frame.contacts.rbegin(); c != frame.contacts.rend(); ++c)
           if (!core::is_face(c->b)) {
             c->color = 1000000;
             return;
           }
       r.is_spoilable = false;
     }},
    {"a color that its body had before", "pile", "contact-normal",
     [](Recording& r) {
       neighbors(r, [](const Contact& k, const Contact& l) {
         return !core::is_face(l.b) && share_a_body(k, l);
       }).second->color = 0;
     }},
    {"a color of faces at a contact of two bodies", "pile", "contact-normal",
     [](Recording& r) { contact_that(r, is_pair).color = core::kFaceColor; }},
    {"a face that does not exist", "two-body:rest", "state-sanity",
     [](Recording& r) { contact_that(r, is_any).b = core::kFirstFace + 6; }},
    {"a face as body A", "two-body:rest", "state-sanity",
     [](Recording& r) {
       Contact& c = contact_that(r, is_any);
       std::swap(c.a, c.b);
     }},
    {"A and B told the other way round", "two-body:head-on", "state-sanity",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       std::swap(c.a, c.b);
       std::swap(c.pre_a, c.pre_b);
       std::swap(c.post_a, c.post_b);
       c.normal = -1.0F * c.normal;
       c.tangent = -1.0F * c.tangent;
     }},
    {"a contact of two static bodies", "pile", "state-sanity",
     [](Recording& r) {
       Contact& c = r.frames[0].contacts.emplace_back();
       c.a = 5;
       c.b = 11;
       c.depth_m = 0.25F;
       c.normal = {1.0F, 0.0F, 0.0F};
     }},
    {"a contact with the floor twice", "two-body:rest", "contact-normal",
     [](Recording& r) {
       FrameRecord& frame = frame_with(r, is_any);
       const Contact again = frame.contacts.back();
       frame.contacts.push_back(again);
     }},
};

TEST(Contradictions, OfTheOrderOfContacts) {
  expect_rejected(kOrder);
}

constexpr Corruption kHandedOn[] = {
    {"a static body elsewhere during a contact", "two-body:resting", "state-sanity",
     [](Recording& r) {
       const StaticSide side = static_side(r, is_any);
       const Vec3 off = 1e-3F * across(*side.contact);
       side.before->x = side.before->x + off;
       side.after->x = side.after->x + off;
     }},
    {"a static body with a velocity during a contact that separates", "pile", "state-sanity",
     [](Recording& r) {
       const StaticSide side = static_side(r, is_idle);
       side.before->v = side.after->v = 1e3F * across(*side.contact);
     }},
    {"a static body with a velocity of rounding during a contact", "mixed", "state-sanity",
     [](Recording& r) {
       const StaticSide side = static_side(r, is_any);
       side.before->v.z = side.after->v.z = 1e-12F;
     }},
    {"a contact with the floor that starts before the others", "pile", "state-sanity",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (Contact& c : frame.contacts) {
           const core::Kinematics seen{frame.detected_position[c.a], frame.detected_velocity[c.a]};
           if (!core::is_face(c.b) || c.pre_a == seen) continue;
           c.pre_a = seen;
           return;
         }
       r.is_spoilable = false;
     }},
    {"what a contact left is given to the other body", "two-body:unequal", "state-sanity",
     [](Recording& r) {
       Contact& c = contact_that(r, is_pushing);
       std::swap(c.post_a, c.post_b);
     }},
    {"two bodies exchanged at the end of a frame", "two-body:head-on", "state-sanity",
     [](Recording& r) {
       FrameRecord& frame = r.frames[r.frames.size() / 2];
       std::swap(frame.position[0], frame.position[1]);
       std::swap(frame.velocity[0], frame.velocity[1]);
     }},
    {"two bodies exchanged when they were seen", "two-body:apart", "state-sanity",
     [](Recording& r) {
       FrameRecord& frame = r.frames[r.frames.size() / 2];
       std::swap(frame.detected_position[0], frame.detected_position[1]);
       std::swap(frame.boxes[0], frame.boxes[1]);
     }},
    {"a velocity that a later contact took over is another", "pile", "state-sanity",
     [](Recording& r) {
       neighbors(r, [](const Contact& k, const Contact& l) {
         return k.a == l.a && !core::is_face(l.b);
       }).second->pre_a.v.z += 1e-5F;
     }},
};

TEST(Contradictions, OfWhatContactsHandOn) {
  expect_rejected(kHandedOn);
}

// Every contact of two bodies starts from the states at detection, and the changes are added up.
constexpr Corruption kJacobiSums[] = {
    {"a contact starts elsewhere", kJacobi, "state-sanity",
     [](Recording& r) {
       Contact& c = contact_that(r, [&](const Contact& k) { return is_pair(k) && !is_static(r, k.a); });
       const Vec3 off = 1e-4F * across(c);
       c.pre_a.x = c.pre_a.x + off;
       c.post_a.x = c.post_a.x + off;
     }},
    {"a contact that separates starts faster", kJacobi, "state-sanity",
     [](Recording& r) {
       Contact& c =
           contact_that(r, [&](const Contact& k) { return is_idle_pair(k) && !is_static(r, k.a) && k.depth_m > 0.0F; });
       c.pre_a.v = c.post_a.v = c.pre_a.v + 10.0F * across(c);
     }},
    {"an end that no sum of contacts gives", kJacobi, "state-sanity",
     [](Recording& r) { frame_with(r, is_pair).position[0].x += 1e-3F; }},
    {"an end velocity that no sum of contacts gives", kJacobi, "state-sanity",
     [](Recording& r) { frame_with(r, is_pair).velocity[0].x += 1e-3F; }},
    {"a contact that was not added", kJacobi, "state-sanity",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (const Contact& c : frame.contacts) {
           if (!is_pair(c) || !is_pushing(c) || is_static(r, c.a)) continue;
           frame.velocity[c.a] = frame.velocity[c.a] - (c.post_a.v - c.pre_a.v);
           return;
         }
       r.is_spoilable = false;
     }},
    {"a contact with the floor that starts from what was seen", kJacobi, "state-sanity",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (Contact& c : frame.contacts) {
           const core::Kinematics seen{frame.detected_position[c.a], frame.detected_velocity[c.a]};
           if (!core::is_face(c.b) || c.pre_a == seen) continue;
           c.pre_a = seen;
           return;
         }
       r.is_spoilable = false;
     }},
    {"a contact lost", kJacobi, "contact-set", [](Recording& r) { erase_contact(r, is_pair); }},
    {"a body outside the domain in silence", kJacobi, "state-sanity",
     [](Recording& r) { r.frames.back().position[0] = r.header.scene.domain.min + -5.0F * kAside; }},
};

TEST(Contradictions, OfContactsThatAreAddedUp) {
  expect_rejected(kJacobiSums);
}

}  // namespace
}  // namespace broadside::tests
