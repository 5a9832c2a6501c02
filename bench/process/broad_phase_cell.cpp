#include "bench/process/broad_phase_cell.hpp"

#include <string_view>
#include <utility>

#include "bench/engines.hpp"
#include "bench/plugin_engines.hpp"

namespace broadside::bench {

core::Result<core::Engine> make_broad_phase_of(const CellSpec& cell) {
  const std::string id(cell.row->id);
  const std::string reason = why_absent(*cell.row);
  if (!reason.empty()) return core::Error{"not measured: " + reason, id, "leave it out", core::Exit::kMissing};
  auto settings = core::Settings::parse(cell.row->id, cell.row->settings, cell.settings);
  if (!settings) return settings.error();
  auto engine = cell.row->create(settings.value());
  if (engine && engine.value().broad_phase == nullptr)
    return core::Error{"it offers no broad phase with these settings", id, "see 'broadside list engines'"};
  return engine;
}

bool runs_apart(const CellSpec& cell, const ChildLimits& limits) {
  return (cell.row->runs_in_child || limits.are_asked) && why_absent(*cell.row).empty();
}

core::Result<ChildAnswer> ask_child(std::vector<std::string> arguments, const CellSpec& cell,
                                    const ChildLimits& limits) {
  const std::string command = arguments.front();
  arguments.insert(arguments.end(), {"--engine", engine_argument(*cell.row), "--json", "--in-process"});
  for (const auto& [key, value] : cell.settings) arguments.insert(arguments.end(), {"--set", key + "=" + value});
  append_memory_limit(arguments, limits);
  auto ended = run_self(arguments, limits, Keeps::kOutputAndErrors);
  if (!ended) return ended.error();
  const ChildEnding& ending = ended.value();
  if (ending.is_interrupted) return core::Error{"interrupted", command, "", core::Exit::kMissing};
  if (ending.is_good) return ChildAnswer{.output = ending.output, .absent = {}, .verdict = {}, .repeat = {}};
  if (ending.exit_code == static_cast<int>(core::Exit::kBadInput)) {
    std::string_view line = ending.last_line;
    constexpr std::string_view kName = "broadside: ";
    if (line.starts_with(kName)) line.remove_prefix(kName.size());
    return core::Error{std::string(line)};
  }
  return ChildAnswer{.output = {},
                     .absent = ending.words,
                     .verdict = std::string(class_of(ending)),
                     .repeat = command_line(arguments)};
}

}  // namespace broadside::bench
