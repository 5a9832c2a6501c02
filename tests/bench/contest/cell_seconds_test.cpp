#include "bench/contest/cell_seconds.hpp"

#include <gtest/gtest.h>

namespace broadside::bench::contest {
namespace {

CellSeconds known() {
  return CellSeconds::parse("# A machine; 2 cells at a time\n4\ta\tone\n8\ta\ttwo\n60\tb[x=1,y=2]\tone\n", "here")
      .value();
}

campaign::Manifest manifest() {
  campaign::Manifest m;
  for (const auto& [scene, engine] :
       {std::pair("a", "one"), std::pair("a", "three"), std::pair("b[x=1,y=2]", "one"), std::pair("c", "one")}) {
    campaign::ManifestCell cell;
    cell.id = std::string(scene) + engine;
    cell.work.scene = scene;
    cell.work.engine = engine;
    m.cells.push_back(cell);
  }
  return m;
}

// A cell that was not measured is expected to take the mean of its scene, or else the mean of all scenes.
TEST(CellSeconds, UnknownCellsCountAsTheMeanOfTheirScene) {
  EXPECT_DOUBLE_EQ(known().expected("a", "two"), 8.0);
  EXPECT_DOUBLE_EQ(known().expected("a", "three"), 6.0);
  EXPECT_DOUBLE_EQ(known().expected("c", "one"), 24.0);
  EXPECT_DOUBLE_EQ(CellSeconds().expected("a", "one"), 0.0);
  CellSeconds again = known();
  again.set("a", "two", 2.0);
  EXPECT_DOUBLE_EQ(again.expected("a", "three"), 3.0);
}

TEST(CellSeconds, ThePlanSumsAndNamesTheDearest) {
  const std::string text = plan_text(known(), manifest(), 2);
  EXPECT_NE(text.find("4 cells, 94 s of work: about 1 min with --jobs 2"), std::string::npos) << text;
  EXPECT_NE(text.find("A machine; 2 cells at a time"), std::string::npos);
  EXPECT_NE(text.find("2 cells have no known seconds"), std::string::npos);
  EXPECT_LT(text.find("60.0 s  b[x=1,y=2]"), text.find("24.0 s  c"));
}

TEST(CellSeconds, ASumThatIsMostlyGuessedIsNoEstimate) {
  CellSeconds few;
  few.set("a", "one", 4.0);
  EXPECT_NE(plan_text(few, manifest(), 2).find("4 cells, and seconds of 1 of them are known: too few"),
            std::string::npos);
}

// A machine that takes twice as long for what it finished takes twice as long for what is left.
TEST(CellSeconds, TheForecastGoesAtThePaceOfWhatIsFinished) {
  const CellSeconds of = known();
  const campaign::Manifest m = manifest();
  Forecast forecast(of, m, "no/such/folder");
  EXPECT_DOUBLE_EQ(forecast.left_s(1), 94.0);
  forecast.finish(m.cells[0].work, 8.0);
  EXPECT_DOUBLE_EQ(forecast.left_s(1), 180.0);
  EXPECT_DOUBLE_EQ(forecast.left_s(2), 90.0);
}

TEST(CellSeconds, WhatIsWrittenIsRead) {
  const std::string folder = testing::TempDir();
  ASSERT_TRUE(known().write(folder, "Another one").ok());
  const auto read = CellSeconds::read(folder);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read.value().origin(), "Another one");
  EXPECT_DOUBLE_EQ(read.value().expected("b[x=1,y=2]", "one"), 60.0);
  EXPECT_TRUE(CellSeconds::read(folder + "no/such").ok());
}

TEST(CellSeconds, ALineThatIsNoneIsNamed) {
  for (const char* text : {"4\ta\n", "x\ta\tone\n", "-1\ta\tone\n", "4 a one\n", "nan\ta\tone\n"}) {
    const auto read = CellSeconds::parse(std::string("1\ta\tone\n") + text, "file.tsv");
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_NE(read.error().what.find("line 2"), std::string::npos);
  }
}

// The program has kept times for the whole default contest.
TEST(CellSeconds, SecondsAreKept) {
  EXPECT_GT(CellSeconds::kept().expected("rigid:bounce", "plain-rigid"), 0.0);
}

}  // namespace
}  // namespace broadside::bench::contest
