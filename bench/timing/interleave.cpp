#include "bench/timing/interleave.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "bench/process/interrupt.hpp"
#include "bench/process/program.hpp"
#include "bench/process/progress.hpp"
#include "bench/record/run_plan.hpp"

namespace broadside::bench {
namespace {

using Arguments = std::vector<std::string>;

core::Error interrupted_error() {
  return {"interrupted: times of pairs that did not end are dropped", "compare", "", core::Exit::kMissing};
}

// One of the two programs: its folder, with one folder per scene in it.
class Side {
 public:
  Side(const InterleavePlan& plan, std::string program, std::filesystem::path folder)
      : plan_(plan), program_(std::move(program)), folder_(std::move(folder)) {}

  // Records and judges a scene: its times are admitted only with this proof.
  core::Status prove(std::size_t scene) {
    const std::filesystem::path at = scene_folder(scene);
    if (core::Status s = prepare_folder(at); !s) return s;
    Arguments run{"run", plan_.scenes[scene], "--out", at.string()};
    add_common(run);
    // A cell that could not be recorded is a row that says so.
    if (core::Status s = call(run, at / "run.log", {0, 3}); !s) return s;
    Arguments check{"check", "--json", (at / "verdicts.json").string()};
    auto rows = core::read_rows(at);
    if (!rows) return rows.error();
    for (const core::Cell& cell : rows.value().cells)
      if (cell.state == core::CellState::kRecorded && !cell.trace_file.empty())
        check.push_back((at / cell.trace_file).string());
    if (check.size() == 3) return core::Done{};
    return call(check, at / "check.log", {0, 1, 3});
  }

  // Whether `time` of this program knows --turns; older programs do not.
  core::Result<bool> takes_turns() {
    const std::filesystem::path log = folder_ / "help.log";
    if (core::Status s = prepare_folder(folder_); !s) return s.error();
    if (core::Status s = call({"time", "--help"}, log, {0}); !s) return s.error();
    std::ifstream in(log);
    const std::string help{std::istreambuf_iterator<char>(in), {}};
    return help.find("--turns") != std::string::npos;
  }

  // Starts a timed process, alone or as one side of `turns` over the descriptor.
  core::Result<RunningProgram> start_timing(std::size_t scene, const std::string& turns = {}, int descriptor = -1) {
    const std::filesystem::path at = scene_folder(scene);
    Arguments arguments{"time",  plan_.scenes[scene],      "--repetitions", std::to_string(plan_.repetitions),
                        "--out", (at / kPairFile).string()};
    add_common(arguments);
    if (!turns.empty()) arguments.insert(arguments.end(), {"--turns", turns});
    return RunningProgram::start(program_, arguments, at / "time.log", descriptor);
  }

  // Waits for the process and keeps its samples under the number of the pair.
  core::Status keep_timing(RunningProgram& timing, std::size_t scene, std::uint64_t pair) {
    const std::filesystem::path at = scene_folder(scene);
    const std::filesystem::path file = at / kPairFile;
    if (core::Status s = judge_ending("time", timing.wait(), at / "time.log", {0, 3}); !s) return s;
    auto samples = core::read_samples(file);
    if (!samples) return samples.error();
    for (core::Sample& sample : samples.value()) {
      sample.process = pair;
      samples_[scene].push_back(std::move(sample));
    }
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    return core::Done{};
  }

  // All rows of this side, and the files that hold them.
  core::Result<core::RunRows> rows() {
    core::RunRows all;
    for (std::size_t k = 0; k < plan_.scenes.size(); ++k) {
      if (core::Status s = core::write_samples(scene_folder(k) / "samples.json", samples_[k]); !s) return s.error();
      auto rows = core::read_rows(scene_folder(k));
      if (!rows) return rows.error();
      const auto append = [](auto& to, auto& from) {
        to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
      };
      append(all.cells, rows.value().cells);
      append(all.verdicts, rows.value().verdicts);
      append(all.samples, rows.value().samples);
    }
    if (core::Status s = core::write_cells(folder_ / "cells.json", all.cells); !s) return s.error();
    if (core::Status s = core::write_verdicts(folder_ / "verdicts.json", all.verdicts); !s) return s.error();
    if (core::Status s = core::write_samples(folder_ / "samples.json", all.samples); !s) return s.error();
    return all;
  }

  void begin() { samples_.resize(plan_.scenes.size()); }

  // The scene's name, from its first sample; empty before there is one.
  [[nodiscard]] std::string scene_name(std::size_t scene) const {
    return samples_[scene].empty() ? std::string() : samples_[scene].front().stamp.scene_name;
  }

 private:
  [[nodiscard]] std::filesystem::path scene_folder(std::size_t scene) const {
    return folder_ / ("scene-" + std::to_string(scene + 1));
  }

  void add_common(Arguments& arguments) const {
    for (const std::string& engine : plan_.engines) arguments.insert(arguments.end(), {"--engine", engine});
    if (plan_.frames > 0) arguments.insert(arguments.end(), {"--frames", std::to_string(plan_.frames)});
    if (plan_.allow_stand_in) arguments.emplace_back("--stand-in");
  }

  core::Status call(const Arguments& arguments, const std::filesystem::path& log, const std::vector<int>& good) const {
    return judge_ending(arguments[0], run_program(program_, arguments, log), log, good);
  }

  core::Status judge_ending(const std::string& command, const core::Result<int>& code, const std::filesystem::path& log,
                            const std::vector<int>& good) const {
    if (!code) return code.error();
    if (is_interrupted()) return interrupted_error();
    if (std::find(good.begin(), good.end(), code.value()) != good.end()) return core::Done{};
    return core::Error{"'" + command + "' exits " + std::to_string(code.value()) + ": " + last_line(log), program_,
                       "see " + log.string(), code.value() == 2 ? core::Exit::kBadInput : core::Exit::kMissing};
  }

  static constexpr const char* kPairFile = "pair.json";  // of the running process, in its scene's folder

  const InterleavePlan& plan_;
  std::string program_;
  std::filesystem::path folder_;
  std::vector<std::vector<core::Sample>> samples_;
};

using Sides = std::array<Side, 2>;

// The cores that this process may use.
std::vector<int> own_cores() {
  std::vector<int> cores;
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return {-1};
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(static_cast<std::size_t>(core), &set)) cores.push_back(core);
  return cores;
}

// One process after the other.
core::Status time_one_by_one(std::array<Side*, 2> order, std::size_t scene, std::uint64_t pair) {
  for (Side* side : order) {
    auto timing = side->start_timing(scene);
    if (!timing) return timing.error();
    if (core::Status s = side->keep_timing(timing.value(), scene, pair); !s) return s;
  }
  return core::Done{};
}

// Starts both processes at once; each works while the other waits.
core::Status time_in_turns(std::array<Side*, 2> order, std::size_t scene, std::uint64_t pair, int core) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return core::Error{"two processes cannot be connected: " + std::generic_category().message(errno), "compare", "",
                       core::Exit::kInternal};
  constexpr std::array kRoles{"first", "second"};
  std::vector<core::Result<RunningProgram>> timings;
  for (const std::size_t k : {0U, 1U}) {
    const std::string turns = std::string(kRoles[k]) + ":" + std::to_string(ends[k]) + ":" + std::to_string(core);
    timings.push_back(order[k]->start_timing(scene, turns, ends[k]));
  }
  // This process closes its own ends, so that when one process ends, the other sees the connection end.
  for (const int end : ends) close(end);
  core::Status status = core::Done{};
  for (const std::size_t k : {0U, 1U}) {
    core::Status own = timings[k] ? order[k]->keep_timing(timings[k].value(), scene, pair) : timings[k].error();
    if (status && !own) status = std::move(own);
  }
  return status;
}

}  // namespace

std::uint32_t looks_of(const InterleavePlan& plan) {
  std::uint32_t looks = 1;
  for (std::uint64_t pairs = plan.processes; pairs < plan.most; pairs *= 2) ++looks;
  return looks;
}

core::Result<InterleavedRows> run_interleaved(const InterleavePlan& plan, const Untold& untold) {
  if (core::Status s = prepare_folder(plan.folder); !s) return s.error();
  Sides sides{Side(plan, plan.base, plan.folder / "base"), Side(plan, plan.head, plan.folder / "head")};
  for (Side& side : sides) side.begin();
  bool takes_turns = true;
  for (Side& side : sides) {
    const auto takes = side.takes_turns();
    if (!takes) return takes.error();
    takes_turns = takes_turns && takes.value();
  }
  if (!takes_turns)
    fmt::print(stderr,
               "broadside: compare: one of the programs cannot take turns: whole processes run one after the other\n");
  const std::vector<int> cores = own_cores();
  Progress proof("proving", 2 * plan.scenes.size());
  std::vector<std::size_t> scenes;  // scenes that are timed in this round
  for (std::size_t scene = 0; scene < plan.scenes.size(); ++scene) {
    for (Side& side : sides)
      if (core::Status s = side.prove(scene); !s) return s.error();
    scenes.push_back(scene);
    proof.at(2 * scenes.size());
  }
  std::uint64_t pairs = 0;
  for (std::uint64_t until = plan.processes;; until = std::min<std::uint64_t>(2 * until, plan.most)) {
    Progress progress("comparing", 2 * scenes.size() * (until - pairs));
    std::uint64_t done = 0;
    while (pairs < until) {
      ++pairs;
      const bool is_base_first = pairs % 2 == 1;
      const std::array<Side*, 2> order{&sides[is_base_first ? 0 : 1], &sides[is_base_first ? 1 : 0]};
      for (const std::size_t scene : scenes) {
        // Two pairs run on a core, one in each order, before the next core.
        const core::Status s = takes_turns ? time_in_turns(order, scene, pairs, cores[(pairs - 1) / 2 % cores.size()])
                                           : time_one_by_one(order, scene, pairs);
        if (!s) return s.error();
        progress.at(done += 2);
      }
    }
    auto base = sides[0].rows();
    if (!base) return base.error();
    auto head = sides[1].rows();
    if (!head) return head.error();
    InterleavedRows rows{std::move(base).value(), std::move(head).value()};
    if (until >= plan.most) return rows;
    const std::set<std::string> names = untold(rows);
    std::erase_if(scenes, [&](std::size_t scene) { return !names.contains(sides[0].scene_name(scene)); });
    if (scenes.empty()) return rows;
  }
}

core::Result<std::vector<core::Sample>> time_in_processes(const Arguments& arguments, std::uint32_t processes,
                                                          const std::filesystem::path& folder) {
  std::vector<core::Sample> all;
  Progress progress("timing in processes", processes);
  const std::filesystem::path file = folder / "process.json";
  const std::filesystem::path log = folder / "process.log";
  for (std::uint32_t k = 0; k < processes; ++k) {
    Arguments own{"time"};
    own.insert(own.end(), arguments.begin(), arguments.end());
    own.insert(own.end(), {"--out", file.string()});
    auto code = run_program("/proc/self/exe", own, log);
    if (!code) return code.error();
    if (is_interrupted()) return core::Error{"interrupted: no time is kept", "time", "", core::Exit::kMissing};
    if (code.value() != 0 && code.value() != 3)
      return core::Error{last_line(log), "", "", code.value() == 2 ? core::Exit::kBadInput : core::Exit::kInternal};
    auto samples = core::read_samples(file);
    if (!samples) return samples.error();
    for (core::Sample& sample : samples.value()) all.push_back(std::move(sample));
    progress.at(k + 1);
  }
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  std::filesystem::remove(log, ignored);
  return all;
}

}  // namespace broadside::bench
