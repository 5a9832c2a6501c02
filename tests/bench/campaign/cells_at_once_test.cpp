// Cells of a contest that are done several at a time.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "core/rows.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

using CellDigests = std::map<std::string, std::map<std::uint64_t, std::uint64_t>>;

CellDigests cell_digests_in(const std::filesystem::path& folder) {
  CellDigests all;
  const auto rows = core::read_rows(folder);
  EXPECT_TRUE(rows.ok());
  if (!rows) return all;
  for (const core::Cell& cell : rows.value().cells) all[cell.stamp.scene_name + cell.stamp.label()] = cell.digests;
  return all;
}

Ended contest(const std::filesystem::path& out, const std::string& jobs) {
  return run_program({"contest", "--engines", "plain-rigid", "octree-cpu", "--scenes", "rigid:spin-up",
                      "rigid:billiards:central", "--steps", "1", "--repetitions", "0", "--jobs", jobs, "--out",
                      out.string()});
}

// Each cell is a process of its own, so cells that run beside it change no bit; and no cell is run twice.
TEST(CellsAtOnce, GiveTheDigestsOfOneByOne) {
  const ScratchFolder folder;
  const Ended one = contest(folder / "one", "1");
  const Ended three = contest(folder / "three", "3");
  EXPECT_EQ(one.exit_code, three.exit_code) << three.out << three.err;
  const CellDigests expected = cell_digests_in(folder / "one");
  ASSERT_EQ(expected.size(), 4U);
  for (const auto& [cell, digests] : expected) EXPECT_FALSE(digests.empty()) << cell;
  EXPECT_EQ(cell_digests_in(folder / "three"), expected);
  EXPECT_NE(three.err.find("4 of 4"), std::string::npos) << three.err;
  EXPECT_NE(read_text(folder / "three/contest.html").find("--jobs 3"), std::string::npos);
}

TEST(CellsAtOnce, APageOfFinishedCellsNeedsNoNewPlan) {
  const ScratchFolder folder;
  const std::filesystem::path out = folder / "d";
  contest(out, "2");
  // The manifest names another build as its planner: the page is made from the cells all the same.
  std::string manifest = read_text(out / "manifest.json");
  const std::string old_build = core::read_rows(out).value().cells.front().stamp.broadside_build;
  ASSERT_NE(manifest.find(old_build), std::string::npos);
  const auto before = cell_digests_in(out);
  const Ended page = run_program(
      {"contest", "--engines", "plain-rigid", "--scenes", "rigid:spin-up", "--only-report", "--out", out.string()});
  EXPECT_EQ(page.exit_code, 0) << page.out << page.err;
  EXPECT_EQ(read_text(out / "manifest.json"), manifest);
  EXPECT_EQ(cell_digests_in(out), before);
}

}  // namespace
}  // namespace broadside::tests
