// Where bodies were between the parts of a step, and how the law `passage` uses that.
#include <cmath>
#include <vector>

#include "tests/validation/mechanics/one_step.hpp"

namespace broadside::tests {
namespace {

using bench::Specimen;

// A cube of 1 m moves from one place to another within a step, past a static one at the origin, through these places.
Specimen goes(core::Vec3 from, core::Vec3 to, const std::vector<core::Vec3>& between) {
  Specimen r = one_step(2);
  r.header.scene.bodies[0].inverse_mass = 0.0F;
  r.header.scene.bodies[1].position = from;
  r.header.groups |= core::bit(core::Group::kPartPoses);
  core::FrameRecord& frame = end_step(r, [&](core::WideStates& end) { end.position[1] = {to.x, to.y, to.z}; });
  for (const core::Vec3 at : between) {
    frame.part_poses.push_back({{}, {}});
    frame.part_poses.push_back({at, {}});
  }
  return r;
}

TEST(PartPoses, WhoGoesAroundAnotherPassesNothing) {
  const core::Verdict through = law("passage", goes({-2, 0, 0}, {2, 0, 0}, {}));
  EXPECT_EQ(through.outcome, core::Outcome::kFail) << told(through);
  const core::Verdict around = law("passage", goes({-2, 0, 0}, {2, 0, 0}, {{-2, 3, 0}, {2, 3, 0}}));
  EXPECT_EQ(around.outcome, core::Outcome::kPass) << told(around);
}

TEST(PartPoses, WhoCameBackThroughAnotherPassed) {
  EXPECT_NE(law("passage", goes({-2, 0, 0}, {-2, 0.5F, 0}, {})).outcome, core::Outcome::kFail);
  const core::Verdict back = law("passage", goes({-2, 0, 0}, {-2, 0.5F, 0}, {{2, 0, 0}}));
  EXPECT_EQ(back.outcome, core::Outcome::kFail) << told(back);
}

// Fewer poses than bodies, or one that is NaN: the law uses the two ends alone.
TEST(PartPoses, ThatAreNoneAreNotTaken) {
  Specimen few = goes({-2, 0, 0}, {2, 0, 0}, {{-2, 3, 0}, {2, 3, 0}});
  few.frames.front().part_poses.pop_back();
  EXPECT_EQ(law("passage", few).outcome, core::Outcome::kFail);
  Specimen broken = goes({-2, 0, 0}, {2, 0, 0}, {{-2, 3, 0}, {2, 3, 0}});
  broken.frames.front().part_poses.back().position.y = NAN;
  EXPECT_EQ(law("passage", broken).outcome, core::Outcome::kFail);
}

}  // namespace
}  // namespace broadside::tests
