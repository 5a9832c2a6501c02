// The energy ledger from its file to the page.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/energy_series.hpp"
#include "reports/report.hpp"
#include "tests/reports/markup_checker.hpp"
#include "tests/reports/sample_rows.hpp"

namespace broadside::reports {
namespace {

core::EnergySeries falling(std::uint64_t frames) {
  core::EnergySeries series{"octree-cpu.h5", "freefall:<cube>:50", "octree-cpu", {}, {}};
  for (std::uint64_t k = 1; k <= frames; ++k) {
    series.step.push_back(k);
    for (std::size_t c = 0; c < core::kEnergyColumnCount; ++c)
      series.joule[c].push_back(0.1 * static_cast<double>(k) - static_cast<double>(c));
  }
  return series;
}

class EnergyFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("energy_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& text) const { std::ofstream(folder_ / "energy.json") << text; }
  std::filesystem::path folder_;
};

TEST_F(EnergyFile, ComesBackAsItWasWritten) {
  ASSERT_TRUE(core::write_energy(folder_ / "energy.json", {falling(7), falling(0)}).ok());
  const auto read = core::read_energy(folder_);
  ASSERT_TRUE(read.ok()) << read.error().line();
  ASSERT_EQ(read.value().size(), 2U);
  const core::EnergySeries wrote = falling(7);
  EXPECT_EQ(read.value()[0].scene_name, wrote.scene_name);
  EXPECT_EQ(read.value()[0].step, wrote.step);
  for (std::size_t c = 0; c < core::kEnergyColumnCount; ++c) EXPECT_EQ(read.value()[0].joule[c], wrote.joule[c]);
}

TEST_F(EnergyFile, AbsentIsNoSeriesAndMalformedIsOneClearLine) {
  EXPECT_TRUE(core::read_energy(folder_).value().empty());
  for (const char* text :
       {"{", "[]", R"({"format": "broadside-energy", "version": 2, "rows": []})",
        R"({"format": "broadside-energy", "version": 1})",
        R"({"format": "broadside-energy", "version": 1, "rows": [{"trace_file": "t", "scene_name": "s", "label": "l",
            "step": [1, 2], "kinetic": [1]}]})",
        R"({"format": "broadside-energy", "version": 1, "rows": [7]})"}) {
    write(text);
    const auto read = core::read_energy(folder_);
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_NE(read.error().line().find("energy.json"), std::string::npos);
    EXPECT_EQ(read.error().exit, core::Exit::kBadInput);
  }
}

TEST(EnergySection, PlotsTheLedgerAndNothingWithoutOne) {
  if (!has_html_page()) GTEST_SKIP() << "built with BROADSIDE_REPORT_HTML=OFF";
  EXPECT_EQ(html_page(testing_rows::sample_rows(), {}).find("Where the energy went"), std::string::npos);
  ReportOptions options;
  options.energy = {falling(3000), falling(0)};
  const std::string page = html_page(testing_rows::sample_rows(), options);
  EXPECT_NE(page.find("Where the energy went"), std::string::npos);
  EXPECT_NE(page.find("freefall:&lt;cube&gt;:50"), std::string::npos);
  const auto markup = testing_markup::check_markup(page, true);
  EXPECT_EQ(markup.problem, "");
  const auto without = testing_markup::check_markup(html_page(testing_rows::sample_rows(), {}), true);
  EXPECT_EQ(markup.count("svg"), without.count("svg") + 2U);
  EXPECT_NE(page.find("normal impulses"), std::string::npos);
}

}  // namespace
}  // namespace broadside::reports
