// Runs appended to a file come back as series, once each, and a file that is no history is refused.
#include "reports/history.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/reports/sample_rows.hpp"

namespace broadside::reports {
namespace {

class History : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(::testing::TempDir()) / ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    file_ = folder_ / "history.sqlite";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
  std::filesystem::path file_;
};

core::RunRows night(int number) {
  core::RunRows rows = testing_rows::sample_rows();
  rows.cells[0].counters["box tests"] = number < 6 ? 100 : 120;
  for (core::Sample& sample : rows.samples)
    for (core::StageSeries& series : sample.stages)
      for (double& s : series.seconds) s *= (number < 6 ? 1.0 : 1.3) * (1.0 + 0.001 * (number * 5 % 7));
  return rows;
}

const HistorySeries* find(const std::vector<HistorySeries>& all, const std::string& label, const std::string& metric) {
  for (const HistorySeries& s : all)
    if (s.label == label && s.metric == metric) return &s;
  return nullptr;
}

TEST_F(History, TwelveNightsWithAStepAreASeriesWithAChangePoint) {
  for (int n = 0; n < 12; ++n) {
    const auto appended = append_to_history(file_, night(n), "2026-11-" + std::to_string(10 + n) + "T02:00:00Z");
    ASSERT_TRUE(appended) << appended.error().line();
    EXPECT_TRUE(appended.value().is_new);
    EXPECT_EQ(appended.value().run, static_cast<std::uint64_t>(n + 1));
  }
  const auto all = read_history(file_);
  ASSERT_TRUE(all) << all.error().line();
  const HistorySeries* frame = find(all.value(), "octree-cpu", "median frame");
  ASSERT_NE(frame, nullptr);
  ASSERT_EQ(frame->points.size(), 12U);
  EXPECT_EQ(frame->unit, "s");
  EXPECT_EQ(frame->points[3].at, "2026-11-13T02:00:00Z");
  ASSERT_EQ(frame->changes.size(), 1U);
  EXPECT_EQ(frame->points[frame->changes[0].index].run, 7U);
  EXPECT_NEAR(frame->changes[0].after / frame->changes[0].before, 1.3, 1e-3);
  const HistorySeries* counter = find(all.value(), "octree-cpu", "counter box tests");
  ASSERT_NE(counter, nullptr);
  EXPECT_EQ(counter->changes.size(), 1U);
  // A time that is struck out is no part of any history.
  EXPECT_EQ(find(all.value(), "octree-cpu[variant=printed-E3]", "median frame"), nullptr);
  EXPECT_EQ(find(all.value(), "octree-cpu[variant=printed-E3]", "verdicts failed")->points[0].value, 2.0);
  const std::string text = history_text(all.value());
  EXPECT_NE(text.find("changed at run 7 (2026-11-16T02:00:00Z): 100 to 120 (+20 %), p 0"), std::string::npos) << text;
  EXPECT_EQ(history_json(all.value()), history_json(read_history(file_).value()));
}

TEST_F(History, TheSameRowsTwiceAreOneRun) {
  ASSERT_TRUE(append_to_history(file_, night(1), "a"));
  const auto again = append_to_history(file_, night(1), "b");
  ASSERT_TRUE(again);
  EXPECT_FALSE(again.value().is_new);
  EXPECT_EQ(again.value().run, 1U);
  EXPECT_EQ(find(read_history(file_).value(), "octree-cpu", "median frame")->points.size(), 1U);
}

TEST_F(History, OtherMachinesAndScenesAreOtherSeries) {
  ASSERT_TRUE(append_to_history(file_, night(1), "a"));
  core::RunRows other = night(2);
  for (core::Cell& c : other.cells) c.stamp.machine = "another";
  for (core::CellVerdicts& c : other.verdicts) c.stamp.machine = "another";
  for (core::Sample& s : other.samples) s.stamp.machine = "another";
  ASSERT_TRUE(append_to_history(file_, other, "b"));
  const auto all = read_history(file_);
  ASSERT_TRUE(all);
  for (const HistorySeries& s : all.value()) EXPECT_EQ(s.points.size(), 1U) << s.label << s.metric;
}

TEST_F(History, WhatIsNoHistoryIsRefusedAndLeftAlone) {
  EXPECT_NE(read_history(file_).error().line().find("no such file"), std::string::npos);
  EXPECT_FALSE(append_to_history(file_, {}, "a"));
  EXPECT_FALSE(std::filesystem::exists(file_)) << "nothing to remember makes no file";
  std::ofstream(file_)
      << "these are my notes, and they are longer than a header of a database would be, by far........";
  const auto refused = append_to_history(file_, night(1), "a");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().exit, core::Exit::kBadInput);
  EXPECT_EQ(read_history(folder_).ok(), false);
  EXPECT_FALSE(append_to_history(folder_ / "absent" / "h.sqlite", night(1), "a"));
}

}  // namespace
}  // namespace broadside::reports
