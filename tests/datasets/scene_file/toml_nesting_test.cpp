// How deep a TOML text nests, for texts whose depth is known, and the error for a scene file that nests too deeply. A
// name of 50,000 parts once ended the program by a segmentation fault.
#include "datasets/scene_file/toml_nesting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "datasets/scene_file/document.hpp"
#include "tests/datasets/temporary_folder.hpp"

namespace broadside {
namespace {

using datasets::kDeepestToml;
using datasets::kMostNameParts;
using datasets::toml_nesting;
using tests::TemporaryFolder;

std::string name_of(std::size_t parts) {
  std::string name = "a";
  for (std::size_t k = 1; k < parts; ++k) name += ".a";
  return name;
}

TEST(TomlNesting, CountsBracketsAndPartsOfNames) {
  EXPECT_EQ(toml_nesting("x = 1\n").name_parts, 0U);
  EXPECT_EQ(toml_nesting("a . b.c = 1\n").name_parts, 3U);
  EXPECT_EQ(toml_nesting("\"a.b\".'c.d'.e = 1\n").name_parts, 3U);
  EXPECT_EQ(toml_nesting("x = [0.5, 1.5, 2.5]\n").name_parts, 2U);
  EXPECT_EQ(toml_nesting("x = [[1, 2], [[3]]]\n").brackets, 3U);
  EXPECT_EQ(toml_nesting("[[body]]\nx = {a = [1]}\n").brackets, 2U);
}

TEST(TomlNesting, TextAndCommentsDoNotCount) {
  const std::string deep(100, '[');
  for (const std::string& text :
       {"x = \"" + deep + "\"\n", "x = '" + deep + "'\n", "# " + deep + "\n", "x = \"\"\"\n" + deep + "\n\"\"\"\n",
        "x = '''\n" + deep + "'''\n", "x = \"\\\"" + deep + "\"\n", "x = \"\"\"a\"\"\"\"\"\ny = \"" + deep + "\"\n",
        "x = '''\n" + name_of(100) + "'''\n"}) {
    EXPECT_EQ(toml_nesting(text).line, 0U) << text;
    EXPECT_EQ(toml_nesting(text + "y = " + deep).line,
              1U + static_cast<unsigned>(std::count(text.begin(), text.end(), '\n')))
        << text;
  }
}

TEST(TomlNesting, AFilePastALimitIsOneLineThatSaysWhere) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text) {
    const auto parsed = datasets::parse_toml(folder.file("t.toml", text));
    EXPECT_FALSE(parsed.ok());
    return parsed.ok() ? std::string() : parsed.error().line();
  };
  const auto expect_refused = [&](const std::string& text, const char* must_say) {
    const std::string line = refused(text);
    EXPECT_NE(line.find("t.toml:2: "), std::string::npos) << line;
    EXPECT_NE(line.find(must_say), std::string::npos) << line;
  };
  expect_refused("\n[" + name_of(50000) + "]\nx = 1\n", "more than 32 parts");
  expect_refused("\n" + name_of(50000) + " = 1\n", "more than 32 parts");
  expect_refused("\nx = {" + name_of(50000) + " = 1}\n", "more than 32 parts");
  expect_refused("\nx = " + std::string(100000, '[') + "\n", "more than 32 levels");
  EXPECT_TRUE(datasets::parse_toml(folder.file("t.toml", "[" + name_of(kMostNameParts) + "]\nx = 1\n")).ok());
  const std::string brackets = "x = " + std::string(kDeepestToml, '[') + "1" + std::string(kDeepestToml, ']') + "\n";
  EXPECT_TRUE(datasets::parse_toml(folder.file("t.toml", brackets)).ok());
}

}  // namespace
}  // namespace broadside
