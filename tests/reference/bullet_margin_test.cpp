// Bullet's margin around moving leaves, seen from outside.
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "core/engine/engine.hpp"
#include "reference/engines.hpp"

namespace broadside {
namespace {

core::Box unit_box_at(float x) {
  return {{x, 0, 0}, {x + 1, 1, 1}};
}

// A leaf that moved by 5 mm is fattened by Bullet's 50 mm, so it meets a box 5 mm away that it does not overlap: raw
// and tight differ with the library's margin and agree without. The card says which it is.
TEST(BulletDbvt, ReportsItsMarginPairsApart) {
  const std::vector<std::uint8_t> moving(2, 0);
  const core::EngineRow row = reference::bullet_dbvt_row();
  for (const auto& [margin, raw] : {std::pair{"bullet", 1U}, std::pair{"0", 0U}}) {
    auto made = row.create(core::Settings::parse(row.id, row.settings, {{"margin", margin}}).value());
    ASSERT_TRUE(made.ok());
    const core::Engine& engine = made.value();
    ASSERT_TRUE(engine.broad_phase->load(std::vector{unit_box_at(0), unit_box_at(1.02F)}, moving).ok());
    // Boxes enter in the first timed call: only after it can a leaf move.
    ASSERT_TRUE(engine.broad_phase->find().ok());
    ASSERT_TRUE(engine.broad_phase->update(std::vector{unit_box_at(0.005F), unit_box_at(1.02F)}).ok());
    ASSERT_TRUE(engine.broad_phase->find().ok());
    const auto set = engine.broad_phase->read_back();
    ASSERT_TRUE(set.ok());
    EXPECT_EQ(set.value().raw, raw) << "margin " << margin;
    EXPECT_TRUE(set.value().pairs.empty());
    EXPECT_NEAR(engine.broad_phase->traits().margin_m, raw == 1 ? 0.05 : 0.0, 1e-8);
    EXPECT_EQ(engine.defects().at(0).hits, raw) << "a pair that does not overlap";
    bool differs = false;
    for (const core::EquivalenceFact& fact : engine.equivalence({}))
      differs = differs || (fact.property == "broad-phase margin" && fact.differs());
    EXPECT_EQ(differs, raw == 1);
  }
}

// The margin is a length: a leaf that moved meets a box 15 mm away with 20 mm of margin, and not with 10 mm.
TEST(BulletDbvt, TakesAnyMarginInMeters) {
  const std::vector<std::uint8_t> moving(2, 0);
  for (const core::EngineRow& row : {reference::bullet_dbvt_row(), reference::bullet_dbvt_tree_row()}) {
    for (const auto& [margin, raw] : {std::pair{"0.02", 1U}, std::pair{"0.01", 0U}}) {
      auto made = row.create(core::Settings::parse(row.id, row.settings, {{"margin", margin}}).value());
      ASSERT_TRUE(made.ok());
      core::BroadPhase& broad = *made.value().broad_phase;
      ASSERT_TRUE(broad.load(std::vector{unit_box_at(0), unit_box_at(1.02F)}, moving).ok());
      ASSERT_TRUE(broad.find().ok());
      ASSERT_TRUE(broad.update(std::vector{unit_box_at(0.005F), unit_box_at(1.02F)}).ok());
      ASSERT_TRUE(broad.find().ok());
      EXPECT_EQ(broad.read_back().value().raw, raw) << row.id << " margin " << margin;
      EXPECT_NEAR(broad.traits().margin_m, raw == 1 ? 0.02 : 0.01, 1e-8);
    }
  }
}

}  // namespace
}  // namespace broadside
