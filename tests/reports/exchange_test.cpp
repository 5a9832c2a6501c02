// Formats of other tools: every field that their readers need is there, and struck-out times are not.
#include "reports/exchange.hpp"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/reports/sample_rows.hpp"

namespace broadside::reports {
namespace {

// The fields that Google Benchmark's compare.py reads of each entry, and its grouping of repetitions by name.
TEST(Exchange, GoogleBenchmarkHasEachRunOfEachAdmittedTime) {
  const auto json = nlohmann::json::parse(google_benchmark_json(testing_rows::sample_rows()));
  EXPECT_TRUE(json.contains("context"));
  std::map<std::string, int> runs;
  for (const auto& b : json["benchmarks"]) {
    for (const char* field : {"name", "run_name", "run_type", "real_time", "cpu_time", "time_unit", "iterations",
                              "repetitions", "repetition_index"})
      EXPECT_TRUE(b.contains(field)) << field;
    EXPECT_EQ(b["run_type"], "iteration");
    EXPECT_EQ(b["repetition_index"], runs[b["name"]]++);
    EXPECT_EQ(b["name"].get<std::string>().find("printed-E3"), std::string::npos) << "struck out";
  }
  EXPECT_EQ(runs["freefall:bunny:50/octree-cpu/frame"], 5);
  EXPECT_EQ(runs["freefall:bunny:50/octree-cpu/broad"], 5);
  // Mean of the whole frame of the first run, ns: the sum of the stages' means times the 1 % that the rows add.
  const auto rows = testing_rows::sample_rows();
  double sum = 0.0;
  for (const double s : rows.samples[0].stages.back().seconds) sum += s;
  for (const auto& b : json["benchmarks"])
    if (b["name"] == "freefall:bunny:50/octree-cpu/frame" && b["repetition_index"] == 0) {
      EXPECT_NEAR(b["real_time"].get<double>(), 1e9 * sum / 300.0, 1.0);
    }
}

TEST(Exchange, SmallerIsBetterNamesValueUnitAndRange) {
  core::RunRows rows = testing_rows::sample_rows();
  rows.cells[0].counters["box tests"] = 123;
  const auto json = nlohmann::json::parse(smaller_is_better_json(rows));
  ASSERT_TRUE(json.is_array());
  std::set<std::string> names;
  for (const auto& one : json) {
    EXPECT_TRUE(one["value"].is_number());
    EXPECT_TRUE(one["unit"].is_string());
    EXPECT_TRUE(names.insert(one["name"]).second) << "names are unique";
  }
  EXPECT_TRUE(names.contains("freefall:bunny:50/octree-cpu/median frame"));
  EXPECT_TRUE(names.contains("freefall:bunny:50/octree-cpu/box tests"));
  EXPECT_FALSE(names.contains("freefall:bunny:50/octree-cpu[variant=printed-E3]/median frame"));
}

TEST(Exchange, CsvHasOneFigureALineAndMarksWhatDoesNotCount) {
  const std::string csv = figures_csv(testing_rows::sample_rows());
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "scene,engine,settings,machine,what,name,value,unit,runs,counts");
  EXPECT_NE(csv.find("time,frame median,"), std::string::npos);
  EXPECT_NE(csv.find("center-of-mass failed on this stamp"), std::string::npos);
  EXPECT_NE(csv.find("cell,state,crashed,"), std::string::npos);
}

}  // namespace
}  // namespace broadside::reports
