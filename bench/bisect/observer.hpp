// Runs the command on builds, each once, and keeps what it saw in the folder of the bisection.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/bisect/builds.hpp"
#include "bench/bisect/observation.hpp"
#include "bench/bisect/state_file.hpp"
#include "bench/bisect/time_gate.hpp"
#include "core/result.hpp"
#include "reports/time_ratio.hpp"

namespace broadside::bench::bisect {

struct Question {
  std::string command;  // with {build} or {program}, and {out}
  std::string made_by;  // what builds a commit, and where the program is in it; empty: builds are given
  std::vector<Quantity> quantities;
  TimedWork work;
  TimeSettings times;
  std::filesystem::path folder;
};

// What one build shows, or why it shows nothing.
template <typename T>
struct Shown {
  const T* what = nullptr;  // valid as long as the observer
  std::string reason;       // "does not build: ..."; empty when it is shown
};

class Observer {
 public:
  // Takes up what the folder holds already of the same question about the same builds.
  static core::Result<Observer> begin(Builds& builds, const Question& question);

  // Builds k and runs the command on it, or reads what that left earlier. Exit codes 125, 126 and 127 of the command
  // skip the build, as 'git bisect run' has it. Errors: interrupted; a folder or a file that cannot be written.
  core::Result<Shown<Observation>> look(std::size_t k);

  // Of the good build a second time.
  core::Result<Shown<Observation>> control();

  // Times of build k against those of the good one.
  core::Result<Shown<std::vector<reports::TimeRatio>>> times(std::size_t k);

  // Builds that were looked at and could not be judged, each in a line.
  [[nodiscard]] std::vector<std::string> skipped() const;

 private:
  Observer(Builds& builds, const Question& question, State state)
      : builds_(builds), question_(question), state_(std::move(state)) {}

  core::Result<Shown<Observation>> observe(std::size_t k, const std::string& name);
  core::Result<Seen> run(std::size_t k, const std::filesystem::path& folder);
  core::Result<Seen> time(std::size_t k, const std::filesystem::path& folder);

  Builds& builds_;
  const Question& question_;
  State state_;
  std::map<std::string, Observation> observations_;
  std::map<std::size_t, std::vector<reports::TimeRatio>> times_;
};

}  // namespace broadside::bench::bisect
