// Engines from shared libraries: sound ones give what all-pairs gives, wrong ones give an error or a wrong answer, and
// those that break the rules of memory crash. What the harness does about a crash is tested in tests/bench/plugins.
#include "reference/plugin/plugin_engine.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "datasets/box_streams/box_sets.hpp"
#include "reference/engines.hpp"

namespace broadside {
namespace {

const std::string kPluginFolder = BROADSIDE_PLUGIN_DIR;

core::Result<core::Engine> plugin_engine(const std::string& name, std::map<std::string, std::string> given = {}) {
  const std::string file = kPluginFolder + "/" + name;
  const auto description = reference::describe_plugin(file);
  if (!description) return description.error();
  static std::vector<std::string> kept;
  kept.reserve(64);
  std::vector<core::SettingRow> rows;
  for (const auto& setting : description.value().settings) {
    kept.push_back(std::to_string(setting.default_value));
    rows.push_back({setting.key, kept.back(), {}, setting.what});
  }
  auto settings = core::Settings::parse(description.value().id, rows, given);
  if (!settings) return settings.error();
  return reference::create_plugin_engine(file, settings.value(), core::make_host_space());
}

core::Result<core::PairSet> pairs_of_plugin(core::Engine& engine, const std::vector<core::Box>& boxes) {
  const std::vector<std::uint8_t> is_static(boxes.size(), 0);
  if (core::Status s = engine.broad_phase->load(boxes, is_static); !s) return s.error();
  if (core::Status s = engine.broad_phase->update(boxes); !s) return s.error();
  if (core::Status s = engine.broad_phase->find(); !s) return s.error();
  return engine.broad_phase->read_back();
}

std::vector<core::Pair> all_pairs(const std::vector<core::Box>& boxes) {
  const core::EngineRow row = reference::all_pairs_row();
  auto engine = row.create(core::Settings::parse(row.id, row.settings, {}).value());
  return pairs_of_plugin(engine.value(), boxes).value().pairs;
}

// So many pairs that the first buffer for them is too small.
const std::vector<core::Box>& boxes() {
  static const std::vector<core::Box> made = datasets::uniform_boxes(2000, 5);
  return made;
}

std::string pairs_outcome(int fault) {
  auto engine = plugin_engine("libwrong_engine.so", {{"fault", std::to_string(fault)}});
  if (!engine) return engine.error().line();
  const auto pairs = pairs_of_plugin(engine.value(), boxes());
  if (!pairs) return pairs.error().line();
  if (pairs.value().demanded != pairs.value().pairs.size()) return "demanded more than stored";
  return pairs.value().pairs == all_pairs(boxes()) ? "sound" : "other pairs";
}

TEST(PluginEngine, DescribesItself) {
  const auto description = reference::describe_plugin(kPluginFolder + "/libwrong_engine.so");
  ASSERT_TRUE(description.ok()) << description.error().line();
  EXPECT_EQ(description.value().id, "wrong-engine");
  EXPECT_EQ(description.value().capabilities, "broad");
  ASSERT_EQ(description.value().settings.size(), 1U);
  EXPECT_EQ(description.value().settings[0].key, "fault");
  EXPECT_FALSE(description.value().on_device);
}

TEST(PluginEngine, TheExampleInCIsExact) {
  auto engine = plugin_engine("libsweep.so");
  ASSERT_TRUE(engine.ok()) << engine.error().line();
  for (const std::uint32_t n : {0U, 1U, 2U, 77U, 2000U}) {
    const std::vector<core::Box> some = datasets::mixed_boxes(n, 9);
    const auto pairs = pairs_of_plugin(engine.value(), some);
    ASSERT_TRUE(pairs.ok()) << pairs.error().line();
    EXPECT_EQ(pairs.value().pairs, all_pairs(some)) << n;
  }
}

TEST(PluginEngine, TwoStaticBoxesAreNoPair) {
  auto engine = plugin_engine("libsweep.so");
  ASSERT_TRUE(engine.ok());
  const std::vector<core::Box> same(3, core::Box{{0, 0, 0}, {1, 1, 1}});
  ASSERT_TRUE(engine.value().broad_phase->load(same, std::vector<std::uint8_t>{1, 0, 1}).ok());
  ASSERT_TRUE(engine.value().broad_phase->find().ok());
  const std::vector<core::Pair> expected{{0, 1}, {1, 2}};
  EXPECT_EQ(engine.value().broad_phase->read_back().value().pairs, expected);
}

TEST(PluginEngine, AWrongAnswerIsPassedOnOrNamed) {
  EXPECT_EQ(pairs_outcome(0), "sound");
  EXPECT_EQ(pairs_outcome(3).substr(0, 37), "wrong-engine: read_pairs: pair number") << pairs_outcome(3);
  EXPECT_NE(pairs_outcome(4).find("a pair has i < j < 2000"), std::string::npos) << pairs_outcome(4);
  EXPECT_NE(pairs_outcome(5).find("a pair has i < j < 2000"), std::string::npos) << pairs_outcome(5);
  EXPECT_NE(pairs_outcome(6).find("did not write number"), std::string::npos) << pairs_outcome(6);
  EXPECT_EQ(pairs_outcome(9), "other pairs");
  EXPECT_EQ(pairs_outcome(10), "other pairs");
  EXPECT_NE(pairs_outcome(11).find("claims to have 4611686018427387904 pairs"), std::string::npos) << pairs_outcome(11);
  EXPECT_EQ(pairs_outcome(12), "wrong-engine: find_pairs: the moon is full");
  EXPECT_NE(pairs_outcome(13).find("failed without a message"), std::string::npos) << pairs_outcome(13);
  EXPECT_EQ(pairs_outcome(14), "demanded more than stored");
}

TEST(PluginEngineDeathTest, ForbiddenWritesEndTheProcess) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_DEATH(pairs_outcome(1), "");
  EXPECT_DEATH(pairs_outcome(7), "");
  EXPECT_DEATH(pairs_outcome(8), "");
}

TEST(PluginEngine, WhatIsNoEngineIsRefused) {
  const auto refused = [](const std::string& file) {
    const auto description = reference::describe_plugin(file);
    return description.ok() ? std::string("accepted") : description.error().line();
  };
  EXPECT_NE(refused(kPluginFolder + "/no_such.so").find("cannot load it"), std::string::npos);
  EXPECT_NE(refused(kPluginFolder + "/libempty_plugin.so").find("exports no broadside_engine_v1"), std::string::npos);
  EXPECT_NE(refused(kPluginFolder + "/liblater_plugin.so").find("version 2 of the engine interface"),
            std::string::npos);
  EXPECT_NE(refused(kPluginFolder + "/libhalf_plugin.so").find("only some functions of a broad phase"),
            std::string::npos);
}

}  // namespace
}  // namespace broadside
