// Errors against a closed form at h, h/2 and h/4: the order that they show, and whether it is the declared one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/verdict.hpp"

namespace broadside::bench {

// One figure of the answer. Each list has one entry a step size, the longest step first.
struct FigureErrors {
  std::string what;
  std::string unit;
  std::vector<double> error;  // the largest at times that all runs have
  std::vector<double> limit;  // where that error is
  double floor = 0.0;         // of the error at the shortest step: what does not fall with h
  double share = 0.0;         // the largest error over its limit, of all runs
  bool has_order = true;
  bool is_first_order = false;
};

struct Convergence {
  double declared_order = 1.0;
  std::vector<double> dt_s;
  std::vector<FigureErrors> figures;
};

// Observed between two neighboring step sizes; NaN where an error is zero.
double observed_order(const FigureErrors& figure, std::size_t finer);

// Fails when a figure with an order falls more slowly than h^(p - 1/2), half way to the next lower order, over all step
// sizes and does not end at its floor; or when one without an order breaks its limit at any step size. Inconclusive
// when the answer has no figures. measured: the lowest order; limit: what it had to be.
core::Verdict judge_convergence(const Convergence& convergence);

// The traces of one scene at falling steps, each half of the one before, over the same time.
core::Result<Convergence> measure_convergence(const std::vector<std::filesystem::path>& traces);

}  // namespace broadside::bench
