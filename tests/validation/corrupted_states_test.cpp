// States, boxes and times that were changed in a recording: the law of each kind names it.
#include <cmath>
#include <limits>

#include "tests/validation/corruption.hpp"

namespace broadside::tests {
namespace {

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();
constexpr core::Quat kQuarterTurn{0.70710678F, 0.0F, 0.0F, 0.70710678F};

std::uint32_t static_body(Recording& r) {
  for (std::uint32_t i = 0; i < r.header.scene.body_count(); ++i)
    if (!(r.header.scene.bodies[i].inverse_mass > 0.0F)) return i;
  r.is_spoilable = false;
  return 0;
}

// Everything but step and time.
void exchange_frames(Recording& r, std::size_t k) {
  std::swap(r.frames[k], r.frames[k + 1]);
  std::swap(r.frames[k].step, r.frames[k + 1].step);
  std::swap(r.frames[k].time_s, r.frames[k + 1].time_s);
}

constexpr Corruption kTurning[] = {
    {"an orientation jumps for one frame", "two-body:apart", "state-sanity",
     [](Recording& r) { middle(r).orientation[0] = kQuarterTurn; }},
    {"an orientation jumps and stays", "two-body:apart", "state-sanity",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         if (frame.step > 5) frame.orientation[0] = kQuarterTurn;
     }},
    {"an orientation is another in all frames", "two-body:apart", "state-sanity",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames) frame.orientation[0] = kQuarterTurn;
     }},
    {"an orientation is the opposite quaternion", "two-body:apart", "state-sanity",
     [](Recording& r) {
       middle(r).orientation[0] = {-1, 0, 0, 0};
     }},
    {"an angular velocity of a million", "two-body:apart", "state-sanity",
     [](Recording& r) {
       middle(r).angular_velocity[0] = {0, 1e6F, 0};
     }},
    {"a small angular velocity", "two-body:apart", "state-sanity",
     [](Recording& r) { middle(r).angular_velocity[0].z = 1e-20F; }},
    {"an angular velocity in the last frame", "two-body:apart", "state-sanity",
     [](Recording& r) { r.frames.back().angular_velocity[1].x = 1.0F; }},
    {"a quaternion that is not unit", "two-body:apart", "state-sanity",
     [](Recording& r) { middle(r).orientation[0].w = 1.000001F; }},
};

TEST(Corruptions, OfTurning) {
  expect_rejected(kTurning);
}

constexpr Corruption kStates[] = {
    {"a position moves by a micrometer", "two-body:apart", "state-sanity",
     [](Recording& r) { middle(r).position[0].x += 1e-6F; }},
    {"a position jumps in the last frame", "two-body:apart", "state-sanity",
     [](Recording& r) { r.frames.back().position[0].x += 1.0F; }},
    {"a velocity changes without a contact", "two-body:apart", "state-sanity",
     [](Recording& r) { middle(r).velocity[0].x += 1e-3F; }},
    {"the velocity of a static body in the last frame", "two-body:resting", "state-sanity",
     [](Recording& r) { r.frames.back().velocity[static_body(r)].x = 1.0F; }},
    {"the velocity of a static body", "two-body:resting", "state-sanity",
     [](Recording& r) { middle(r).velocity[static_body(r)].y = -1.0F; }},
    {"a static body seen elsewhere", "two-body:resting", "state-sanity",
     [](Recording& r) { middle(r).detected_position[static_body(r)].y += 1e-6F; }},
    {"a position seen elsewhere", "two-body:slide", "state-sanity",
     [](Recording& r) { middle(r).detected_position[0].x += 1e-5F; }},
    {"a velocity seen otherwise", "two-body:slide", "state-sanity",
     [](Recording& r) { middle(r).detected_velocity[0].y += 1e-4F; }},
    {"a box one rounding too large", "two-body:slide", "state-sanity",
     [](Recording& r) { middle(r).boxes[0].max.x *= 1.0000004F; }},
    {"a box turned inside out", "two-body:slide", "state-sanity",
     [](Recording& r) { std::swap(middle(r).boxes[0].min.y, middle(r).boxes[0].max.y); }},
    {"boxes of the frame before", "two-body:slide", "state-sanity",
     [](Recording& r) { r.frames[9].boxes = r.frames[8].boxes; }},
    {"a body less", "two-body:slide", "state-sanity", [](Recording& r) { middle(r).position.pop_back(); }},
    {"infinity", "two-body:apart", "state-sanity",
     [](Recording& r) { middle(r).velocity[0].z = std::numeric_limits<float>::infinity(); }},
    {"no number in a position seen", "two-body:apart", "state-sanity",
     [](Recording& r) { middle(r).detected_position[0].z = kNoNumber; }},
    {"another time", "two-body:apart", "state-sanity", [](Recording& r) { middle(r).time_s *= 1.0 + 1e-15; }},
    {"another step length in the scene", "two-body:apart", "state-sanity",
     [](Recording& r) { r.header.scene.dt_s *= 1.001F; }},
    {"gravity of the scene turned off", "two-body:resting", "state-sanity",
     [](Recording& r) { r.header.scene.gravity_m_s2 = {}; }},
    {"two frames exchanged", "two-body:slide", "state-sanity", [](Recording& r) { exchange_frames(r, 9); }},
    {"a frame twice, and one lost", "two-body:slide", "state-sanity",
     [](Recording& r) {
       const FrameRecord before = r.frames[9];
       r.frames[10] = before;
       r.frames[10].step = 11;
       r.frames[10].time_s = 11.0 * r.header.scene.dt_s;
     }},
    {"a contact begins elsewhere", "two-body:head-on", "state-sanity",
     [](Recording& r) { contact_that(r, is_pushing).pre_a.x.y += 1e-6F; }},
    {"a contact leaves a state that nobody goes on from", "two-body:head-on", "state-sanity",
     [](Recording& r) { contact_that(r, is_pushing).post_b.v.z += 1e-3F; }},
    {"a component above the cap", "two-body:apart", "velocity-cap",
     [](Recording& r) { middle(r).velocity[0].x = std::nextafter(r.header.scene.parameters.v_max_m_s, 1e9F); }},
    {"a component below the negative cap", "two-body:apart", "velocity-cap",
     [](Recording& r) { middle(r).velocity[0].x = -51.0F; }},
    {"a cap of the scene that was passed", "two-body:head-on", "velocity-cap",
     [](Recording& r) { r.header.scene.parameters.v_max_m_s = 0.25F; }},
    {"energy from nowhere", "two-body:slide", "energy", [](Recording& r) { middle(r).velocity[0].x += 0.1F; }},
    {"energy that vanishes", "two-body:slide", "energy", [](Recording& r) { r.frames[9].velocity[0].x *= 0.5F; }},
    {"a spring that pulls more", "springs:hanging", "stability",
     [](Recording& r) { r.header.scene.springs[0].stiffness_n_m *= 1.01F; }},
    {"a spring too stiff for the step", "springs:hanging", "stability",
     [](Recording& r) { r.header.scene.springs[0].stiffness_n_m *= 1e6F; }},
    {"a state on a spring that jumps", "springs:hanging", "stability",
     [](Recording& r) { middle(r).detected_velocity[r.header.scene.springs[0].body].y += 1e-3F; }},
};

TEST(Corruptions, OfStates) {
  expect_rejected(kStates);
}

// Both frames of an exchange are wrong, and the first is named although the second may be farther off.
TEST(Corruptions, AnExchangeOfFramesIsNamedAtTheFirstOfThem) {
  Recording r = sound_run("two-body:slide");
  exchange_frames(r, 9);
  const core::Verdict v = verdict_of("state-sanity", r);
  EXPECT_EQ(v.outcome, core::Outcome::kFail) << line(v);
  const bool is_worst = v.worst.step == 10;
  const bool is_told = v.explanation.find("first at step 10,") != std::string::npos;
  EXPECT_TRUE(is_worst || is_told) << line(v);
}

}  // namespace
}  // namespace broadside::tests
