#include "bench/bisect/observer.hpp"

#include <fmt/format.h>

#include <utility>

#include "bench/process/interrupt.hpp"
#include "bench/process/program.hpp"
#include "bench/record/run_plan.hpp"

namespace broadside::bench::bisect {
namespace {

namespace fs = std::filesystem;

constexpr const char* kControl = "control";

// Everything that the answer depends on; a folder with another text belongs to another bisection.
std::string question_text(const Builds& builds, const Question& q) {
  std::string text = q.command + "\n" + (q.made_by.empty() ? "" : "made by: " + q.made_by + "\n");
  text += fmt::format("times: {} {} {} {}\n", q.times.delta, q.times.processes, q.times.most, q.work.frames);
  for (const Build& build : builds.list()) text += build.name + " " + build.identity + "\n";
  return text;
}

// Empties the folder: what an interrupted command left there is not a result.
core::Status empty_folder(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  return prepare_folder(folder);
}

void tell(const std::string& line) {
  fmt::print(stderr, "bisect: {}\n", line);
}

}  // namespace

core::Result<Observer> Observer::begin(Builds& builds, const Question& question) {
  if (core::Status s = prepare_folder(question.folder); !s) return s.error();
  auto state = read_state(question.folder, question_text(builds, question));
  if (!state) return state.error();
  if (!state.value().seen.empty())
    tell(fmt::format("continuing: {} runs are already known", state.value().seen.size()));
  return Observer(builds, question, std::move(state).value());
}

core::Result<Seen> Observer::run(std::size_t k, const fs::path& folder) {
  auto made = builds_.make(k);
  if (!made) return made.error();
  if (!made.value().fault.empty()) return Seen{false, 0, made.value().fault};
  if (core::Status s = empty_folder(folder); !s) return s.error();
  const fs::path out = fs::absolute(folder);
  const fs::path log = out / "command.log";
  const auto code =
      run_in_shell(filled_in(question_.command, made.value().place, out), fs::current_path(), log, question_.work.lock);
  if (!code) return code.error();
  const bool is_skipped = code.value() >= 125 && code.value() <= 127;
  return Seen{!is_skipped, code.value(),
              is_skipped ? fmt::format("the command exits {}{}", code.value(), said_in(log)) : ""};
}

core::Result<Shown<Observation>> Observer::observe(std::size_t k, const std::string& name) {
  const fs::path folder = question_.folder / "builds" / name;
  if (!state_.seen.contains(name)) {
    auto seen = run(k, folder);
    if (!seen) return seen.error();
    state_.seen[name] = std::move(seen).value();
    if (core::Status s = write_state(question_.folder, state_); !s) return s.error();
    const Seen& now = state_.seen[name];
    tell(name == kControl ? "the good build a second time: done"
                          : builds_.list()[k].title + ": " + (now.is_judged ? "done" : now.reason));
  }
  const Seen& seen = state_.seen[name];
  if (!seen.is_judged) return Shown<Observation>{nullptr, seen.reason};
  if (!observations_.contains(name)) {
    auto observation = read_observation(folder, seen.exit_code);
    if (!observation) return observation.error();
    observations_.emplace(name, std::move(observation).value());
  }
  return Shown<Observation>{&observations_.at(name), {}};
}

core::Result<Shown<Observation>> Observer::look(std::size_t k) {
  return observe(k, builds_.list()[k].name);
}

core::Result<Shown<Observation>> Observer::control() {
  return observe(0, kControl);
}

core::Result<Seen> Observer::time(std::size_t k, const fs::path& folder) {
  auto good = builds_.make(0);
  if (!good) return good.error();
  auto build = builds_.make(k);
  if (!build) return build.error();
  for (const auto* made : {&good.value(), &build.value()})
    if (!made->fault.empty()) return Seen{false, 0, made->fault};
  if (core::Status s = empty_folder(folder); !s) return s.error();
  const auto times = measure_times(question_.work, question_.times, good.value().place, build.value().place, folder);
  // Any other error concerns this build alone, and the search goes on without it.
  if (!times && (is_interrupted() || times.error().exit == core::Exit::kBadInput)) return times.error();
  if (!times) return Seen{false, 0, times.error().line()};
  return Seen{true, 0, {}};
}

core::Result<Shown<std::vector<reports::TimeRatio>>> Observer::times(std::size_t k) {
  using Times = std::vector<reports::TimeRatio>;
  const Build& build = builds_.list()[k];
  const fs::path folder = question_.folder / "times" / build.name;
  if (!state_.timed.contains(build.name)) {
    auto seen = time(k, folder);
    if (!seen) return seen.error();
    state_.timed[build.name] = std::move(seen).value();
    if (core::Status s = write_state(question_.folder, state_); !s) return s.error();
    const Seen& now = state_.timed[build.name];
    tell(build.title + ": " + (now.is_judged ? "timed" : now.reason));
  }
  const Seen& seen = state_.timed[build.name];
  if (!seen.is_judged) return Shown<Times>{nullptr, seen.reason};
  if (!times_.contains(k)) {
    auto times = read_times(question_.times, folder);
    if (!times) return times.error();
    times_[k] = std::move(times).value();
  }
  return Shown<Times>{&times_.at(k), {}};
}

std::vector<std::string> Observer::skipped() const {
  std::vector<std::string> lines;
  for (const Build& build : builds_.list())
    for (const auto* all : {&state_.seen, &state_.timed})
      if (const auto found = all->find(build.name); found != all->end() && !found->second.is_judged)
        lines.push_back(build.title + ": " + found->second.reason);
  return lines;
}

}  // namespace broadside::bench::bisect
