#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "bench/cli/commands.hpp"
#include "core/trace/recover.hpp"

namespace broadside::bench {
namespace {

core::Exit recover(const std::filesystem::path& part, std::filesystem::path out) {
  if (out.empty()) {
    if (part.extension() != ".part")
      return complain({"its name does not end in .part", part.string(), "name an unfinished trace, or give --out"});
    out = part;
    out.replace_extension();
  }
  auto report = core::recover_trace(part, out);
  if (!report) return complain(report.error());
  fmt::print("{}\n", report.value().line());
  return core::Exit::kGood;
}

}  // namespace

void add_recover(CLI::App& program, core::Exit& exit) {
  auto part = std::make_shared<std::string>();
  auto out = std::make_shared<std::string>();
  CLI::App* command =
      program.add_subcommand("recover", "Make a complete trace from the .part file of a killed or interrupted run");
  command->add_option("FILE", *part, "The unfinished trace, NAME.h5.part")->required();
  command->add_option("--out", *out, "Where to write it (default: the name without .part)");
  command->callback([part, out, &exit] { exit = recover(*part, *out); });
}

}  // namespace broadside::bench
