// Runs the command on builds, once on each, and keeps the results in the folder of the bisection.
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
  std::string made_by;  // how a commit is built, and where the program is in it; empty: the builds are given
  std::vector<Quantity> quantities;
  TimedWork work;
  TimeSettings times;
  std::filesystem::path folder;
};

// The result of one build, or why it has none.
template <typename T>
struct Shown {
  const T* what = nullptr;  // valid while the observer lives
  std::string reason;       // "does not build: ..."; empty when there is a result
};

class Observer {
 public:
  // Takes over the results that the folder already holds for the same question about the same builds.
  static core::Result<Observer> begin(Builds& builds, const Question& question);

  // Makes build k and runs the command on it, or reads the results of an earlier run. Exit codes 125, 126 and 127 of
  // the command skip the build, as in 'git bisect run'. Errors: interrupted; a folder or a file that cannot be written.
  core::Result<Shown<Observation>> look(std::size_t k);

  // Observes the good build a second time.
  core::Result<Shown<Observation>> control();

  // Times of build k against those of the good one.
  core::Result<Shown<std::vector<reports::TimeRatio>>> times(std::size_t k);

  // Builds that were observed and could not be judged, one line for each.
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
