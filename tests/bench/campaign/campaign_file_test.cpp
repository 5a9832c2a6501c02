#include "bench/campaign/campaign_file.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "bench/campaign/job.hpp"
#include "bench/campaign/manifest.hpp"
#include "bench/campaign/run_cells.hpp"
#include "bench/campaign/schedulers.hpp"
#include "bench/paper/paper_job.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside {
namespace {

using bench::campaign::CampaignFile;
using bench::campaign::Manifest;
using bench::campaign::Selection;

core::Result<CampaignFile> read(const std::string& text) {
  const tests::ScratchFolder folder;
  std::ofstream(folder / "c.toml") << text;
  return bench::campaign::read_campaign_file(folder / "c.toml");
}

std::string refusal(const std::string& text) {
  const auto campaign = read(text);
  return campaign.ok() ? "accepted" : campaign.error().line();
}

constexpr const char* kSmall = R"(
name = "small"
scenes = ["freefall:cube:{n}", "two-body:head-on"]
engines = ["octree-cpu", "hash-cpu[cell_mm={cell}]"]
frames = 7
repetitions = 2
stand_in = true
time_limit_s = 9.5
[vary]
n = [5, 9]
cell = [100, "200", 300]
)";

TEST(CampaignFile, IsEveryCombinationOnce) {
  const auto campaign = read(kSmall);
  ASSERT_TRUE(campaign.ok()) << campaign.error().line();
  EXPECT_EQ(campaign.value().name, "small");
  std::set<std::string> cells;
  for (const auto& work : campaign.value().cells) {
    cells.insert(work.scene + " " + work.engine);
    EXPECT_EQ(work.frames, 7U);
    EXPECT_EQ(work.repetitions, 2U);
    EXPECT_TRUE(work.stand_in);
    EXPECT_EQ(work.time_limit_s, 9.5);
  }
  // Scenes: one with 2 counts, and one that does not vary. Engines: one that does not vary, and one with 3 cells.
  EXPECT_EQ(cells.size(), 3U * 4U);
  EXPECT_EQ(campaign.value().cells.size(), cells.size());
  EXPECT_TRUE(cells.contains("freefall:cube:9 hash-cpu[cell_mm=200]"));
}

TEST(CampaignFile, RefusesWhatItCannotMean) {
  EXPECT_NE(refusal("name = \"a\"\nscenes = [\"x\"]\nengines = [\"y\"]\ncolour = 1").find("unknown key 'colour'"),
            std::string::npos);
  EXPECT_NE(refusal("name = \"a b\"\nscenes = [\"x\"]\nengines = [\"y\"]").find("name is not"), std::string::npos);
  EXPECT_NE(refusal("name = \"a\"\nengines = [\"y\"]").find("there is no scene"), std::string::npos);
  EXPECT_NE(refusal("name = \"a\"\nscenes = [\"x\"]").find("there is no engine"), std::string::npos);
  EXPECT_NE(refusal("name = \"a\"\nscenes = [3]\nengines = [\"y\"]").find("scenes contains a whole number"),
            std::string::npos);
  EXPECT_NE(refusal("name = \"a\"\nscenes = [\"x{n}\"]\nengines = [\"y\"]").find("{n} has no values"),
            std::string::npos);
  EXPECT_NE(refusal("name = \"a\"\nscenes = [\"x\"]\nengines = [\"y\"]\n[vary]\nn = [1]").find("used by no scene"),
            std::string::npos);
  EXPECT_NE(refusal("name = \"a\"\nscenes = [\"x{n}\"]\nengines = [\"y\"]\n[vary]\nn = []").find("not a list"),
            std::string::npos);
  EXPECT_NE(refusal("name = ").find("c.toml:1"), std::string::npos);
}

TEST(Manifest, IdsAreOfTheWorkAndSurviveTheFile) {
  const auto campaign = read(kSmall);
  ASSERT_TRUE(campaign.ok());
  const auto manifest = bench::campaign::make_manifest(campaign.value());
  ASSERT_TRUE(manifest.ok()) << manifest.error().line();
  std::set<std::string> ids;
  for (const auto& cell : manifest.value().cells) ids.insert(cell.id);
  EXPECT_EQ(ids.size(), 12U);

  const tests::ScratchFolder folder;
  ASSERT_TRUE(bench::campaign::write_manifest(folder / ".", manifest.value()).ok());
  const auto again = bench::campaign::read_manifest(folder / ".");
  ASSERT_TRUE(again.ok()) << again.error().line();
  EXPECT_EQ(again.value().build, manifest.value().build);
  ASSERT_EQ(again.value().cells.size(), 12U);
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(again.value().cells[k].id, manifest.value().cells[k].id);
    EXPECT_EQ(again.value().cells[k].work, manifest.value().cells[k].work);
  }
  // Two spellings of one engine are one cell.
  const auto twice =
      read("name = \"a\"\nscenes = [\"freefall:cube:5\"]\nengines = [\"octree-cpu\", \"octree-cpu[levels=C]\"]");
  EXPECT_EQ(bench::campaign::make_manifest(twice.value()).value().cells.size(), 1U);
}

TEST(Manifest, AnEngineOrSettingThatIsNotThereIsFoundWhenPlanning) {
  const auto refused = [](const std::string& scene, const std::string& engine, const std::string& rest = "") {
    const auto campaign = read("name = \"a\"\nscenes = [\"" + scene + "\"]\nengines = [\"" + engine + "\"]\n" + rest);
    const auto manifest = bench::campaign::make_manifest(campaign.value());
    return manifest.ok() ? std::string("accepted") : manifest.error().line();
  };
  EXPECT_EQ(refused("freefall:cube:5", "octree-cpu"), "accepted");
  EXPECT_NE(refused("freefall:cube:5", "octree-cup").find("octree-cup"), std::string::npos);
  EXPECT_NE(refused("freefall:cube:5", "octree-cpu[lev=A]").find("lev"), std::string::npos);
  EXPECT_NE(refused("freefal:cube:5", "octree-cpu").find("freefal"), std::string::npos);
  EXPECT_NE(refused("freefall:cube:5", "octree-cpu", "against = \"all-pears\"").find("all-pears"), std::string::npos);
}

TEST(Manifest, ADamagedOrLaterOneIsRefused) {
  const tests::ScratchFolder folder;
  const auto refused = [&](const std::string& text) {
    std::ofstream(folder / "manifest.json") << text;
    const auto manifest = bench::campaign::read_manifest(folder / ".");
    return manifest.ok() ? std::string("accepted") : manifest.error().line();
  };
  EXPECT_NE(bench::campaign::read_manifest(folder / ".").error().line().find("no manifest"), std::string::npos);
  EXPECT_NE(refused("{").find("damaged"), std::string::npos);
  EXPECT_NE(refused(R"({"format": "other"})").find("no campaign's manifest"), std::string::npos);
  EXPECT_NE(refused(R"({"format": "broadside-campaign", "version": 99})").find("version 99"), std::string::npos);
  EXPECT_NE(refused(R"({"format": "broadside-campaign", "version": 2, "name": "a", "build": "b", "cells": [{"id":
    "../../x", "scene": "s", "engine": "e", "frames": 1, "repetitions": 0, "processes": 1, "against": "",
    "stand_in": false, "time_limit_s": 1, "needs_gpu": false, "turns": "0000000000000001"}]})")
                .find("no valid id"),
            std::string::npos);
}

// A manifest may come from a stranger: with "frames": -5 a cell ran four thousand million frames.
TEST(Manifest, NumbersThatNoCampaignFileCouldAskForAreRefused) {
  const tests::ScratchFolder folder;
  const std::string cell =
      R"({"id": "0000000000000001", "scene": "s", "engine": "e", "frames": 1, "repetitions": 0, "processes": 1,
    "against": "", "stand_in": false, "time_limit_s": 1, "needs_gpu": false, "turns": "0000000000000001"})";
  const auto read_cells = [&](const std::string& cells, const std::string& more = "") {
    std::ofstream(folder / "manifest.json")
        << R"({"format": "broadside-campaign", "version": 2, "name": "a", "build": "b", "cells": [)" << cells << "]"
        << more << "}";
    const auto manifest = bench::campaign::read_manifest(folder / ".");
    return manifest.ok() ? std::string("accepted") : manifest.error().line();
  };
  const auto with = [&](const std::string& key, const std::string& value) {
    std::string text = cell;
    const std::size_t at = text.find("\"" + key + "\": ") + key.size() + 4;
    text.replace(at, text.find_first_of(",}", at) - at, value);
    return read_cells(text);
  };
  ASSERT_EQ(read_cells(cell), "accepted");
  EXPECT_EQ(with("frames", "0"), "accepted") << "the scene's own";
  for (const char* key : {"frames", "repetitions", "processes"})
    for (const char* value : {"-5", "1e30", "1.5", "4294967297", "\"7\"", "null", "[1]"}) {
      const std::string line = with(key, value);
      EXPECT_NE(line.find(std::string("cell 0: ") + key + " is "), std::string::npos) << line;
    }
  EXPECT_NE(with("processes", "0").find("cell 0: processes is 0"), std::string::npos);
  for (const char* value : {"-1", "0", "1e30", "\"1\""})
    EXPECT_NE(with("time_limit_s", value).find("cell 0: time_limit_s is "), std::string::npos) << value;
  EXPECT_NE(read_cells(cell + "," + cell).find("cell 1 has the id of an earlier one"), std::string::npos);
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  EXPECT_NE(read_cells(cell, ", \"paper\": " + deep).find("nests more than 16 levels"), std::string::npos);
  EXPECT_NE(read_cells(cell, R"(, "paper": {"experiments": ["table5"], "models": [], "counts": [-5], "frames": 3})")
                .find("counts is -5"),
            std::string::npos);
  EXPECT_NE(read_cells(cell, R"(, "paper": {"experiments": ["table5"], "models": [], "counts": [], "frames": -3})")
                .find("frames is -3"),
            std::string::npos);
}

constexpr const char* kPaper = R"(
name = "paper"
paper = ["table5", "figure4", "tableA1"]
engine = "octree-cpu"
frames = 30
repetitions = 2
stand_in = true
[vary]
models = ["dragon"]
counts = [4]
)";

// The cells of a scene take turns, and one id stands for them; level 2 of Figure 4 is A of Table 5.
TEST(Manifest, ThePapersExperimentsAreGroupsThatSurviveTheFile) {
  const auto campaign = read(kPaper);
  ASSERT_TRUE(campaign.ok()) << campaign.error().line();
  const auto manifest = bench::campaign::make_manifest(campaign.value());
  ASSERT_TRUE(manifest.ok()) << manifest.error().line();
  const auto groups = bench::campaign::groups_of(manifest.value());
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].size(), 5U) << "A, B, C, level 1 and level 2 of random move";
  EXPECT_EQ(groups[1].size(), 2U) << "hash and octree of free fall";
  EXPECT_EQ(groups[0][0].id, groups[0][4].id);
  std::set<std::string> ids;
  for (const auto& cell : manifest.value().cells) ids.insert(cell.id);
  EXPECT_EQ(ids.size(), 6U);
  for (const auto& scheduler : bench::campaign::schedulers()) {
    const std::string text = scheduler.text(manifest.value(), "/shared", "/opt/broadside");
    for (const auto& cell : manifest.value().cells) {
      const bool is_first = cell.id == groups[0][0].id || cell.id == groups[1][0].id;
      EXPECT_EQ(text.find(cell.id) != std::string::npos, is_first) << scheduler.name;
    }
  }

  const tests::ScratchFolder folder;
  ASSERT_TRUE(bench::campaign::write_manifest(folder / ".", manifest.value()).ok());
  const auto again = bench::campaign::read_manifest(folder / ".");
  ASSERT_TRUE(again.ok()) << again.error().line();
  ASSERT_EQ(again.value().cells.size(), 7U);
  for (std::size_t k = 0; k < 7; ++k) EXPECT_EQ(again.value().cells[k].id, manifest.value().cells[k].id);
  ASSERT_NE(again.value().job, nullptr);
  EXPECT_EQ(again.value().job->text(), manifest.value().job->text());
  const auto request = bench::paper::request_from(again.value().job->text());
  ASSERT_TRUE(request.ok()) << request.error().line();
  const auto cells = bench::paper::planned_cells(request.value(), again.value().cells);
  ASSERT_TRUE(cells.ok()) << cells.error().line();
  EXPECT_EQ(cells.value()[4].id, manifest.value().cells[4].id);
  EXPECT_EQ(cells.value()[4].method, "level 2");
}

TEST(CampaignFile, RefusesWhatThePaperDoesNotVary) {
  const std::string start = "name = \"p\"\nengine = \"octree-cpu\"\npaper = [\"table5\"]\n";
  EXPECT_EQ(refusal(start), "accepted");
  EXPECT_NE(refusal(start + "scenes = [\"x\"]").find("unknown key 'scenes'"), std::string::npos);
  EXPECT_NE(refusal(start + "[vary]\nn = [1]").find("not a value that the paper varies"), std::string::npos);
  EXPECT_NE(refusal(start + "[vary]\ncounts = [\"many\"]").find("not a whole number"), std::string::npos);
  const auto unknown = read("name = \"p\"\nengine = \"octree-cpu\"\npaper = [\"table55\"]\n");
  const auto manifest = bench::campaign::make_manifest(unknown.value());
  ASSERT_FALSE(manifest.ok());
  EXPECT_NE(manifest.error().line().find("table5"), std::string::npos);
}

TEST(Selection, SharesAreDisjointAndWhole) {
  std::vector<int> times(10, 0);
  for (const char* text : {"1/3", "2/3", "3/3"}) {
    const auto selection = Selection::of_shard(text);
    ASSERT_TRUE(selection.ok());
    for (std::size_t place = 0; place < times.size(); ++place) times[place] += selection.value().includes(place, {});
  }
  EXPECT_EQ(times, std::vector<int>(10, 1));
  for (const char* text : {"", "1", "0/3", "4/3", "1/0", "a/b", "1/2/3", "-1/2"})
    EXPECT_FALSE(Selection::of_shard(text).ok()) << text;
}

TEST(Schedulers, EveryCellStandsInEveryFileOnce) {
  const auto manifest = bench::campaign::make_manifest(read(kSmall).value());
  for (const auto& scheduler : bench::campaign::schedulers()) {
    const std::string text = scheduler.text(manifest.value(), "/shared/it's here", "/opt/broadside");
    for (const auto& cell : manifest.value().cells) {
      const auto at = text.find(cell.id);
      ASSERT_NE(at, std::string::npos) << scheduler.name;
      EXPECT_EQ(text.find(cell.id, at + 1), std::string::npos) << scheduler.name;
    }
  }
}

TEST(Schedulers, TimedCellsGetWholeNodesAndGpuCellsAGpu) {
  Manifest manifest{"m", "b", {}, {}};
  manifest.cells.push_back({.id = "0000000000000001", .work = {}, .needs_gpu = false, .turns = "1"});
  manifest.cells.push_back({.id = "0000000000000002",
                            .work = {.scene = "", .engine = "", .repetitions = 3},
                            .needs_gpu = true,
                            .turns = "2"});
  const std::string text = bench::campaign::schedulers()[0].text(manifest, "/d", "/p");
  EXPECT_NE(text.find("submit checked '' \"$@\" <<'IDS'\n0000000000000001\n"), std::string::npos) << text;
  EXPECT_NE(text.find("submit timed_gpu '--exclusive --gres=gpu:1' \"$@\" <<'IDS'\n0000000000000002\n"),
            std::string::npos);
}

}  // namespace
}  // namespace broadside
