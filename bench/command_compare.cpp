#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "bench/commands.hpp"
#include "core/rows.hpp"
#include "reports/comparison.hpp"

namespace broadside::bench {
namespace {

core::Result<core::RunRows> rows_of(const std::string& folder) {
  if (!std::filesystem::is_directory(folder))
    return core::Error{"no such folder", folder, "name a folder that run or demo wrote"};
  auto rows = core::read_rows(folder);
  if (rows.ok() && rows.value().cells.empty() && rows.value().verdicts.empty() && rows.value().samples.empty())
    return core::Error{"there is nothing to compare: no cells.json, verdicts.json or samples.json", folder,
                       "run 'broadside run', 'check --json' and 'time' into it first"};
  return rows;
}

core::Exit compare(const std::string& base, const std::string& head) {
  auto before = rows_of(base);
  if (!before) return complain(before.error());
  auto after = rows_of(head);
  if (!after) return complain(after.error());
  const reports::Comparison comparison = reports::compare(before.value(), after.value());
  fmt::print("{}", reports::comparison_text(comparison));
  return comparison.exit();
}

}  // namespace

void add_compare(CLI::App& program, core::Exit& exit) {
  auto base = std::make_shared<std::string>();
  auto head = std::make_shared<std::string>();
  CLI::App* command =
      program.add_subcommand("compare", "Two runs side by side: what got worse first, then what got slower");
  command->add_option("BASE", *base, "Folder of the run to compare with")->required();
  command->add_option("HEAD", *head, "Folder of the run in question")->required();
  command->callback([base, head, &exit] { exit = compare(*base, *head); });
}

}  // namespace broadside::bench
