#include "bench/campaign/run_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <memory>
#include <numeric>
#include <string_view>
#include <system_error>
#include <vector>

#include "bench/build_facts.hpp"
#include "bench/campaign/cell_lock.hpp"
#include "bench/campaign/job.hpp"
#include "bench/process/child.hpp"
#include "bench/process/interrupt.hpp"
#include "core/rows.hpp"

namespace broadside::bench::campaign {
namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

bool read_number(std::string_view text, std::uint32_t& out) {
  const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), out);
  return bad == std::errc() && end == text.data() + text.size();
}

std::vector<std::string> command(std::string name, const CellWork& work, std::initializer_list<std::string> rest) {
  std::vector<std::string> arguments{std::move(name), work.scene, "--engine", work.engine};
  if (work.frames > 0) arguments.insert(arguments.end(), {"--frames", std::to_string(work.frames)});
  if (work.stand_in) arguments.emplace_back("--stand-in");
  arguments.insert(arguments.end(), rest);
  return arguments;
}

// Judged good, judged bad, or incomplete: all three are results. Other exit codes are bad input or a full disk.
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

// The trace of this engine, among those of the rows; empty when there is none.
std::string trace_of(const fs::path& folder, const std::string& engine) {
  const auto rows = core::read_rows(folder);
  if (engine.empty() || !rows) return "";
  for (const core::Cell& cell : rows.value().cells)
    if (cell.stamp.label() == engine && !cell.trace_file.empty()) return (folder / cell.trace_file).string();
  return "";
}

// A crash or time-out of the child process, written as the cell's row, because it is the cell's result.
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

// How the last part of a cell ended, or the first part that gave no result.
core::Result<ChildEnding> record_judge_time(const fs::path& part, const CellWork& work) {
  // Each part has the full limit. Recording ends a hanging engine itself, and that is a result; only a harness that
  // hangs too is ended from here.
  constexpr double kGrace_s = 30.0;
  const std::string limit = fmt::format("{}", work.time_limit_s);
  std::vector<std::string> record = command("run", work, {"--out", part.string(), "--time-limit", limit});
  if (!work.against.empty() && work.against != work.engine) record.insert(record.end(), {"--engine", work.against});
  auto ended = run_self(record, {work.time_limit_s + kGrace_s}, Keeps::kOutputAndErrors);
  if (!ended || !is_result(ended.value())) return ended;
  std::vector<std::string> check{"check"};
  const std::vector<std::string> traces = traces_in(part);
  if (traces.empty()) return ended;
  check.insert(check.end(), traces.begin(), traces.end());
  check.insert(check.end(), {"--json", (part / "verdicts.json").string()});
  if (const std::string baseline = trace_of(part, work.against); !baseline.empty())
    check.insert(check.end(), {"--against", baseline});
  ended = run_self(check, {work.time_limit_s + kGrace_s}, Keeps::kOutputAndErrors);
  if (!ended || !is_result(ended.value()) || work.repetitions == 0) return ended;
  return run_self(command("time", work,
                          {"--repetitions", std::to_string(work.repetitions), "--processes",
                           std::to_string(work.processes), "--out", (part / "samples.json").string()}),
                  {work.time_limit_s}, Keeps::kOutputAndErrors);
}

// Done when its folder exists; bad input, a full disk or an interrupt leave the cell unfinished.
core::Status run_cell(const fs::path& folder, const ManifestCell& cell) {
  const fs::path final = cell_folder(folder, cell.id);
  const fs::path part = final.string() + ".part";
  std::error_code failed;
  fs::remove_all(part, failed);
  fs::create_directories(part, failed);
  if (failed) return core::Error{"cannot write there: " + failed.message(), part.string(), "check the folder"};
  auto ended = record_judge_time(part, cell.work);
  if (!ended) return ended.error();
  if (is_interrupted()) return core::Done{};
  if (ended.value().exit_code >= 0 && !is_result(ended.value())) {
    // Bad input and a full disk say nothing about the engine: the cell stays missing, with the reason.
    fmt::print(stderr, "{} {}: {}\n", cell.id, cell.work.engine, ended.value().words);
    return core::Done{};
  }
  if (!is_result(ended.value()))
    if (core::Status s = write_ended_badly(part, cell.work, ended.value()); !s) return s.error();
  fs::rename(part, final, failed);
  if (failed) return core::Error{"cannot rename it: " + failed.message(), part.string(), "check the folder"};
  return core::Done{};
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

bool Selection::includes(std::size_t place, std::span<const ManifestCell> group) const {
  if (id.empty()) return place % shards == shard;
  return std::any_of(group.begin(), group.end(), [&](const ManifestCell& c) { return c.id == id; });
}

core::Result<Tally> run_cells(const fs::path& folder, const Selection& selection, const TellGroup& tell) {
  auto read = read_manifest(folder);
  if (!read) return read.error();
  const Manifest& manifest = read.value();
  if (manifest.build != build_line())
    return core::Error{"it was planned by another build: " + manifest.build, folder.string(),
                       "use that program, or plan again into another folder"};
  const bool is_known =
      selection.id.empty() || std::any_of(manifest.cells.begin(), manifest.cells.end(),
                                          [&](const ManifestCell& c) { return c.id == selection.id; });
  if (!is_known) return core::Error{"there is no cell " + selection.id, folder.string(), "ids stand in manifest.json"};
  std::error_code failed;
  fs::create_directories(folder / "cells", failed);
  if (failed) return core::Error{"cannot write there: " + failed.message(), folder.string(), "check the folder"};
  std::unique_ptr<OpenJob> job;
  if (manifest.job) {
    auto opened = manifest.job->open(manifest.cells, folder);
    if (!opened) return opened.error();
    job = std::move(opened).value();
  }

  const auto finished = [&](std::span<const ManifestCell> cells) {
    return static_cast<std::uint32_t>(std::count_if(cells.begin(), cells.end(), [&](const ManifestCell& c) {
      std::error_code ignored;
      return fs::exists(cell_folder(folder, c.id), ignored);
    }));
  };
  Tally tally;
  const auto groups = groups_of(manifest);
  const auto first_of = [&](std::size_t place) {
    return static_cast<std::size_t>(groups[place].data() - manifest.cells.data());
  };
  std::vector<std::size_t> order(groups.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (job) {
    std::vector<double> ranks(groups.size());
    for (std::size_t place = 0; place < groups.size(); ++place)
      ranks[place] = job->rank_of(first_of(place), groups[place].size());
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ranks[a] < ranks[b]; });
  }
  for (const std::size_t place : order) {
    if (is_interrupted()) break;
    const std::span<const ManifestCell> group = groups[place];
    if (!selection.includes(place, group)) continue;
    const std::size_t first = first_of(place);
    const auto lock = CellLock::take(folder / "cells" / (group.front().turns + ".lock"));
    // Counted after taking the lock, so that cells which another process finished meanwhile are counted.
    const std::uint32_t before = finished(group);
    const auto missing = static_cast<std::uint32_t>(group.size()) - before;
    tally.there += before;
    if (missing == 0) continue;
    const auto start = Clock::now();
    if (!lock) {
      tally.busy += missing;
      tell({group, "busy", 0.0, first});
      continue;
    }
    const core::Status ended = job ? job->do_group(first, group.size()) : run_cell(folder, group.front());
    if (!ended) return ended.error();
    const std::uint32_t done = finished(group) - before;
    tally.done += done;
    tally.unfinished += missing - done;
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    tell({group, done == missing ? "done" : "unfinished", seconds, first});
  }
  return tally;
}

}  // namespace broadside::bench::campaign
