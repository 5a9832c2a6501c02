#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "bench/cli/commands.hpp"
#include "bench/fetched/fetched_engines.hpp"

namespace broadside::bench {
namespace {

core::Exit install(const std::vector<std::string>& engines) {
  for (const std::string& id : engines) {
    const auto say = [&](std::string_view step) { fmt::print(stderr, "{}: {}\n", id, step); };
    if (core::Status s = fetch_engine(id, say); !s) return complain(s.error());
    fmt::print("{}: {}\n", id, fetched_command(id));
  }
  return core::Exit::kGood;
}

}  // namespace

void add_fetch_engine(CLI::App& program, core::Exit& exit) {
  auto engines = std::make_shared<std::vector<std::string>>();
  CLI::App* command = program.add_subcommand(
      "fetch-engine", "Install engines that are packages of npm, each with the version that its lock file names");
  std::string names;
  for (const core::EngineRow& row : fetched_engine_rows()) names += (names.empty() ? "" : ", ") + std::string(row.id);
  command->add_option("ENGINE", *engines, "Of " + names)->required();
  command->callback([engines, &exit] { exit = install(*engines); });
}

}  // namespace broadside::bench
