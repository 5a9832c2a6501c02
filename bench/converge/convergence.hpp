// Errors against a closed form at h, h/2 and h/4: the order that they show, and whether it is the declared one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/verdict.hpp"

namespace broadside::bench {

// One figure of the answer. Each list has one entry for each step size, the longest step first.
struct FigureErrors {
  std::string what;
  std::string unit;
  std::vector<double> error;  // the largest error at times that all runs have
  std::vector<double> limit;  // the limit of that error
  double floor = 0.0;         // what does not fall with h: the floor of the error at the shortest step
  double share = 0.0;         // the largest ratio of an error to its limit, over all runs
  bool has_order = true;
  bool is_first_order = false;
};

struct Convergence {
  double declared_order = 1.0;
  std::vector<double> dt_s;
  std::vector<FigureErrors> figures;
};

// The order that two neighboring step sizes show; NaN where an error is zero.
double observed_order(const FigureErrors& figure, std::size_t finer);

// Fails when a figure that has an order falls more slowly, over all step sizes, than h^(p - 1/2), half way to the next
// lower order, and does not end at its floor. Also fails when a figure without an order breaks its limit at any step
// size. Inconclusive when the answer has no figures. measured: the lowest order; limit: the order that it had to have.
core::Verdict judge_convergence(const Convergence& convergence);

// Reads the traces of one scene over the same time; each step is half of the one before.
core::Result<Convergence> measure_convergence(const std::vector<std::filesystem::path>& traces);

}  // namespace broadside::bench
