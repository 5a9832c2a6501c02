// A world that obeys the method passes every validator that applies.
#include <set>
#include <string>

#include "tests/validation/sound_world.hpp"

namespace broadside::tests {
namespace {

TEST(SoundTrace, HasEveryKindOfContact) {
  int shared = 0;
  int on_static = 0;
  int face = 0;
  int in_slop = 0;
  int sliding = 0;
  int bouncing = 0;
  int separating = 0;
  for (const FrameRecord& frame : sound().frames)
    for (const Contact& c : frame.contacts) {
      const bool is_face = core::is_face(c.b);
      face += is_face;
      on_static += !is_face && (c.a == 2 || c.b == 2);
      shared += !is_face && c.a != 2 && c.b != 2;
      in_slop += c.depth_m < 0.01F;
      sliding += c.tangent_impulse_n_s < 0.0F;
      separating += c.normal_impulse_n_s == 0.0F;
      bouncing += c.normal_impulse_n_s > 0.5F;
    }
  EXPECT_GT(shared, 0);
  EXPECT_GT(on_static, 0);
  EXPECT_GT(face, 0);
  EXPECT_GT(in_slop, 0);
  EXPECT_GT(sliding, 0);
  EXPECT_GT(bouncing, 0);
  EXPECT_GT(separating, 0);
}

TEST(SoundTrace, PassesAlone) {
  for (const core::Verdict& v : judged(sound())) {
    // These do not apply: no second run, no transformed scene, no spring, no octree was recorded.
    // Nor does a body turn, and what the method's own laws judge is not judged again.
    const std::set<std::string> without{"determinism", "metamorphic",      "stability",     "octree-invariants",
                                        "gyroscopic",  "momentum",         "friction-cone", "unilateral",
                                        "rest",        "angular-momentum", "contact-truth", "penetration",
                                        "closed-form", "energy-growth",    "passage"};
    if (without.contains(v.validator))
      EXPECT_EQ(v.outcome, core::Outcome::kNotApplicable) << line(v);
    else
      EXPECT_EQ(v.outcome, core::Outcome::kPass) << line(v);
    EXPECT_FALSE(v.explanation.empty()) << v.validator;
    if (v.outcome == core::Outcome::kPass) {
      EXPECT_GT(v.checked, 0u) << v.validator;
      EXPECT_FALSE(v.origin.empty()) << v.validator;
      EXPECT_LE(v.measured, v.limit) << line(v);
    }
  }
}

TEST(SoundTrace, AgreesWithItself) {
  const core::Verdict v = verdict_of("determinism", sound(), &sound());
  EXPECT_EQ(v.outcome, core::Outcome::kPass) << line(v);
  EXPECT_EQ(v.checked, sound().frames.size());
}

}  // namespace
}  // namespace broadside::tests
