#include "bench/campaign/run_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>
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

// A cell that was judged good, judged bad, or is incomplete is a result. Other exit codes are bad input or a full disk.
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
  // Each part has the full limit. Recording ends a hanging engine itself, and that is a result. This limit is longer,
  // for a harness that hangs itself.
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

// What the threads that do the groups of a manifest share: each thread takes the next group until there is none.
class Workers {
 public:
  Workers(const fs::path& folder, const Manifest& manifest, const Selection& selection, const TellGroup& tell,
          OpenJob* job)
      : folder_(folder),
        manifest_(manifest),
        selection_(selection),
        tell_(tell),
        job_(job),
        groups_(groups_of(manifest)),
        order_(groups_.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    if (job_ == nullptr) return;
    std::vector<double> ranks(groups_.size());
    for (std::size_t place = 0; place < groups_.size(); ++place)
      ranks[place] = job_->rank_of(first_of(place), groups_[place].size());
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return ranks[a] < ranks[b]; });
  }

  // Does groups until none is left, an interrupt arrives, or any thread has an error.
  void work() {
    for (std::size_t k = next_++; k < order_.size() && !is_interrupted() && !has_failed_; k = next_++)
      if (selection_.includes(order_[k], groups_[order_[k]])) do_group(order_[k]);
  }

  [[nodiscard]] core::Result<Tally> result() const {
    return error_ ? core::Result<Tally>(*error_) : core::Result<Tally>(tally_);
  }

 private:
  void do_group(std::size_t place) {
    const std::span<const ManifestCell> group = groups_[place];
    const std::size_t first = first_of(place);
    const auto lock = CellLock::take(folder_ / "cells" / (group.front().turns + ".lock"));
    // Counted after taking the lock, so that cells that another process finished meanwhile are counted.
    const std::uint32_t before = finished(group);
    const auto missing = static_cast<std::uint32_t>(group.size()) - before;
    Tally own;
    own.there = before;
    if (missing == 0) return add(own, nullptr);
    if (!lock) {
      own.busy = missing;
      const GroupEnd end{group, "busy", 0.0, first};
      return add(own, &end);
    }
    const auto start = Clock::now();
    const core::Status ended = job_ != nullptr ? job_->do_group(first, group.size()) : run_cell(folder_, group.front());
    if (!ended) return fail(ended.error());
    own.done = finished(group) - before;
    own.unfinished = missing - own.done;
    const GroupEnd end{group, own.done == missing ? "done" : "unfinished",
                       std::chrono::duration<double>(Clock::now() - start).count(), first};
    add(own, &end);
  }

  void add(const Tally& own, const GroupEnd* end) {
    const std::lock_guard guard(mutex_);
    tally_.done += own.done;
    tally_.there += own.there;
    tally_.busy += own.busy;
    tally_.unfinished += own.unfinished;
    if (end != nullptr) tell_(*end);
  }

  void fail(const core::Error& error) {
    const std::lock_guard guard(mutex_);
    if (!error_) error_ = error;
    has_failed_ = true;
  }

  [[nodiscard]] std::size_t first_of(std::size_t place) const {
    return static_cast<std::size_t>(groups_[place].data() - manifest_.cells.data());
  }

  [[nodiscard]] std::uint32_t finished(std::span<const ManifestCell> cells) const {
    return static_cast<std::uint32_t>(std::count_if(cells.begin(), cells.end(), [this](const ManifestCell& c) {
      std::error_code ignored;
      return fs::exists(cell_folder(folder_, c.id), ignored);
    }));
  }

  const fs::path& folder_;
  const Manifest& manifest_;
  const Selection& selection_;
  const TellGroup& tell_;
  OpenJob* job_;
  std::vector<std::span<const ManifestCell>> groups_;
  std::vector<std::size_t> order_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> has_failed_ = false;
  std::mutex mutex_;  // guards what follows, and tell_
  Tally tally_;
  std::optional<core::Error> error_;
};

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

core::Result<Tally> run_cells(const fs::path& folder, const Selection& selection, const TellGroup& tell,
                              std::uint32_t at_once) {
  auto read = read_manifest(folder);
  if (!read) return read.error();
  const Manifest& manifest = read.value();
  if (manifest.build != build_line())
    return core::Error{"it was planned by another build: " + manifest.build, folder.string(),
                       "use that program, or plan again into another folder"};
  const bool is_known =
      selection.id.empty() || std::any_of(manifest.cells.begin(), manifest.cells.end(),
                                          [&](const ManifestCell& c) { return c.id == selection.id; });
  if (!is_known) return core::Error{"there is no cell " + selection.id, folder.string(), "manifest.json lists the ids"};
  std::error_code failed;
  fs::create_directories(folder / "cells", failed);
  if (failed) return core::Error{"cannot write there: " + failed.message(), folder.string(), "check the folder"};
  std::unique_ptr<OpenJob> job;
  if (manifest.job) {
    auto opened = manifest.job->open(manifest.cells, folder);
    if (!opened) return opened.error();
    job = std::move(opened).value();
  }

  Workers workers(folder, manifest, selection, tell, job.get());
  // A cell is done by child processes, and its thread waits for them, so each cell in work has a thread.
  std::vector<std::thread> threads;
  for (std::uint32_t k = 1; k < at_once && !job; ++k) threads.emplace_back([&workers] { workers.work(); });
  workers.work();
  for (std::thread& thread : threads) thread.join();
  return workers.result();
}

}  // namespace broadside::bench::campaign
