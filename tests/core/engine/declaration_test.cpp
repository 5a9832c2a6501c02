// What engines declare: known keys and words, defaults, errors that name what is known, and the page that lists them.
#include "core/engine/declaration.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "core/trace/format1.hpp"

namespace broadside::tests {
namespace {

using core::Declaration;

std::string refusal(const std::map<std::string, std::string>& given) {
  const auto parsed = Declaration::parse(given, "there");
  return parsed ? "" : parsed.error().line();
}

TEST(Declaration, WhatIsNotDeclaredIsWhatThePlainestRightEngineWouldDeclare) {
  const Declaration nothing;
  EXPECT_FALSE(nothing.follows_method());
  EXPECT_TRUE(nothing.turns());
  EXPECT_FALSE(nothing.is_compliant());
  EXPECT_EQ(nothing.text("friction"), "cone");
  EXPECT_EQ(nothing.number("contact_margin_m"), 0.0);
  EXPECT_EQ(nothing.number("order"), 1.0);
  EXPECT_FALSE(nothing.declares("order"));
}

TEST(Declaration, ValuesAreReadBack) {
  const auto parsed =
      Declaration::parse({{"friction", "pyramid"}, {"contact_margin_m", "0.02"}, {"order", "2"}}, "there");
  ASSERT_TRUE(parsed.ok()) << parsed.error().line();
  EXPECT_EQ(parsed.value().text("friction"), "pyramid");
  EXPECT_EQ(parsed.value().number("contact_margin_m"), 0.02);
  EXPECT_EQ(parsed.value().number("order"), 2.0);
  EXPECT_TRUE(parsed.value().declares("order"));
}

TEST(Declaration, UnknownKeysAndWordsAreOneClearLine) {
  EXPECT_EQ(refusal({{"frictoin", "cone"}}), "there: a declaration has no key 'frictoin'; did you mean 'friction'?");
  EXPECT_EQ(refusal({{"friction", "con"}}), "there: 'friction' cannot be declared as 'con'; did you mean 'cone'?");
  for (const char* text : {"-1", "nan", "inf", "1e", ""}) EXPECT_NE(refusal({{"contact_margin_m", text}}), "") << text;
  for (const char* text : {"0", "-1", "1.5", "01", "9999999999"}) EXPECT_NE(refusal({{"substeps", text}}), "") << text;
}

TEST(Declaration, TracesOfFormat1KeepWhatTheirNamesStoodFor) {
  EXPECT_FALSE(core::declaration_of_format1("bullet-world").follows_method());
  EXPECT_TRUE(core::declaration_of_format1("anything").follows_method());
  EXPECT_EQ(core::declaration_of_format1("octree-gpu").text("twin_of"), "octree-cpu");
  EXPECT_FALSE(core::declaration_of_format1("octree-cpu").declares("twin_of"));
}

TEST(Declaration, ThePageForForeignTracesListsEveryKeyAndWord) {
  std::ifstream file(std::string(BROADSIDE_SOURCE_DIR) + "/core/trace/FOREIGN.md");
  std::stringstream page;
  page << file.rdbuf();
  for (const core::DeclarationKey& key : core::declaration_keys()) {
    EXPECT_NE(page.str().find("| `" + std::string(key.key) + "` |"), std::string::npos) << key.key;
    for (const std::string_view word : key.allowed)
      EXPECT_NE(page.str().find(word), std::string::npos) << key.key << ": " << word;
  }
}

}  // namespace
}  // namespace broadside::tests
