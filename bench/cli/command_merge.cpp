#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "bench/campaign/merge.hpp"
#include "bench/cli/commands.hpp"

namespace broadside::bench {
namespace {

core::Exit merge(const std::string& folder, const std::string& out) {
  auto merged = campaign::merge_cells(folder, out.empty() ? folder : out);
  if (!merged) return complain(merged.error());
  const campaign::MergeSummary& summary = merged.value();
  fmt::print("{} cells planned, {} missing; rows:", summary.cells, summary.missing);
  for (const auto& [state, count] : summary.by_state) fmt::print(" {} {}", count, state);
  if (summary.failed > 0) fmt::print("; {} verdicts failed", summary.failed);
  fmt::print("\n");
  for (const std::string& line : summary.notable) fmt::print("  {}\n", line);
  if (summary.failed > 0) return core::Exit::kFailed;
  return summary.notable.empty() ? core::Exit::kGood : core::Exit::kMissing;
}

}  // namespace

void add_merge(CLI::App& program, core::Exit& exit) {
  CLI::App* command = program.add_subcommand(
      "merge", "Put the cells of a campaign together; lists what is missing, crashed or timed out");
  auto folder = std::make_shared<std::string>();
  auto out = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "The campaign's folder")->required();
  command->add_option("--out", *out, "Folder for cells.json, verdicts.json and samples.json (default: DIR)");
  command->callback([folder, out, &exit] { exit = merge(*folder, *out); });
}

}  // namespace broadside::bench
