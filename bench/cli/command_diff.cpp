#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>

#include "bench/cli/commands.hpp"
#include "bench/forensics/difference_text.hpp"
#include "bench/forensics/trace_difference.hpp"
#include "bench/process/progress.hpp"

namespace broadside::bench {
namespace {

struct DiffArguments {
  std::string a;
  std::string b;
  bool as_json = false;
};

core::Exit diff(const DiffArguments& arguments) {
  auto a = core::TraceReader::open(arguments.a);
  if (!a) return complain(a.error());
  auto b = core::TraceReader::open(arguments.b);
  if (!b) return complain(b.error());
  Progress progress("comparing", std::min(a.value().frame_count(), b.value().frame_count()));
  const auto found =
      compare_traces(a.value(), b.value(), nullptr, [&progress](std::uint64_t done) { progress.at(done); });
  if (!found) return complain(found.error());
  fmt::print("{}", arguments.as_json ? difference_json(a.value(), b.value(), found.value())
                                     : difference_text(a.value(), b.value(), found.value()));
  return found.value().is_same() ? core::Exit::kGood : core::Exit::kFailed;
}

}  // namespace

void add_diff(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<DiffArguments>();
  CLI::App* command = program.add_subcommand(
      "diff", "Find where two traces first differ: step, body or pair, field, both values, and the contacts before");
  command->add_option("A", a->a, "A trace (.h5), also an unfinished one (.h5.part)")->required();
  command->add_option("B", a->b, "Another trace of the same scene")->required();
  command->add_flag("--json", a->as_json, "As JSON");
  command->footer(
      "Exit codes: 0 the same, bit by bit; 1 different; 2 unreadable, or not comparable (different scenes).");
  command->callback([a, &exit] { exit = diff(*a); });
}

}  // namespace broadside::bench
