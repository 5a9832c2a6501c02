// Traces of other programs: the page that lists what they need, the example that writes one, and what the program does
// with it.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "core/trace/columns.hpp"
#include "core/trace/trace_header.hpp"
#include "tests/bench/cli/program.hpp"
#include "tests/bench/forensics/python_with_h5py.hpp"
#include "validation/judge.hpp"

namespace broadside::tests {
namespace {

struct Row {
  std::uint32_t needed = 0;
  std::uint32_t read = 0;
};

std::uint32_t group_named(const std::string& name) {
  for (const core::GroupRow& row : core::group_rows())
    if (row.path == "/trace/" + name) return core::bit(row.group);
  ADD_FAILURE() << "there is no group /trace/" << name;
  return 0;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

// The page's table: validator -> groups.
std::map<std::string, Row> page_rows() {
  std::ifstream page(std::string(BROADSIDE_SOURCE_DIR) + "/core/trace/FOREIGN.md");
  std::map<std::string, Row> rows;
  bool is_in_table = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("| validator |")) is_in_table = true;
    if (line.empty()) is_in_table = false;
    if (!is_in_table || line.starts_with("|---") || line.starts_with("| validator |")) continue;
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, '|');
    std::getline(cells, cell, '|');
    const std::string name = trimmed(cell);
    std::getline(cells, cell, '|');
    std::istringstream groups(cell);
    Row row;
    for (std::string group; std::getline(groups, group, ',');) {
      group = trimmed(group);
      const bool is_optional = group.starts_with('(');
      const std::uint32_t bit = group_named(is_optional ? group.substr(1, group.size() - 2) : group);
      row.read |= bit;
      if (!is_optional) row.needed |= bit;
    }
    rows[name] = row;
  }
  return rows;
}

TEST(ForeignPage, SaysForEachValidatorWhatItReads) {
  std::map<std::string, Row> rows = page_rows();
  for (const validation::ValidatorRow& v : validation::validators()) {
    const auto row = rows.find(std::string(v.name));
    if (row == rows.end()) {
      ADD_FAILURE() << "core/trace/FOREIGN.md has no row for " << v.name;
      continue;
    }
    EXPECT_EQ(row->second.read, v.groups) << v.name;
    // A trace with the needed groups alone is judged; a baseline is the trace itself.
    core::TraceHeader header;
    header.stamp.engine = "foreign";
    // Laws of mechanics hold for every engine; some of them apply only where no law of the method checks the same more
    // strictly.
    if (!v.reads_motion) header.declaration = core::method_declaration();
    header.scene.motion = v.reads_motion ? core::Motion::kRigid : core::Motion::kTranslate;
    header.scene.answer = v.name == "closed-form" ? "flight" : "stands";
    // What laws need to know about the settings and the scene.
    header.stamp.settings = "levels=C,solver=colored";
    header.scene.bodies.emplace_back();
    header.scene.springs = {{0, {}, 1.0F, 0.0F}};
    header.groups = row->second.needed;
    core::TraceHeader transformed = header;
    transformed.stamp.scene_digest = 1;
    EXPECT_EQ(v.why_not({header, v.compares_scenes ? &transformed : &header, 1}), "") << v.name;
    for (const core::GroupRow& group : core::group_rows()) {
      if ((row->second.needed & core::bit(group.group)) == 0) continue;
      core::TraceHeader less = header;
      less.groups &= ~core::bit(group.group);
      EXPECT_NE(v.why_not({less, &less, 1}), "") << v.name << " without " << group.path;
    }
    rows.erase(row);
  }
  for (const auto& [name, row] : rows) ADD_FAILURE() << "there is no validator " << name;
}

class ForeignEngine : public testing::Test {
 protected:
  void SetUp() override {
    python_ = python_with_h5py();
    if (python_.empty()) GTEST_SKIP() << "no Python with h5py and numpy here (Debian: python3-h5py)";
  }
  std::string written(const std::string& fault) const {
    const std::string file = (folder_ / (fault + ".h5")).string();
    const std::string command = python_ + " -B '" + std::string(BROADSIDE_SOURCE_DIR) +
                                "/core/trace/examples/foreign_engine.py' '" + file + "' --fault " + fault;
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return file;
  }

  std::string python_;
  const ScratchFolder folder_;
};

TEST_F(ForeignEngine, IsJudgedByWhatItRecords) {
  const Ended ended = run_program({"check", written("none")});
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("foreign:cubes: foreign-cubes"), std::string::npos) << ended.out;
  for (const char* passes : {"candidate-set", "capacity", "velocity-cap", "state-sanity"}) {
    const auto at = ended.out.find(passes);
    ASSERT_NE(at, std::string::npos) << passes;
    EXPECT_NE(ended.out.substr(at, 30).find(" pass"), std::string::npos) << ended.out.substr(at, 60);
  }
  EXPECT_NE(ended.out.find("records no contacts"), std::string::npos) << ended.out;
}

TEST_F(ForeignEngine, IsCaughtWhenItIsWrong) {
  const std::map<std::string, std::string> caught_by{{"lost-pair", "candidate-set"},
                                                     {"extra-pair", "candidate-set"},
                                                     {"stale-boxes", "state-sanity"},
                                                     {"nan", "velocity-cap"},
                                                     {"drift", "state-sanity"}};
  for (const auto& [fault, validator] : caught_by) {
    const Ended ended = run_program({"check", written(fault)});
    EXPECT_EQ(ended.exit_code, 1) << fault << ended.out << ended.err;
    EXPECT_NE(ended.out.find("foreign-cubes: " + validator + " FAIL"), std::string::npos) << fault << ended.out;
  }
}

TEST_F(ForeignEngine, IsRepeatedByBroadPhasesExactly) {
  const std::string sound = written("none");
  for (const char* engine : {"all-pairs", "octree-cpu", "bullet-dbvt"}) {
    const Ended ended = run_program({"replay", sound, "--engine", engine, "--as", "broad"});
    EXPECT_EQ(ended.exit_code, 0) << engine << ended.out << ended.err;
  }
  const Ended ended = run_program({"replay", written("lost-pair"), "--engine", "all-pairs"});
  EXPECT_EQ(ended.exit_code, 1) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("only in B"), std::string::npos) << ended.out;
}

// Its contact response differs from ours: it is compared until bodies are touched for the first time, and not after
// that.
TEST_F(ForeignEngine, IsRepeatedBySimulationUntilBodiesAreTouched) {
  const Ended ended = run_program({"replay", written("none"), "--engine", "octree-cpu"});
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("bodies were touched"), std::string::npos) << ended.out;
  const Ended drifted = run_program({"replay", written("drift"), "--engine", "octree-cpu"});
  EXPECT_EQ(drifted.exit_code, 1) << drifted.out << drifted.err;
  EXPECT_NE(drifted.out.find("First difference: step 11, body 5"), std::string::npos) << drifted.out;
}

TEST_F(ForeignEngine, HasNothingForAnEngineOfAnotherKind) {
  const Ended ended = run_program({"replay", written("none"), "--engine", "exact-mesh"});
  EXPECT_EQ(ended.exit_code, 2) << ended.out;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
}

}  // namespace
}  // namespace broadside::tests
