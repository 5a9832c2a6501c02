// Measuring cells: a finished cell is a file, a second call reuses it, and a cell that cannot run says why.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bench/paper/cell_files.hpp"
#include "bench/paper/measure_group.hpp"
#include "bench/paper/memory_in_use.hpp"
#include "bench/paper/paper_scene.hpp"
#include "core/rows.hpp"
#include "core/scene/shapes.hpp"
#include "tests/datasets/temporary_folder.hpp"

namespace broadside::bench::paper {
namespace {

using tests::TemporaryFolder;

PaperCell cube_cell(const std::string& method, const std::string& engine) {
  PaperCell cell;
  cell.experiments = {"table5"};
  cell.model = "cube";
  cell.count = 8;
  cell.method = method;
  cell.scene = "freefall:cube:8";
  cell.engine = engine;
  cell.frames = 60;
  cell.every = 10;
  cell.id = method;
  cell.turns = "turns";
  return cell;
}

// Folders of finished cells.
std::size_t finished_in(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    count += entry.path().extension().empty() ? 1U : 0U;
  return count;
}

TEST(MeasureGroup, CellsAreJudgedTimedAndKept) {
  const TemporaryFolder folder;
  int steps = 0;
  MeasureOptions options{.folder = folder.path(), .runs = 2};
  options.progress = [&](double) { ++steps; };
  std::vector<PaperCell> cells{cube_cell("A", "octree-cpu[broad=brute,levels=A]"), cube_cell("hash", "hash-cpu")};
  cells[1].wants_memory = true;
  const auto first = measure_group(cells, options);
  ASSERT_TRUE(first.ok()) << first.error().line();
  ASSERT_EQ(first.value().size(), 2U);
  for (const PaperRow& row : first.value()) {
    EXPECT_EQ(row.absence, "");
    EXPECT_TRUE(row.is_admitted) << row.refusal;
    EXPECT_EQ(row.failed, 0U);
    EXPECT_GT(row.passed, 0U);
    EXPECT_GT(row.spent_s, 0.0);
    EXPECT_LT(row.spent_s, 300.0);
    EXPECT_EQ(row.judged, 6U) << "every tenth of 60 frames";
    ASSERT_EQ(row.runs.size(), 2U);
    EXPECT_EQ(row.runs[0].window_s.size(), row.window_count());
    EXPECT_GT(row.fps()[0], 0.0);
    EXPECT_FALSE(row.penetration.empty());
  }
  ASSERT_EQ(first.value()[1].memory_bytes.size(), 2U);
  EXPECT_GE(first.value()[1].memory_bytes[0], 0.0);
  EXPECT_EQ(first.value()[0].final_digest, first.value()[1].final_digest) << "C and A confirm the same pairs";
  EXPECT_EQ(finished_in(folder.path() / "cells"), 2U);
  for (const PaperCell& cell : cells) {
    const auto rows = core::read_rows(folder.path() / "cells" / cell.id);
    ASSERT_TRUE(rows.ok()) << rows.error().line();
    EXPECT_EQ(rows.value().cells.size(), 1U) << "as every campaign's cell has them";
    EXPECT_EQ(rows.value().verdicts.size(), 1U);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "work")) << "traces and runs of finished cells are gone";
  EXPECT_EQ(steps, 3 + 5);

  steps = 0;
  const auto second = measure_group(cells, options);
  ASSERT_TRUE(second.ok());
  EXPECT_EQ(steps, 0) << "nothing is measured twice";
  EXPECT_NEAR(second.value()[0].fps()[0], first.value()[0].fps()[0], 1e-5 * first.value()[0].fps()[0]);
}

TEST(MeasureGroup, OnlyWhatIsMissingIsMeasured) {
  const TemporaryFolder folder;
  int steps = 0;
  const MeasureOptions options{folder.path(), 1, false, false, [&](double) { ++steps; }};
  const std::vector<PaperCell> cells{cube_cell("B", "octree-cpu[broad=brute,levels=B]"), cube_cell("C", "octree-cpu")};
  ASSERT_TRUE(measure_group(std::span(cells).first(1), options).ok());
  // A damaged file counts as absent.
  std::ofstream(folder.path() / "cells/B/row.json") << "{";
  steps = 0;
  ASSERT_TRUE(measure_group(std::span(cells).first(1), options).ok());
  EXPECT_EQ(steps, 2);
  steps = 0;
  const auto both = measure_group(cells, options);
  ASSERT_TRUE(both.ok());
  EXPECT_EQ(steps, 2) << "recording and one run of the second cell";
  EXPECT_TRUE(both.value()[0].is_admitted && both.value()[1].is_admitted);
}

// Level 2 of Figure 4 is A of Table 5: one measurement under two names.
TEST(MeasureGroup, ACellThatTwoExperimentsShowIsMeasuredOnce) {
  const TemporaryFolder folder;
  int steps = 0;
  std::vector<PaperCell> cells(2, cube_cell("A", "octree-cpu[broad=brute,levels=A]"));
  cells[1].method = "level 2";
  cells[1].experiments = {"figure4"};
  const auto rows = measure_group(cells, {folder.path(), 2, false, false, [&](double) { ++steps; }});
  ASSERT_TRUE(rows.ok()) << rows.error().line();
  EXPECT_EQ(steps, 1 + 2);
  for (const PaperRow& row : rows.value()) EXPECT_EQ(row.runs.size(), 2U);
  EXPECT_EQ(rows.value()[1].method, "level 2");
  EXPECT_EQ(rows.value()[1].final_digest, rows.value()[0].final_digest);
  EXPECT_TRUE(rows.value()[1].is_admitted);
}

TEST(MeasureGroup, AWrongEngineIsStruckOut) {
  const TemporaryFolder folder;
  PaperCell cell = cube_cell("wrong", "octree-cpu[variant=printed-E4]");
  cell.scene = "errata:E4";
  cell.frames = 120;
  cell.every = 1;
  const auto rows = measure_group(std::vector<PaperCell>{cell}, {folder.path(), 1, false, false, {}});
  ASSERT_TRUE(rows.ok()) << rows.error().line();
  EXPECT_FALSE(rows.value()[0].is_admitted);
  EXPECT_GT(rows.value()[0].failed, 0U);
  EXPECT_NE(rows.value()[0].refusal.find("contraction"), std::string::npos) << rows.value()[0].refusal;
}

TEST(MeasureGroup, WhatCannotRunSaysWhy) {
  const TemporaryFolder folder;
  PaperCell left_out = cube_cell("A", "octree-cpu");
  left_out.left_out = "left out: too long";
  const auto rows = measure_group(std::vector<PaperCell>{left_out}, {folder.path(), 1, false, false, {}});
  ASSERT_TRUE(rows.ok());
  EXPECT_EQ(rows.value()[0].absence, "left out: too long");
  PaperCell no_scene = cube_cell("A", "octree-cpu");
  no_scene.scene = "freefall:unheard:8";
  const auto none = measure_group(std::vector<PaperCell>{no_scene}, {folder.path(), 1, false, false, {}});
  ASSERT_TRUE(none.ok());
  EXPECT_NE(none.value()[0].absence.find("unheard"), std::string::npos);
  EXPECT_EQ(finished_in(folder.path() / "cells"), 0U) << "an absence is not kept: the next call may find it";
  EXPECT_NE(CellFiles(folder.path()).row(no_scene).absence.find("unheard"), std::string::npos) << "and says why";
}

// A fall from rest over h takes the speed sqrt(2 g h).
TEST(PenetrationScene, StartsAtTheFloorWithTheSpeedOfTheFall) {
  PaperCell cell = cube_cell("octree", "octree-cpu");
  cell.beta = 0.6;
  cell.delta_m = 0.002;
  const auto plain = make_paper_scene(cube_cell("octree", "octree-cpu"), false);
  const auto scene = make_paper_scene(cell, false);
  ASSERT_TRUE(plain.ok() && scene.ok());
  EXPECT_FLOAT_EQ(scene.value().dt_s, 0.001F);
  EXPECT_FLOAT_EQ(scene.value().parameters.beta, 0.6F);
  EXPECT_FLOAT_EQ(scene.value().parameters.delta_m, 0.002F);
  float lowest = 1e9F;
  for (const core::Body& body : scene.value().bodies) lowest = std::min(lowest, body.position.y - 0.5F);
  EXPECT_NEAR(lowest, scene.value().domain.min.y, 2e-4);
  const float fallen = plain.value().bodies[0].position.y - scene.value().bodies[0].position.y;
  EXPECT_NEAR(scene.value().bodies[0].velocity.y, -std::sqrt(2.0F * 9.81F * fallen), 1e-5);
}

TEST(HeapBytes, CountWhatIsHeld) {
  if (heap_bytes() == 0) GTEST_SKIP() << "this allocator does not count";
  const std::uint64_t before = heap_bytes();
  const std::vector<char> held(10'000'000, 1);
  EXPECT_NEAR(static_cast<double>(heap_bytes() - before), 1e7, 1e5);
}

}  // namespace
}  // namespace broadside::bench::paper
