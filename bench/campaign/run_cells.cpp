#include "bench/campaign/run_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <vector>

#include "bench/build_facts.hpp"
#include "bench/campaign/cell_lock.hpp"
#include "bench/child.hpp"
#include "bench/interrupt.hpp"
#include "core/rows.hpp"

namespace broadside::bench::campaign {
namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

bool read_number(std::string_view text, std::uint32_t& out) {
  const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), out);
  return bad == std::errc() && end == text.data() + text.size();
}

std::vector<std::string> scene_arguments(const CellWork& work) {
  std::vector<std::string> arguments{work.scene, "--engine", work.engine};
  if (work.frames > 0) arguments.insert(arguments.end(), {"--frames", std::to_string(work.frames)});
  if (work.stand_in) arguments.emplace_back("--stand-in");
  return arguments;
}

std::vector<std::string> command(std::string name, const CellWork& work, std::initializer_list<std::string> rest) {
  std::vector<std::string> arguments{std::move(name)};
  const std::vector<std::string> scene = scene_arguments(work);
  arguments.insert(arguments.end(), scene.begin(), scene.end());
  arguments.insert(arguments.end(), rest);
  return arguments;
}

// Judged good, judged bad, something is missing: results all three. Other exit codes are bad input or a full disk.
bool is_result(const ChildEnding& ending) {
  return ending.exit_code == 0 || ending.exit_code == 1 || ending.exit_code == 3;
}

std::vector<std::string> traces_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed))
    if (entry.path().extension() == ".h5") names.push_back(entry.path().string());
  std::sort(names.begin(), names.end());
  return names;
}

// A crash or time-out of the harness's own child, written as the cell's row: it happened, and it is the result.
core::Status write_ended_badly(const fs::path& part, const CellWork& work, const ChildEnding& ending) {
  core::Cell cell;
  cell.stamp.scene_name = work.scene;
  cell.stamp.engine = work.engine;
  cell.stamp.broadside_build = build_line();
  cell.stamp.machine = machine_line();
  cell.state = ending.timed_out ? core::CellState::kTimedOut : core::CellState::kCrashed;
  cell.reason = ending.words;
  return core::write_cells(part / "cells.json", {cell});
}

// How the last part of a cell ended, or the first that gave no result.
core::Result<ChildEnding> record_judge_time(const fs::path& part, const CellWork& work) {
  // Each part has the limit for itself. Recording ends a hanging engine on its own: that is a result, and only a
  // harness that hangs too is ended from here.
  constexpr double kGrace_s = 30.0;
  const std::string limit = fmt::format("{}", work.time_limit_s);
  auto ended = run_self(command("run", work, {"--out", part.string(), "--time-limit", limit}),
                        {work.time_limit_s + kGrace_s}, Keeps::kOutputAndErrors);
  if (!ended || !is_result(ended.value())) return ended;
  std::vector<std::string> check{"check"};
  const std::vector<std::string> traces = traces_in(part);
  if (traces.empty()) return ended;
  check.insert(check.end(), traces.begin(), traces.end());
  check.insert(check.end(), {"--json", (part / "verdicts.json").string()});
  ended = run_self(check, {work.time_limit_s + kGrace_s}, Keeps::kOutputAndErrors);
  if (!ended || !is_result(ended.value()) || work.repetitions == 0) return ended;
  return run_self(
      command("time", work,
              {"--repetitions", std::to_string(work.repetitions), "--out", (part / "samples.json").string()}),
      {work.time_limit_s}, Keeps::kOutputAndErrors);
}

enum class Ending { kDone, kBusy, kUnfinished };

core::Result<Ending> run_cell(const fs::path& folder, const ManifestCell& cell) {
  const fs::path final = cell_folder(folder, cell.id);
  const fs::path part = final.string() + ".part";
  const auto lock = CellLock::take(final.string() + ".lock");
  if (!lock) return Ending::kBusy;
  std::error_code failed;
  if (fs::exists(final, failed)) return Ending::kDone;  // finished while we waited for our turn
  fs::remove_all(part, failed);
  fs::create_directories(part, failed);
  if (failed) return core::Error{"cannot write there: " + failed.message(), part.string(), "check the folder"};
  auto ended = record_judge_time(part, cell.work);
  if (!ended) return ended.error();
  if (is_interrupted()) return Ending::kUnfinished;
  if (ended.value().exit_code >= 0 && !is_result(ended.value())) {
    // Bad input and a full disk are not this engine's doing: the cell stays missing and says why.
    fmt::print(stderr, "{} {}: {}\n", cell.id, cell.work.engine, ended.value().words);
    return Ending::kUnfinished;
  }
  if (!is_result(ended.value()))
    if (core::Status s = write_ended_badly(part, cell.work, ended.value()); !s) return s.error();
  fs::rename(part, final, failed);
  if (failed) return core::Error{"cannot rename it: " + failed.message(), part.string(), "check the folder"};
  return Ending::kDone;
}

}  // namespace

core::Result<Selection> Selection::of_shard(const std::string& text) {
  const auto slash = text.find('/');
  Selection selection;
  std::uint32_t number = 0;
  const bool is_read = slash != std::string::npos && read_number(std::string_view(text).substr(0, slash), number) &&
                       read_number(std::string_view(text).substr(slash + 1), selection.shards);
  if (!is_read || number == 0 || number > selection.shards)
    return core::Error{"cannot read '" + text + "'", "--shard", "write i/n with 1 <= i <= n, such as 3/8"};
  selection.shard = number - 1;
  return selection;
}

bool Selection::includes(std::size_t place, const ManifestCell& cell) const {
  return id.empty() ? place % shards == shard : cell.id == id;
}

core::Result<Tally> run_cells(const fs::path& folder, const Selection& selection) {
  auto manifest = read_manifest(folder);
  if (!manifest) return manifest.error();
  if (manifest.value().build != build_line())
    return core::Error{"it was planned by another build: " + manifest.value().build, folder.string(),
                       "use that program, or plan again into another folder"};
  const std::vector<ManifestCell>& cells = manifest.value().cells;
  const bool is_known = selection.id.empty() || std::any_of(cells.begin(), cells.end(), [&](const ManifestCell& c) {
                          return c.id == selection.id;
                        });
  if (!is_known) return core::Error{"there is no cell " + selection.id, folder.string(), "ids stand in manifest.json"};
  std::error_code failed;
  fs::create_directories(folder / "cells", failed);
  if (failed) return core::Error{"cannot write there: " + failed.message(), folder.string(), "check the folder"};

  Tally tally;
  for (std::size_t place = 0; place < cells.size() && !is_interrupted(); ++place) {
    if (!selection.includes(place, cells[place])) continue;
    if (fs::exists(cell_folder(folder, cells[place].id), failed)) {
      ++tally.there;
      continue;
    }
    const auto start = Clock::now();
    auto ending = run_cell(folder, cells[place]);
    if (!ending) return ending.error();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const char* word = ending.value() == Ending::kDone   ? "done"
                       : ending.value() == Ending::kBusy ? "busy"
                                                         : "unfinished";
    fmt::print("{} {}: {} on {}, {:.1f} s\n", cells[place].id, word, cells[place].work.engine, cells[place].work.scene,
               seconds);
    std::fflush(stdout);
    if (ending.value() == Ending::kDone) ++tally.done;
    if (ending.value() == Ending::kBusy) ++tally.busy;
    if (ending.value() == Ending::kUnfinished) ++tally.unfinished;
  }
  return tally;
}

}  // namespace broadside::bench::campaign
