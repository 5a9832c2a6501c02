// Settings that are lengths in meters: what is accepted, what is refused, and that one length has one text.
#include "core/engine/length_setting.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace broadside::core {
namespace {

Result<Settings> parsed(const std::string& text) {
  static const std::array<SettingRow, 1> rows{{{"margin", "0", {"shipped", kMeters}, "a test"}}};
  return Settings::parse("engine", rows, {{"margin", text}});
}

TEST(LengthSetting, DecimalNumbersAndWordsAreTaken) {
  EXPECT_DOUBLE_EQ(meters_of(parsed("0.02").value(), "margin"), 0.02);
  EXPECT_DOUBLE_EQ(meters_of(parsed("1e-3").value(), "margin"), 0.001);
  EXPECT_EQ(parsed("shipped").value().text("margin"), "shipped");
  EXPECT_EQ(parsed("shipped").value().short_form(), "margin=shipped");
}

TEST(LengthSetting, TheSameLengthHasTheSameStamp) {
  for (const std::string text : {"0.05", "0.050", "5e-2", "00.05"})
    EXPECT_EQ(parsed(text).value().canonical(), "margin=0.05") << text;
  for (const std::string text : {"0", "0.0", "0e5"}) EXPECT_EQ(parsed(text).value().short_form(), "") << text;
}

TEST(LengthSetting, AnythingElseIsRefusedWithAdvice) {
  for (const std::string text : {"", "-0.1", "-0", "inf", "nan", "0.1m", " 0.1", "METERS", "ship", "0x1"}) {
    const auto settings = parsed(text);
    ASSERT_FALSE(settings.ok()) << text;
    EXPECT_NE(settings.error().line().find("give 'shipped' or meters"), std::string::npos) << settings.error().line();
  }
}

}  // namespace
}  // namespace broadside::core
