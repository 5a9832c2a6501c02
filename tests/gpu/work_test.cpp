// A GPU counts of its work what the host counts, and the same in every run.
#include <gtest/gtest.h>

#include <string>

#include "core/engine/engine.hpp"
#include "gpu/engines.hpp"
#include "gpu/engines_on_cuda.hpp"
#include "tests/gpu/work_counts.hpp"

namespace broadside::gpu {
namespace {

core::Engine engine_of(const WorkRow& row) {
  const core::EngineRow engine = row.broad == "hash" ? hash_gpu_row() : octree_gpu_row();
  std::map<std::string, std::string> given;
  if (row.broad != "hash") given["broad"] = row.broad;
  if (!row.levels.empty()) given["levels"] = row.levels;
  auto settings = core::Settings::parse(engine.id, engine.settings, given);
  EXPECT_TRUE(settings.ok());
  auto made = engine.create(settings.value());
  EXPECT_TRUE(made.ok());
  return std::move(made).value();
}

TEST(WorkOnDevice, IsThatOfTheHost) {
  if (const std::string why = gpu_absent(); !why.empty()) GTEST_SKIP() << "not run: " << why;
  for (int run = 0; run < 3; ++run) {
    for (const WorkRow& row : kWorkRows) {
      core::Engine subject = engine_of(row);
      expect_row(row, row.levels.empty() ? counts_of(*subject.broad_phase, counted_boxes())
                                         : counts_of(*subject.dynamics, counted_scene(), 3));
    }
  }
}

TEST(WorkOnDevice, OfManyBoxesIsThatOfTheHost) {
  if (const std::string why = gpu_absent(); !why.empty()) GTEST_SKIP() << "not run: " << why;
  for (int run = 0; run < 3; ++run) {
    core::Engine subject = engine_of({"tree", "", 0, 0, kNotCounted});
    const Counts counts = counts_of(*subject.broad_phase, bulk_counted_boxes());
    EXPECT_EQ(counts.at("broad: box tests"), kTestsOfMore);
    EXPECT_EQ(counts.at("broad: nodes visited"), kNodesOfMore);
  }
}

}  // namespace
}  // namespace broadside::gpu
