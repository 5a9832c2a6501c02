// Digests, statistics and provenance that contradict the frames: the law of each kind names it.
#include <cmath>
#include <limits>

#include "core/pair.hpp"
#include "tests/validation/corruption.hpp"

namespace broadside::tests {
namespace {

constexpr const char* kScene = "two-body:oblique";
constexpr auto kKept = Digests::kKept;

constexpr Corruption kDigests[] = {
    {"all zeros", kScene, "frame-digest",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames) frame.digest = 0;
     },
     kKept},
    {"one zero", kScene, "frame-digest", [](Recording& r) { middle(r).digest = 0; }, kKept},
    {"one bit", kScene, "frame-digest", [](Recording& r) { middle(r).digest ^= 1; }, kKept},
    {"that of the frame before", kScene, "frame-digest", [](Recording& r) { r.frames[9].digest = r.frames[8].digest; },
     kKept},
    {"a digest although the provenance says none", kScene, "frame-digest",
     [](Recording& r) { r.header.notes["digest"] = "none"; }, kKept},
    {"a zero of the other sign", kScene, "frame-digest", [](Recording& r) { middle(r).angular_velocity[0].x = -0.0F; },
     kKept},
    {"a position", kScene, "frame-digest", [](Recording& r) { r.frames.back().position[1].z += 1e-6F; }, kKept},
    {"a velocity", kScene, "frame-digest", [](Recording& r) { r.frames.back().velocity[1].z += 1e-6F; }, kKept},
    {"an orientation", kScene, "frame-digest", [](Recording& r) { middle(r).orientation[1].x = 1e-20F; }, kKept},
    {"a confirmed pair lost", kScene, "frame-digest", [](Recording& r) { frame_with(r, is_pair).confirmed.clear(); },
     kKept},
    {"a contact lost", kScene, "frame-digest", [](Recording& r) { erase_contact(r, is_pair); }, kKept},
    {"a color", kScene, "frame-digest", [](Recording& r) { ++contact_that(r, is_pair).color; }, kKept},
    {"a depth", kScene, "frame-digest", [](Recording& r) { contact_that(r, is_pair).depth_m *= 1.0000002F; }, kKept},
    {"a normal impulse", kScene, "frame-digest",
     [](Recording& r) { contact_that(r, is_pushing).normal_impulse_n_s *= 1.0000002F; }, kKept},
    {"a tangent impulse", kScene, "frame-digest",
     [](Recording& r) { contact_that(r, is_pushing).tangent_impulse_n_s *= 1.0000002F; }, kKept},
    {"a tangent", kScene, "frame-digest", [](Recording& r) { contact_that(r, is_pushing).tangent.x += 1e-9F; }, kKept},
    {"a state that a contact left", kScene, "frame-digest",
     [](Recording& r) { contact_that(r, is_pushing).post_b.v.z += 1e-9F; }, kKept},
};

TEST(Corruptions, OfDigests) {
  expect_rejected(kDigests);
}

// A scene with more than two windows of the statistics, of a hundred frames each.
constexpr const char* kLong = "two-body:resting[frames=250]";

constexpr Corruption kStatistics[] = {
    {"level digest although there are states", kLong, "recording",
     [](Recording& r) { r.header.level = core::RecordLevel::kDigest; }},
    {"level none although there are frames", kLong, "recording",
     [](Recording& r) { r.header.level = core::RecordLevel::kNone; }},
    {"level full although there is nothing", kLong, "recording", [](Recording& r) { r.header.groups = 0; }},
    {"every second frame, it says", kLong, "recording", [](Recording& r) { r.header.every = 2; }},
    {"every frame, it says, and one is missing", kLong, "recording",
     [](Recording& r) {
       r.statistics.clear();
       r.frames.erase(r.frames.begin() + 120);
     }},
    {"every fifth frame, it says, and one is missing", kLong, "recording",
     [](Recording& r) {
       r.statistics.clear();
       r.header.every = 5;
       std::erase_if(r.frames, [](const FrameRecord& f) { return f.step % 5 != 0 || f.step == 100; });
     }},
    {"a row lost", kLong, "recording", [](Recording& r) { r.statistics.pop_back(); }},
    {"a row too many", kLong, "recording", [](Recording& r) { r.statistics.push_back(r.statistics.back()); }},
    {"two rows exchanged", kLong, "recording", [](Recording& r) { std::swap(r.statistics[0], r.statistics[1]); }},
    {"the first step", kLong, "recording", [](Recording& r) { ++r.statistics[1].first_step; }},
    {"the last step", kLong, "recording", [](Recording& r) { --r.statistics[1].last_step; }},
    {"the number of frames", kLong, "recording", [](Recording& r) { --r.statistics[1].frames; }},
    {"the contacts of bodies", kLong, "recording", [](Recording& r) { ++r.statistics[1].body_contacts; }},
    {"the contacts with faces", kLong, "recording", [](Recording& r) { ++r.statistics[1].face_contacts; }},
    {"the mean depth", kLong, "recording", [](Recording& r) { r.statistics[1].mean_depth_m *= 1.0 + 1e-12; }},
    {"the largest depth", kLong, "recording", [](Recording& r) { r.statistics[1].largest_depth_m *= 1.0 + 1e-12; }},
    {"the share above the slop", kLong, "recording", [](Recording& r) { r.statistics[1].share_above_slop += 1e-12; }},
    {"a mean that is no number", kLong, "recording", [](Recording& r) { r.statistics[1].mean_depth_m = NAN; }},
    {"a depth where there was no contact", "two-body:apart", "recording",
     [](Recording& r) { r.statistics[0].largest_depth_m = 0.0; }},
    {"a contact that the statistics did not see", kLong, "recording",
     [](Recording& r) { middle(r).contacts.push_back(middle(r).contacts.front()); }},
};

TEST(Corruptions, OfStatisticsAndProvenance) {
  expect_rejected(kStatistics);
}

// Traces of a broad phase or a narrow phase have digests of the pairs that it found.
TEST(FrameDigest, IsThatOfThePairsWhereNothingMoves) {
  Recording r = sound_run(kScene);
  r.header.groups = core::bit(core::Group::kDetection) | core::bit(core::Group::kPairs);
  for (FrameRecord& frame : r.frames) {
    frame.digest = core::pair_digest(frame.pairs);
    frame.position.clear();
    frame.contacts.clear();
  }
  EXPECT_EQ(verdict_of("frame-digest", r).outcome, core::Outcome::kPass);
  for (FrameRecord& frame : r.frames)
    if (!frame.pairs.empty()) ++frame.pairs.front().j;
  EXPECT_EQ(verdict_of("frame-digest", r).outcome, core::Outcome::kFail);
}

TEST(FrameDigest, OfItsOwnIsNotJudgedAndNoneIsZero) {
  Recording r = sound_run(kScene);
  r.header.notes["digest"] = "crc of the states";
  EXPECT_EQ(verdict_of("frame-digest", r).outcome, core::Outcome::kNotApplicable);
  r.header.notes["digest"] = "none";
  EXPECT_EQ(verdict_of("frame-digest", r).outcome, core::Outcome::kFail);
  for (FrameRecord& frame : r.frames) frame.digest = 0;
  EXPECT_EQ(verdict_of("frame-digest", r).outcome, core::Outcome::kPass);
}

// A run that was cut off lacks the rows of its last windows; at any step where it ends, the rows of complete windows
// may be there.
TEST(Recording, MayEndAnywhereAndHaveWindows) {
  Recording r = sound_run(kLong);
  r.statistics.clear();
  std::erase_if(r.frames, [](const FrameRecord& f) { return f.step % 5 != 0 && f.step != 249; });
  cut_after(r, 249);
  r.header.every = 5;
  EXPECT_EQ(verdict_of("recording", r).outcome, core::Outcome::kPass) << line(verdict_of("recording", r));
  std::erase_if(r.frames, [](const FrameRecord& f) { return f.step > 50 && f.step < 100; });
  EXPECT_EQ(verdict_of("recording", r).outcome, core::Outcome::kFail);
  r.header.notes["windows of steps"] = "1:50,100:250";
  EXPECT_EQ(verdict_of("recording", r).outcome, core::Outcome::kPass) << line(verdict_of("recording", r));
  std::erase_if(r.frames, [](const FrameRecord& f) { return f.step > 200 && f.step < 249; });
  EXPECT_EQ(verdict_of("recording", r).outcome, core::Outcome::kFail);
  r.header.notes["windows of steps"] = "1:50,100:200";
  EXPECT_EQ(verdict_of("recording", r).outcome, core::Outcome::kPass) << line(verdict_of("recording", r));
  std::erase_if(r.frames, [](const FrameRecord& f) { return f.step == 20; });
  EXPECT_EQ(verdict_of("recording", r).outcome, core::Outcome::kFail);
}

}  // namespace
}  // namespace broadside::tests
