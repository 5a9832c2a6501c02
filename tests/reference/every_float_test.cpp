// Whatever finite floats the boxes are made of, signed zeros, subnormals and the largest ones among them, every exact
// broad phase of this tree finds exactly the pairs that trying all finds. A set of 9000 has more boxes than one bucket
// of the fast octree holds, so that buckets are split on such floats too.
#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "reference/engines.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::tests {
namespace {

struct EveryFloatSubject {
  std::string name;
  core::EngineRow (*row)();
  std::map<std::string, std::string> settings;
};

void PrintTo(const EveryFloatSubject& subject, std::ostream* out) {
  *out << subject.name;
}

class EveryFloat : public testing::TestWithParam<EveryFloatSubject> {
 protected:
  void SetUp() override {
    const core::EngineRow row = GetParam().row();
    auto settings = core::Settings::parse(row.id, row.settings, GetParam().settings);
    ASSERT_TRUE(settings.ok());
    auto made = row.create(settings.value());
    ASSERT_TRUE(made.ok());
    engine_ = std::move(made).value();
  }

  std::vector<core::Pair> pairs_of(const BoxCase& c) {
    core::BroadPhase& broad = *engine_.broad_phase;
    EXPECT_TRUE(broad.load(c.boxes, c.is_static).ok());
    EXPECT_TRUE(broad.update(c.boxes).ok());
    EXPECT_TRUE(broad.find().ok());
    auto set = broad.read_back();
    EXPECT_TRUE(set.ok());
    return std::move(set.value().pairs);
  }

 private:
  core::Engine engine_;
};

TEST_P(EveryFloat, GivesExactlyTheOverlappingPairs) {
  for (const BoxFamily& family : kBoxFamilies)
    for (const std::uint32_t count : {1U, 9U, 300U})
      for (std::uint64_t seed = 1; seed <= 3; ++seed)
        ASSERT_EQ(disagreement(make_case(family, count, seed), [&](const BoxCase& c) { return pairs_of(c); }), "")
            << family.name << ", seed " << seed;
}

TEST_P(EveryFloat, GivesThemOfMoreBoxesThanABucketHoldsSlow) {
  for (const BoxFamily& family : kBoxFamilies) {
    // Nearly all pairs overlap in these families: forty million of them.
    if (family.name == "signed zeros and subnormals" || family.name == "at the ends of floats") continue;
    const BoxCase c = make_case(family, 9000, 4);
    const std::vector<core::Pair> expected = every_pair(c);
    EXPECT_TRUE(pairs_of(c) == expected) << family.name << ": not the " << expected.size() << " pairs";
  }
}

INSTANTIATE_TEST_SUITE_P(Ours, EveryFloat,
                         testing::Values(EveryFloatSubject{"all_pairs", reference::all_pairs_row, {}},
                                         EveryFloatSubject{"hash_cpu", reference::hash_cpu_row, {}},
                                         EveryFloatSubject{"octree_cpu", reference::octree_cpu_row, {}},
                                         EveryFloatSubject{
                                             "octree_cpu_published", reference::octree_cpu_row, {{"broad", "octree"}}}),
                         [](const auto& subject) { return subject.param.name; });

}  // namespace
}  // namespace broadside::tests
