// Each limit is where its law says: a value at nine tenths of it passes, one at eleven tenths fails. The limits are
// worked out here by hand, in units of u = 2^-24, for single contacts and bodies made for that.
#include <cmath>
#include <functional>

#include "core/scene/body_octree.hpp"
#include "tests/validation/sound_world.hpp"

namespace broadside::tests {
namespace {

constexpr double kRoundoff = 0x1p-24;

// A recording whose judged value is off by this much.
struct Verge {
  const char* what;
  const char* law;
  double limit;
  std::function<Recording(double off)> make;
};

void expect_verges(const std::vector<Verge>& verges) {
  for (const Verge& verge : verges) {
    SCOPED_TRACE(std::string(verge.law) + ": " + verge.what);
    const core::Verdict inside = verdict_of(verge.law, verge.make(0.9 * verge.limit));
    EXPECT_EQ(inside.outcome, core::Outcome::kPass) << line(inside);
    const core::Verdict outside = verdict_of(verge.law, verge.make(1.1 * verge.limit));
    EXPECT_EQ(outside.outcome, core::Outcome::kFail) << line(outside);
  }
}

float rounded(double x) {
  return static_cast<float>(x);
}

// Two unit cubes of 1 kg and one contact, without gravity, slop and threshold; e = 0.3, mu = 0.6 and 0.5.
Recording with_contact(const Contact& contact, float w_b) {
  Recording r;
  core::Scene& scene = r.header.scene;
  scene = mixed_scene();
  scene.gravity_m_s2 = {};
  scene.domain = {{-100, -100, -100}, {100, 100, 100}};
  scene.parameters.alpha = scene.parameters.beta = 1.0F;
  scene.parameters.delta_m = 0.0F;
  scene.bodies = {body_at(contact.pre_a.x, {}, 1.0F), body_at(contact.pre_b.x, {}, w_b)};
  r.header.stamp.settings = "solver=colored";
  r.header.declaration = core::method_declaration();
  r.header.groups = core::bit(core::Group::kContacts);
  r.frames.emplace_back().step = 2;
  r.frames[0].contacts = {contact};
  return r;
}

// A moves along x against B, which lies in the direction of -normal; nothing else happens.
Contact along_x(double pre_a, double post_a, double pre_b, double post_b) {
  Contact c;
  c.a = 0;
  c.b = 1;
  c.normal = {1, 0, 0};
  c.depth_m = 0.5F;
  c.pre_a.x.x = rounded(pre_a), c.post_a.x.x = rounded(post_a);
  c.pre_b.x.x = rounded(pre_b), c.post_b.x.x = rounded(post_b);
  return c;
}

// A comes at the speed `before` against a static B and leaves at `after`; the impulse is what that change takes.
Contact bounce(double before, double after) {
  Contact c = along_x(1, 1, 0, 0);
  c.depth_m = 0.0F;
  c.pre_a.v.x = rounded(before), c.post_a.v.x = rounded(after);
  c.normal_impulse_n_s = rounded(after - before);
  return c;
}

Recording bounced(double before, double after, float v_threshold, float impulse_min) {
  Recording r = with_contact(bounce(before, after), 0.0F);
  r.header.scene.parameters.v_threshold_m_s = v_threshold;
  r.header.scene.parameters.impulse_min_n_s = impulse_min;
  return r;
}

TEST(Limits, OfWhatAContactDoesToPositionsAndMomentum) {
  expect_verges({
      // Both bodies move by half a meter to near 0, where additions hardly round: 3 u of each displacement.
      {"displacement", "center-of-mass", 3 * kRoundoff,
       [](double off) { return with_contact(along_x(-0.5, off, 0.5, 0), 1.0F); }},
      // Both gain 1 m/s and end near 0: 3 u of each.
      {"momentum", "center-of-mass", 6 * kRoundoff,
       [](double off) {
         Contact c = along_x(1, 1, 0, 0);
         c.pre_a.v.x = -1.0F, c.post_a.v.x = rounded(off);
         c.pre_b.v.x = 1.0F;
         return with_contact(c, 1.0F);
       }},
      // 7 u of a correction by half a meter that ends near 0.
      {"correction", "contraction", 3.5 * kRoundoff,
       [](double off) { return with_contact(along_x(-0.5, off, 0.25, 0.25), 0.0F); }},
  });
}

TEST(Limits, OfNormalImpulses) {
  const double e = 0.3F;
  const double floored = 0.5 - 0.4F;  // J_min - |v_n|, of 1 kg
  expect_verges({
      // (1 + e)(4 + 4) u of 1 m/s, 2 u of the speed after, 3 u of the change.
      {"a bounce", "restitution", ((1 + e) * 8 + 2 * e + 3 * (1 + e)) * kRoundoff,
       [e](double off) { return bounced(-1, e + off, 0.3F, 0.01F); }},
      {"a bounce too low", "restitution", ((1 + e) * 8 + 2 * e + 3 * (1 + e)) * kRoundoff,
       [e](double off) { return bounced(-1, e - off, 0.3F, 0.01F); }},
      // No bounce from 1/4 m/s: 8 u of that, and 3 u of the change.
      {"a stop", "restitution", 11 * 0.25 * kRoundoff, [](double off) { return bounced(-0.25, off, 0.3F, 0.01F); }},
      // J_min = 1/2 N s: 1 u of what it changes, 2 u of the speed after, 3 u of the change.
      {"the floor", "restitution", (0.5 + 2 * floored + 3 * 0.5) * kRoundoff,
       [floored](double off) { return bounced(-0.4F, floored + off, 10.0F, 0.5F); }},
      {"below the floor", "restitution", (0.5 + 2 * floored + 3 * 0.5) * kRoundoff,
       [floored](double off) { return bounced(-0.4F, floored - off, 10.0F, 0.5F); }},
      // A floor beyond the neutral impulse, 2 m/s: 2 times 8 u of 1 m/s, u of 2, 2 u of 1, 3 u of 2.
      {"the neutral impulse", "restitution", (16 + 2 + 2 + 6) * kRoundoff,
       [](double off) { return bounced(-1, 1 - off, 10.0F, 100.0F); }},
      // v_n' = 1: 2 times 8 u, 2 u of the speed after, 3 u of the change.
      {"a gain of energy", "normal-energy", (16 + 2 + 6) * kRoundoff,
       [](double off) { return bounced(-1, 1 + off, 0.3F, 0.01F); }},
      // From 1 m/s to rest: 3 u of the change, and 4 u of the impulse itself.
      {"the recorded impulse", "normal-energy", 7 * kRoundoff,
       [](double off) {
         Contact c = bounce(-1, 0);
         c.normal_impulse_n_s = rounded(1 + off);
         return with_contact(c, 0.0F);
       }},
  });
}

// A slides at this speed over a static B, which it meets at 1 m/s and leaves at 0.3 m/s; friction takes the given
// impulse.
Recording slid(double speed, double impulse_n_s, Vec3 tangent = {0, 1, 0}) {
  Contact c = bounce(-1, 0.3F);
  c.pre_a.v.y = rounded(speed);
  c.post_a.v.y = rounded(speed - impulse_n_s);
  c.tangent = tangent;
  c.tangent_impulse_n_s = rounded(-impulse_n_s);
  return with_contact(c, 0.0F);
}

TEST(Limits, OfFriction) {
  const double j_n = rounded(1 + double{0.3F});
  expect_verges({
      // |v_t| = 1/8: 2 u of it and 6 u of the approach, and 5 u of the impulse.
      {"what stops", "friction-energy", (2 * 0.125 + 6 + 5 * 0.125) * kRoundoff,
       [](double off) { return slid(0.125, 0.125 + off); }},
      {"less than what stops", "friction-energy", (2 * 0.125 + 6 + 5 * 0.125) * kRoundoff,
       [](double off) { return slid(0.125, 0.125 - off); }},
      // 3 u of mu_k J_n = 0.65 N s, where floats are u apart: one of them is inside and two are not. The speed of 4 m/s
      // rounds more than that, and is judged with more.
      {"what brakes", "friction-energy", 3 * 0.5 * j_n * kRoundoff,
       [j_n](double off) { return slid(4, 0.5 * j_n + kRoundoff * std::floor(off / kRoundoff)); }},
      // Sliding at 1 m/s: (2 + 6) u over |v_t| and 4 u. Without friction nothing follows from the tangent.
      {"the tangent", "friction-energy", 12 * kRoundoff,
       [](double off) {
         Recording r = slid(1, 0, {0, 1, rounded(off)});
         for (core::Body& b : r.header.scene.bodies) b.material.mu_static = b.material.mu_kinetic = 0.0F;
         return r;
       }},
  });
}

// One cube at step 1 of the scene, where detection saw it; whatever is not given is as at the start.
Recording one_body(Vec3 start, Vec3 velocity, Vec3 gravity, const Kinematics& seen) {
  Recording r;
  core::Scene& scene = r.header.scene;
  scene = mixed_scene();
  scene.domain = {{-100, -100, -100}, {100, 100, 100}};
  scene.dt_s = 0x1p-6F;
  scene.gravity_m_s2 = gravity;
  scene.bodies = {body_at(start, velocity, 1.0F)};
  r.header.declaration = core::method_declaration();
  r.header.groups = core::bit(core::Group::kDetection);
  FrameRecord& frame = r.frames.emplace_back();
  frame.step = 1;
  frame.time_s = 0x1p-6;
  frame.detected_position = {seen.x};
  frame.detected_velocity = {seen.v};
  frame.boxes = {core::translated({{-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F}}, seen.x)};
  return r;
}

// Inside the domain, `off` from its +x face at 1/2 m, without a contact.
Recording at_a_face(double off) {
  Recording r = one_body({rounded(off), 0, 0}, {}, {}, {{rounded(off), 0, 0}, {}});
  r.header.scene.domain.max.x = 0.5F;
  r.header.stamp.settings = "solver=colored";
  r.header.groups |= core::bit(core::Group::kBodies) | core::bit(core::Group::kContacts);
  FrameRecord& frame = r.frames[0];
  frame.position = frame.detected_position;
  frame.velocity = frame.detected_velocity;
  frame.orientation.resize(1);
  frame.angular_velocity.resize(1);
  return r;
}

TEST(Limits, OfStates) {
  expect_verges({
      // The cube's side at 1/2 m moved by `off`, which the box does not show.
      {"a box", "state-sanity", 0.5 * kRoundoff,
       [](double off) {
         Recording r = one_body({rounded(off), 0, 0}, {}, {}, {{rounded(off), 0, 0}, {}});
         r.frames[0].boxes = {{{-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F}}};
         return r;
       }},
      // Gravity takes 1 m/s away and leaves nearly nothing: u of 1 m/s.
      {"P(2)", "state-sanity", kRoundoff,
       [](double off) {
         return one_body({}, {1, 0, 0}, {-64, 0, 0}, {{rounded(off / 64), 0, 0}, {rounded(off), 0, 0}});
       }},
      // The same for a step of 1 m.
      {"P(3)", "state-sanity", kRoundoff,
       [](double off) {
         return one_body({-1, 0, 0}, {64, 0, 0}, {}, {{rounded(off), 0, 0}, {64, 0, 0}});
       }},
      // 5 roundings of a component, doubled by the square.
      {"a quaternion's square", "state-sanity", 10 * kRoundoff,
       [](double off) {
         Recording r = at_a_face(0);
         r.header.groups = core::bit(core::Group::kBodies);
         r.frames[0].orientation[0] = {1, rounded(std::sqrt(off)), 0, 0};
         return r;
       }},
      {"beyond a face", "state-sanity", 0.5 * kRoundoff, at_a_face},
  });
}

// Jacobi's only contact stops A, which came with 1 m/s; what the frame ends with is off.
Recording stopped_by_a_sum(double off_x, double off_v) {
  Contact c = bounce(-1, 0);
  c.pre_a.x.x = -1.0F, c.post_a.x.x = 0.0F;
  Recording r = with_contact(c, 0.0F);
  r.header.stamp.settings = "solver=jacobi";
  r.header.declaration = core::method_declaration();
  r.header.groups |= core::bit(core::Group::kBodies) | core::bit(core::Group::kDetection);
  FrameRecord& frame = r.frames[0];
  frame.time_s = 2.0 * r.header.scene.dt_s;
  frame.detected_position = {c.pre_a.x, c.pre_b.x};
  frame.detected_velocity = {c.pre_a.v, c.pre_b.v};
  const Box local = core::bounds(*r.header.scene.meshes[0]);
  for (const Vec3 x : frame.detected_position) frame.boxes.push_back(core::translated(local, x));
  frame.position = {{rounded(off_x), 0, 0}, c.post_b.x};
  frame.velocity = {{rounded(off_v), 0, 0}, c.post_b.v};
  frame.orientation.resize(2);
  frame.angular_velocity.resize(2);
  return r;
}

TEST(Limits, OfChangesThatAreAddedUp) {
  expect_verges({
      // One change of 1 m, one of 1 m/s, to near 0: the subtraction and the sum, 2 u.
      {"a position", "state-sanity", 2 * kRoundoff, [](double off) { return stopped_by_a_sum(off, 0.0); }},
      {"a velocity", "state-sanity", 2 * kRoundoff, [](double off) { return stopped_by_a_sum(0.0, off); }},
  });
}

// A pair of confirmed cubes 1/8 m apart, whose boxes say that they are within 1 m of the origin.
TEST(Limits, OfNearestVertices) {
  const double reach = std::sqrt(3.0) * (1 + 1) * kRoundoff;
  expect_verges({
      {"the distance of the witnesses", "proximity-bound", reach + 3 * 0.125 * kRoundoff,
       [](double off) {
         Recording r;
         r.header.scene = mixed_scene();
         r.header.scene.bodies = {body_at({}, {}, 1.0F), body_at({1.125F, 0, 0}, {}, 1.0F)};
         r.header.declaration = core::method_declaration();
         r.header.groups = core::bit(core::Group::kConfirmed) | core::bit(core::Group::kDetection);
         FrameRecord& frame = r.frames.emplace_back();
         frame.step = 1;
         frame.detected_position = {{0, 0, 0}, {1.125F, 0, 0}};
         frame.detected_velocity.resize(2);
         frame.boxes = {{{-1, -1, -1}, {1, 1, 1}}, {{-1, -1, -1}, {1, 1, 1}}};
         frame.confirmed = {{0, 1}};
         const auto& vertices = r.header.scene.meshes[0]->vertices;
         const auto index_of = [&](Vec3 v) {
           return static_cast<std::uint32_t>(std::find(vertices.begin(), vertices.end(), v) - vertices.begin());
         };
         // All vertices of the two sides are equally near: the lowest one of A is recorded.
         const auto a = std::find_if(vertices.begin(), vertices.end(), [](Vec3 v) { return v.x == 0.5F; });
         const double d = 0.125 - off;
         frame.proximity = {{rounded(d * d), index_of(*a), index_of({-0.5F, a->y, a->z})}};
         return r;
       }},
  });
}

// Two cubes side by side, with the normal and the depth that A was given. Positions that float has give no tenths of
// these limits: here the values on both sides are whole and half roundings.
core::Outcome geometry(Vec3 b, Vec3 normal, float depth_m, Vec3 a = {}) {
  Contact c;
  c.a = 0;
  c.b = 1;
  c.normal = normal;
  c.depth_m = depth_m;
  c.pre_a.x = c.post_a.x = a;
  c.pre_b.x = c.post_b.x = b;
  return verdict_of("contact-normal", with_contact(c, 1.0F)).outcome;
}

TEST(Limits, OfTheDepthAndTheAxisOfAContact) {
  // Overlap of 1 - x on the x axis, with x a few 2^-26 below 1/2: the depth may be off by u / 2.
  const auto x_at = [](double off) { return rounded(0.5 - off); };
  EXPECT_EQ(geometry({x_at(0.25 * kRoundoff), 0.25F, 0}, {-1, 0, 0}, 0.5F), core::Outcome::kPass);
  EXPECT_EQ(geometry({x_at(0.5 * kRoundoff), 0.25F, 0}, {-1, 0, 0}, 0.5F), core::Outcome::kPass);
  EXPECT_EQ(geometry({x_at(1.0 * kRoundoff), 0.25F, 0}, {-1, 0, 0}, 0.5F), core::Outcome::kFail);
  // Least overlap of 3/4 on y: x may be more by 1.5 u.
  EXPECT_EQ(geometry({0.25F, rounded(0.25 + 1.0 * kRoundoff), 0}, {-1, 0, 0}, 0.75F), core::Outcome::kPass);
  EXPECT_EQ(geometry({0.25F, rounded(0.25 + 2.0 * kRoundoff), 0}, {-1, 0, 0}, 0.75F), core::Outcome::kFail);
}

}  // namespace
}  // namespace broadside::tests
