// Estimates of a cell's time. They decide the order of a campaign and the time that it shows, and no result.
#include "bench/paper/cell_cost.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "bench/campaign/manifest.hpp"
#include "bench/campaign/run_cells.hpp"
#include "bench/paper/beyond_forecast.hpp"
#include "bench/paper/cell_files.hpp"
#include "bench/paper/paper_job.hpp"
#include "bench/paper/paper_plan.hpp"
#include "bench/paper/paper_row.hpp"
#include "tests/datasets/temporary_folder.hpp"

namespace broadside::bench::paper {
namespace {

const Device kCpu{"octree-cpu", "hash-cpu", "octree-cpu", ""};

TEST(CellCost, ThePapersTablesFitIntoHalfAnHourOnTwoCores) {
  PlanOptions options;
  options.frames = 300;
  options.runs = 2;
  const auto cells = plan_cells({"all"}, options, kCpu);
  ASSERT_TRUE(cells.ok());
  double seconds = 0.0;
  for (const PaperCell& cell : cells.value()) seconds += expected_seconds(cell, options.runs);
  EXPECT_GT(seconds, 120.0);
  EXPECT_LT(seconds, 1200.0) << "a third of the half hour is for machines that are slower";
}

TEST(CellCost, GrowsWithWhatIsDone) {
  PlanOptions options;
  const auto cells = plan_cells({"table5"}, options, kCpu);
  ASSERT_TRUE(cells.ok());
  PaperCell cell = cells.value().front();
  ASSERT_EQ(cell.method, "A");
  const double seconds = expected_seconds(cell, 5);
  EXPECT_GT(expected_seconds(cell, 6), seconds);
  PaperCell more = cell;
  more.frames *= 2;
  EXPECT_GT(expected_seconds(more, 5), 1.5 * seconds);
  for (const char* method : {"B", "C"}) {
    PaperCell other = cell;
    other.method = method;
    EXPECT_LT(expected_seconds(other, 5), seconds) << method;
  }
  PaperCell gpu = cell;
  gpu.engine = "octree-gpu[broad=brute,levels=A]";
  EXPECT_LT(expected_seconds(gpu, 5), 0.1 * seconds);
  cell.left_out = "left out";
  EXPECT_EQ(expected_seconds(cell, 5), 0.0);
}

TEST(CellCost, CountsBeyondThePaperRise) {
  const auto cells = plan_cells({"beyond"}, {}, kCpu);
  ASSERT_TRUE(cells.ok());
  const std::span<const PaperCell> all(cells.value());
  const auto few = std::find_if(all.begin(), all.end(), [](const PaperCell& c) { return c.count == 40; });
  const auto many = std::find_if(all.begin(), all.end(), [](const PaperCell& c) { return c.count == 30000; });
  ASSERT_NE(few, all.end());
  ASSERT_NE(many, all.end());
  const auto rank = [&](auto cell) { return rank_of(all.subspan(static_cast<std::size_t>(cell - all.begin()), 1), 5); };
  EXPECT_LT(rank(few), rank(many));
  PlanOptions options;
  options.frames = 1000000;
  const auto dearest = plan_cells({"table5"}, options, kCpu);
  EXPECT_LT(rank_of(dearest.value(), 5), rank(few)) << "the paper comes before what is beyond it";
}

// Times at three counts predict the fourth: 70 us for each pair of bodies are 70 s at 1000 bodies.
TEST(Forecast, ACellThatIsTooLongByWhatSmallerOnesTookIsLeftOutAndSaysWhy) {
  const tests::TemporaryFolder folder;
  const CellFiles files(folder.path());
  std::vector<PaperCell> cells;
  for (const std::uint32_t count : {10U, 30U, 100U, 1000U}) {
    PaperCell cell;
    cell.experiments = {"beyond"};
    cell.model = "bunny";
    cell.method = "A";
    cell.count = count;
    cell.frames = 20;
    cell.id = std::to_string(count);
    cells.push_back(cell);
    PaperRow row;
    row.frames = cell.frames;
    row.runs = {{.window_s = {1.0}, .stage_s = {{"frame", 1.0}}}};
    row.spent_s = 70e-6 * count * count;
    if (count < 1000) {
      ASSERT_TRUE(files.finish(cell.id, row, {}).ok());
    }
  }
  const std::string reason = why_too_long(cells.back(), cells, files, 60.0);
  EXPECT_NE(reason.find("would take 70 s by what 10 to 100 bodies took, more than the limit of 60 s"),
            std::string::npos)
      << reason;
  EXPECT_EQ(why_too_long(cells.back(), cells, files, 80.0), "");
  EXPECT_EQ(why_too_long(cells[2], cells, files, 0.0), "") << "two counts say nothing";
  cells.back().experiments = {"table5"};
  EXPECT_EQ(why_too_long(cells.back(), cells, files, 60.0), "");
}

TEST(CellCost, TheCheapestSceneComesFirst) {
  const tests::TemporaryFolder folder;
  PaperRequest request;
  request.experiments = {"table5"};
  request.plan.models = {"bunny"};
  request.plan.counts = {24, 6, 12};
  request.plan.frames = 20;
  request.plan.runs = 1;
  request.device = kCpu;
  request.allow_stand_in = true;
  const auto manifest = campaign::make_manifest({"paper", {}, paper_job(request)});
  ASSERT_TRUE(manifest.ok()) << manifest.error().line();
  ASSERT_TRUE(campaign::write_manifest(folder.path(), manifest.value()).ok());
  std::vector<std::string> order;
  const auto tally = campaign::run_cells(folder.path(), {}, [&](const campaign::GroupEnd& end) {
    EXPECT_EQ(manifest.value().cells[end.first].id, end.cells.front().id);
    order.push_back(end.cells.front().work.scene);
  });
  ASSERT_TRUE(tally.ok()) << tally.error().line();
  EXPECT_EQ(tally.value().done, 9U);
  EXPECT_EQ(order, (std::vector<std::string>{"randommove:bunny:6", "randommove:bunny:12", "randommove:bunny:24"}));
}

}  // namespace
}  // namespace broadside::bench::paper
