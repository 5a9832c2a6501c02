#include "bench/fetched/fetched_engines.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "bench/engines.hpp"
#include "bench/fetched/program_files.hpp"

namespace broadside::bench {
namespace {

namespace fs = std::filesystem;

// Uses a cache of its own, so that engines which a user installed are not seen.
class FetchedEngines : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("fetched_engines_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    const char* before = getenv("XDG_CACHE_HOME");
    before_ = before == nullptr ? "" : before;
    setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
  }
  void TearDown() override {
    before_.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", before_.c_str(), 1);
    fs::remove_all(folder_);
  }
  // Leaves the files that npm would leave.
  void install(const std::string& id) {
    for (const ProgramFile& file : program_files()) {
      fs::create_directories((root(id) / file.path).parent_path());
      std::ofstream(root(id) / file.path, std::ios::binary) << file.text;
    }
    fs::create_directories(root(id) / "reference" / "programs" / id / "node_modules");
  }
  [[nodiscard]] fs::path root(const std::string& id) const { return folder_ / "broadside" / "engines" / id; }

  fs::path folder_;
  std::string before_;
};

TEST_F(FetchedEngines, ARowSaysHowToInstallIt) {
  for (const core::EngineRow& row : fetched_engine_rows()) {
    EXPECT_EQ(why_absent(row), "not installed: broadside fetch-engine " + std::string(row.id));
    EXPECT_EQ(fetched_command(row.id), "");
    const auto found = find_engine(row.id);
    ASSERT_TRUE(found) << row.id;
    EXPECT_EQ(found.value()->id, row.id);
  }
}

// Program, package.json and lock file of each row are compiled in, and the client that all of them import.
TEST_F(FetchedEngines, EveryRowHasItsFiles) {
  const auto has = [](const std::string& path) {
    for (const ProgramFile& file : program_files())
      if (file.path == path && !file.text.empty()) return true;
    return false;
  };
  EXPECT_TRUE(has("core/plugin/clients/broadside_engine.mjs"));
  EXPECT_TRUE(has("reference/programs/rigid_bodies.mjs"));
  for (const core::EngineRow& row : fetched_engine_rows())
    for (const std::string& file :
         {std::string(row.id) + ".mjs", std::string("package.json"), std::string("package-lock.json")})
      EXPECT_TRUE(has("reference/programs/" + std::string(row.id) + "/" + file)) << row.id << " " << file;
}

TEST_F(FetchedEngines, AnInstalledOneIsACommand) {
  install("jolt");
  EXPECT_EQ(fetched_command("jolt"), "node '" + (root("jolt") / "reference/programs/jolt/jolt.mjs").string() + "'");
  EXPECT_EQ(fetched_command("rapier"), "");
}

// Files that another version of this tree installed are not taken for this program's.
TEST_F(FetchedEngines, AnOlderProgramIsInstalledAgain) {
  install("jolt");
  std::ofstream(root("jolt") / "reference/programs/rigid_bodies.mjs") << "// older\n";
  EXPECT_EQ(fetched_command("jolt"), "");
}

TEST_F(FetchedEngines, AnUnknownNameIsOneLine) {
  const core::Status s = fetch_engine("jollt", [](std::string_view) {});
  ASSERT_FALSE(s);
  EXPECT_NE(s.error().line().find("jolt"), std::string::npos);
  EXPECT_EQ(s.error().exit, core::Exit::kBadInput);
}

}  // namespace
}  // namespace broadside::bench
