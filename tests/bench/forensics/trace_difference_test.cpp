// Two trace files: where they first differ, or why they cannot be compared.
#include "bench/forensics/trace_difference.hpp"

#include <gtest/gtest.h>

#include "bench/forensics/difference_text.hpp"
#include "core/trace/trace_writer.hpp"
#include "tests/core/trace/random_frames.hpp"

namespace broadside::tests {
namespace {

using namespace core;
using bench::TraceDifference;

constexpr std::uint32_t kBodies = 4;

class Traces : public testing::Test {
 protected:
  // Each step with one contact of bodies 1 and 2 and one of body 3 and a face.
  static std::vector<FrameRecord> frames(std::uint64_t count) {
    std::vector<FrameRecord> list;
    for (std::uint64_t step = 1; step <= count; ++step) {
      FrameRecord f;
      f.step = step;
      f.time_s = static_cast<double>(step) / 64.0;
      f.digest = 1000 + step;
      f.position.assign(kBodies, {static_cast<float>(step), 0, 0});
      f.orientation.assign(kBodies, {});
      f.velocity.assign(kBodies, {1, 0, 0});
      f.angular_velocity.assign(kBodies, {});
      Contact pair;
      pair.a = 1;
      pair.b = 2;
      pair.depth_m = 0.25F;
      Contact floor;
      floor.a = 3;
      floor.b = kFirstFace + 2;
      floor.color = kFaceColor;
      f.contacts = {pair, floor};
      list.push_back(f);
    }
    return list;
  }

  TraceReader written(const std::string& name, const std::vector<FrameRecord>& list,
                      Scene scene = tetrahedra_scene(kBodies),
                      std::uint32_t groups = bit(Group::kBodies) | bit(Group::kContacts)) const {
    TraceHeader header = header_of(std::move(scene), groups);
    auto writer = TraceWriter::create(folder_ / name, header);
    EXPECT_TRUE(writer.ok());
    for (const FrameRecord& f : list) EXPECT_TRUE(writer.value().append(f).ok());
    EXPECT_TRUE(writer.value().finish().ok());
    auto reader = TraceReader::open(folder_ / name);
    EXPECT_TRUE(reader.ok()) << reader.error().line();
    return std::move(reader).value();
  }

  const Folder folder_;
};

TEST_F(Traces, AreTheSame) {
  const TraceReader a = written("a.h5", frames(20));
  const TraceReader b = written("b.h5", frames(20));
  const auto found = bench::compare_traces(a, b);
  ASSERT_TRUE(found.ok()) << found.error().line();
  EXPECT_TRUE(found.value().is_same());
  EXPECT_EQ(found.value().equal_steps, 20U);
}

TEST_F(Traces, PartAtTheEarliestStepWithTheHistoryOfItsBodies) {
  std::vector<FrameRecord> other = frames(20);
  other[14].position[2].x = std::nextafter(15.0F, 100.0F);
  other[14].digest = 1;
  other[17].position[0].y = 3.0F;
  other[17].digest = 2;
  other[14].contacts.clear();
  other[14].contacts = frames(15).back().contacts;
  const TraceReader a = written("a.h5", frames(20));
  const TraceReader b = written("b.h5", other);
  const auto found = bench::compare_traces(a, b);
  ASSERT_TRUE(found.ok()) << found.error().line();
  const TraceDifference& d = found.value();
  EXPECT_FALSE(d.is_same());
  EXPECT_EQ(d.step, 15U);
  EXPECT_EQ(d.equal_steps, 14U);
  EXPECT_EQ(d.other_digests, 2U);
  ASSERT_TRUE(d.first);
  EXPECT_EQ(d.first->field, "/trace/body/position");
  EXPECT_EQ(d.first->bodies[0], 2U);
  EXPECT_EQ(ulps_between(d.first->a, d.first->b), 1U);
  // The ten steps before, and the step itself from both traces; contacts of body 3 are not part of body 2's history.
  ASSERT_EQ(d.history.size(), 12U);
  EXPECT_EQ(d.history.front().step, 5U);
  for (const auto& h : d.history) EXPECT_EQ(h.contact.b, 2U);
  EXPECT_TRUE(d.history.back().is_of_b);
  const std::string text = bench::difference_text(a, b, d);
  EXPECT_NE(text.find("First difference: step 15, body 2, /trace/body/position.x\n  A  15\n  B  15.000001\n  1 ulp,"),
            std::string::npos)
      << text;
  const std::string json = bench::difference_json(a, b, d);
  EXPECT_NE(json.find("\"ulps\": 1"), std::string::npos) << json;
}

TEST_F(Traces, OfUnequalLengthDiffer) {
  const TraceReader a = written("a.h5", frames(20));
  Scene shorter = tetrahedra_scene(kBodies);
  shorter.frames = 12;  // another length does not make another scene
  const TraceReader b = written("b.h5", frames(12), shorter);
  const auto found = bench::compare_traces(a, b);
  ASSERT_TRUE(found.ok()) << found.error().line();
  EXPECT_FALSE(found.value().is_same());
  EXPECT_FALSE(found.value().first);
  EXPECT_EQ(found.value().only_in_a, 8U);
}

TEST_F(Traces, OfDifferentScenesAreNotCompared) {
  Scene other = tetrahedra_scene(kBodies);
  other.gravity_m_s2.z = -1.62F;
  const auto found = bench::compare_traces(written("a.h5", frames(3)), written("b.h5", frames(3), other));
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().exit, Exit::kBadInput);
  EXPECT_NE(found.error().line().find("different scenes"), std::string::npos);
}

TEST_F(Traces, WithoutACommonStepOrGroupAreNotCompared) {
  std::vector<FrameRecord> later = frames(6);
  later.erase(later.begin(), later.begin() + 3);
  EXPECT_FALSE(bench::compare_traces(written("a.h5", frames(3)), written("b.h5", later)).ok());
  const auto found =
      bench::compare_traces(written("c.h5", frames(3), tetrahedra_scene(kBodies), bit(Group::kBodies)),
                            written("d.h5", frames(3), tetrahedra_scene(kBodies), bit(Group::kContacts)));
  ASSERT_FALSE(found.ok());
  EXPECT_NE(found.error().line().find("nothing recorded"), std::string::npos) << found.error().line();
}

ContactPoint point_of(std::uint32_t a, std::uint32_t b, float impulse) {
  ContactPoint p;
  p.a = a;
  p.b = b;
  p.normal = {0, 1, 0};
  p.impulse = {0, impulse, 0};
  return p;
}

// Points of contact, with the history of their bodies.
TEST_F(Traces, OfPointsNameThePointAndShowItsHistory) {
  std::vector<FrameRecord> one = frames(12);
  for (FrameRecord& f : one)
    f.points = {point_of(1, 2, 0.5F), point_of(1, 2, 0.25F), point_of(3, kFirstFace + 2, 1.0F)};
  std::vector<FrameRecord> other = one;
  other[8].points[1].impulse.y = 0.75F;
  constexpr std::uint32_t kGroups = bit(Group::kBodies) | bit(Group::kPoints);
  const TraceReader a = written("a.h5", one, tetrahedra_scene(kBodies), kGroups);
  const TraceReader b = written("b.h5", other, tetrahedra_scene(kBodies), kGroups);
  const auto found = bench::compare_traces(a, b);
  ASSERT_TRUE(found.ok()) << found.error().line();
  const std::string text = bench::difference_text(a, b, found.value());
  EXPECT_NE(text.find("step 9, body 1 and body 2, /trace/point/impulse.y (point 1 of the step)"), std::string::npos)
      << text;
  EXPECT_NE(text.find("Points of body 1 and body 2 in the ten recorded steps before"), std::string::npos) << text;
  EXPECT_NE(text.find("step 8: body 1 on body 2"), std::string::npos) << text;
  EXPECT_NE(text.find("impulse 0 0.75 0 N s"), std::string::npos) << text;
  EXPECT_EQ(text.find("Contacts of"), std::string::npos) << text;
  EXPECT_NE(bench::difference_json(a, b, found.value()).find("\"points\""), std::string::npos);
}

TEST_F(Traces, APointMoreIsOfItsOwnTrace) {
  std::vector<FrameRecord> one = frames(3);
  for (FrameRecord& f : one) f.points = {point_of(1, 2, 0.5F), point_of(3, kFirstFace + 2, 1.0F)};
  std::vector<FrameRecord> other = one;
  other[1].points = {point_of(0, 1, 0.1F), point_of(1, 2, 0.5F), point_of(3, kFirstFace + 2, 1.0F)};
  std::vector<FrameRecord> moved = one;
  std::swap(moved[1].points[0], moved[1].points[1]);
  constexpr std::uint32_t kGroups = bit(Group::kBodies) | bit(Group::kPoints);
  const TraceReader a = written("a.h5", one, tetrahedra_scene(kBodies), kGroups);
  const auto kind_against = [&](const char* name, const std::vector<FrameRecord>& list) {
    const auto found = bench::compare_traces(a, written(name, list, tetrahedra_scene(kBodies), kGroups));
    EXPECT_TRUE(found.ok() && found.value().first.has_value());
    return found.value().first->kind;
  };
  EXPECT_EQ(kind_against("b.h5", other), DifferenceKind::kOnlyInB);
  EXPECT_EQ(kind_against("c.h5", moved), DifferenceKind::kOrder);
}

// A difference in declarations is no difference in what happened; float64 is compared with float32 after rounding to
// float32.
TEST_F(Traces, SayWhatIsDeclaredOtherwiseAndWhichStatesAreNarrowed) {
  TraceHeader header = header_of(tetrahedra_scene(kBodies), bit(Group::kBodies) | bit(Group::kWideBodies));
  header.declaration = Declaration::of({{"motion", "rigid"}, {"friction", "pyramid"}});
  std::vector<FrameRecord> wide = frames(4);
  auto writer = TraceWriter::create(folder_ / "w.h5", header);
  ASSERT_TRUE(writer.ok());
  for (FrameRecord& f : wide) {
    f.contacts.clear();
    for (std::uint32_t i = 0; i < kBodies; ++i) {
      f.wide.position.push_back({f.position[i].x, f.position[i].y, f.position[i].z});
      f.wide.orientation.push_back({1, 0, 0, 0});
      f.wide.velocity.push_back({1, 0, 0});
      f.wide.angular_velocity.push_back({});
    }
    ASSERT_TRUE(writer.value().append(f).ok());
  }
  ASSERT_TRUE(writer.value().finish().ok());
  auto a = TraceReader::open(folder_ / "w.h5");
  ASSERT_TRUE(a.ok());
  const TraceReader b = written("b.h5", frames(4));
  const auto found = bench::compare_traces(a.value(), b);
  ASSERT_TRUE(found.ok()) << found.error().line();
  EXPECT_TRUE(found.value().is_same());
  EXPECT_TRUE(found.value().is_narrowed);
  const std::string text = bench::difference_text(a.value(), b, found.value());
  EXPECT_NE(text.find("Declarations differ: motion: A rigid, B translate"), std::string::npos) << text;
  EXPECT_NE(text.find("Declarations differ: friction: A pyramid, B not declared"), std::string::npos) << text;
  EXPECT_NE(text.find("compared as float32"), std::string::npos) << text;
  const std::string json = bench::difference_json(a.value(), b, found.value());
  EXPECT_NE(json.find("\"declared_otherwise\""), std::string::npos) << json;
}

}  // namespace
}  // namespace broadside::tests
