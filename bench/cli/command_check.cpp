#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "bench/cli/commands.hpp"
#include "bench/record/judging.hpp"
#include "reports/report.hpp"
#include "reports/terminal_table.hpp"
#include "validation/outcome.hpp"

namespace broadside::bench {
namespace {

struct CheckArguments {
  std::vector<std::string> traces;
  std::string against;
  std::vector<std::string> only;
  std::string json;
  std::string junit;
  std::string energy;
};

// Prints the traces on which no law was judged, and why. Returns false when there is none.
bool tell_unjudged(const std::vector<core::CellVerdicts>& rows) {
  bool any = false;
  for (const core::CellVerdicts& row : rows) {
    const auto worst = validation::worst_outcome(row.verdicts);
    if (worst != core::Outcome::kNotApplicable) continue;
    any = true;
    std::string why;
    for (const core::Verdict& v : row.verdicts)
      if (why.empty()) why = ": " + v.validator + ": " + v.explanation;
    fmt::print("\nnothing was judged in {}{}\n", row.trace_file, why);
  }
  return any;
}

core::Exit check(const CheckArguments& a) {
  core::RunRows rows;
  std::vector<core::EnergySeries> energy;
  for (const std::string& trace : a.traces) {
    core::EnergySeries series;
    auto row = judge_matter({trace, a.against, false, a.only, a.energy.empty() ? nullptr : &series});
    if (!row) return complain(row.error());
    if (!series.step.empty()) energy.push_back(std::move(series));
    rows.verdicts.push_back(std::move(row).value());
  }
  fmt::print("{}", reports::verdict_table(rows.verdicts));
  const std::string failures = reports::failure_lines(rows.verdicts);
  if (!failures.empty()) fmt::print("\n{}", failures);
  const std::string warnings = reports::warning_lines(rows.verdicts);
  if (!warnings.empty()) fmt::print("\n{}", warnings);
  if (!a.json.empty()) {
    if (core::Status s = core::write_verdicts(a.json, rows.verdicts); !s) return complain(s.error());
  }
  if (!a.energy.empty())
    if (core::Status s = core::write_energy(a.energy, energy); !s) return complain(s.error());
  if (!a.junit.empty()) {
    if (core::Status s = reports::write_junit(rows, {}, a.junit); !s) return complain(s.error());
  }
  const core::Exit exit = exit_of(rows.verdicts);
  return tell_unjudged(rows.verdicts) && exit == core::Exit::kGood ? core::Exit::kMissing : exit;
}

}  // namespace

void add_check(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<CheckArguments>();
  CLI::App* command = program.add_subcommand(
      "check", "Judge traces with every validator that applies, and show each limit and its origin");
  command->add_option("TRACE", a->traces, "Trace files (.h5), also unfinished ones (.h5.part)")->required();
  command->add_option("--against", a->against, "Another trace of the same scene to compare with");
  command->add_option("--validator", a->only, "Run only this validator; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--json", a->json, "Write the verdicts here, as report reads them (DIR/verdicts.json)");
  command->add_option("--energy", a->energy,
                      "Write the energy ledger of each trace here, as report plots it (DIR/energy.json)");
  command->add_option("--junit", a->junit, "Write the verdicts here as JUnit XML");
  command->callback([a, &exit] { exit = check(*a); });
}

}  // namespace broadside::bench
