// Each printed error of the paper, run as a user would: its own validator fails, and no other does.
#include <gtest/gtest.h>

#include "core/rows.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

struct Erratum {
  std::string id;
  std::string blames;
};

void PrintTo(const Erratum& e, std::ostream* out) {
  *out << e.id;
}

class Errata : public testing::TestWithParam<Erratum> {};

// Runs the scene, checks its trace, and returns the validators that failed.
std::vector<std::string> failed_validators(const std::string& scene, const std::vector<std::string>& settings,
                                           int expected_exit) {
  const ScratchFolder folder;
  std::vector<std::string> run{"run", scene, "--engine", "octree-cpu", "--out", folder.text()};
  run.insert(run.end(), settings.begin(), settings.end());
  const Ended ran = run_program(run);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  std::filesystem::path trace;
  for (const auto& entry : std::filesystem::directory_iterator(folder.text()))
    if (entry.path().extension() == ".h5") trace = entry.path();
  const Ended checked = run_program({"check", trace.string(), "--json", (folder / "verdicts.json").string()});
  EXPECT_EQ(checked.exit_code, expected_exit) << checked.out << checked.err;
  auto rows = core::read_rows(folder.text());
  EXPECT_TRUE(rows.ok());
  std::vector<std::string> failed;
  std::size_t passed = 0;
  for (const core::CellVerdicts& row : rows.value().verdicts) {
    for (const core::Verdict& v : row.verdicts) {
      if (v.outcome == core::Outcome::kFail) failed.push_back(v.validator);
      if (v.outcome == core::Outcome::kPass) ++passed;
    }
  }
  EXPECT_GE(passed, 5U) << "hardly anything was judged";
  return failed;
}

TEST_P(Errata, PrintedFormIsBlamedByItsOwnValidatorAlone) {
  EXPECT_EQ(failed_validators("errata:" + GetParam().id, {"--set", "variant=printed-" + GetParam().id}, 1),
            std::vector<std::string>{GetParam().blames});
}

TEST_P(Errata, SoundFormPasses) {
  EXPECT_EQ(failed_validators("errata:" + GetParam().id, {}, 0), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Paper, Errata,
                         testing::Values(Erratum{"E2", "candidate-set"}, Erratum{"E3", "center-of-mass"},
                                         Erratum{"E4", "contraction"}, Erratum{"E5", "normal-energy"},
                                         Erratum{"E6", "friction-energy"}, Erratum{"E7", "octree-invariants"}),
                         [](const auto& instance) { return instance.param.id; });

}  // namespace
}  // namespace broadside::tests
