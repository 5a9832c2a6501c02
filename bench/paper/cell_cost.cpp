#include "bench/paper/cell_cost.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "bench/timing/timing.hpp"

namespace broadside::bench::paper {
namespace {

// Costs that depend on the size of the mesh, in seconds: making the scene once for the plan and once for its cells,
// loading it into an engine, writing its trace, starting to judge the trace, and judging a frame of fifty bodies.
struct ModelCost {
  std::string_view model;
  double scene_s;
  double load_s;
  double trace_s;
  double judge_s;
  double judged_frame_s;
};
constexpr std::array<ModelCost, 4> kModelCosts{{
    {"bunny", 0.02, 0.005, 0.06, 0.02, 0.001},
    {"armadillo", 0.15, 0.03, 0.12, 0.10, 0.004},
    {"dragon", 0.18, 0.03, 0.13, 0.12, 0.004},
    {"asian_dragon", 1.6, 0.30, 0.60, 0.80, 0.03},
}};

// Costs of a frame, on two cores and on the GPU: for every pair of bodies, and for every body.
struct MethodCost {
  std::string_view method;
  double pair_s;
  double pair_gpu_s;
};
constexpr std::array<MethodCost, 4> kMethodCosts{{
    {"A", 4e-7, 3e-9},
    {"level 2", 4e-7, 3e-9},
    {"B", 1e-7, 5e-11},
    {"level 1", 1e-7, 5e-11},
}};
constexpr double kBody_s = 2e-6;
constexpr double kFrame_s = 5e-5;
constexpr double kBodyGpu_s = 1e-8;
constexpr double kFrameGpu_s = 8e-5;

const ModelCost& model_cost(std::string_view model) {
  const auto* row =
      std::find_if(kModelCosts.begin(), kModelCosts.end(), [&](const ModelCost& m) { return m.model == model; });
  return row == kModelCosts.end() ? kModelCosts.front() : *row;
}

double frame_seconds(const PaperCell& cell) {
  const double pairs = 0.5 * cell.count * (cell.count - 1.0);
  const bool is_gpu = cell.engine.find("-gpu") != std::string::npos;
  double seconds = is_gpu ? kFrameGpu_s + kBodyGpu_s * cell.count : kFrame_s + kBody_s * cell.count;
  for (const MethodCost& m : kMethodCosts)
    if (m.method == cell.method) seconds += pairs * (is_gpu ? m.pair_gpu_s : m.pair_s);
  return seconds;
}

}  // namespace

double expected_seconds(const PaperCell& cell, std::uint32_t runs) {
  if (!cell.left_out.empty()) return 0.0;
  const ModelCost& model = model_cost(cell.model);
  const auto frames = static_cast<double>(cell.frames);
  double loads = 1.0;
  double timed_frames = 0.0;
  if (cell.is_timed) loads += 1.0 + runs, timed_frames += static_cast<double>(kWarmUpFrames) + frames * runs;
  if (cell.wants_memory) loads += runs, timed_frames += frames * runs;
  const double judged = frames / cell.every * model.judged_frame_s * cell.count / 50.0;
  // In the tables five cells share a scene, so each is charged a fifth. Elsewhere two cells do, and the error is small.
  return 0.2 * model.scene_s + loads * model.load_s + model.trace_s + model.judge_s + judged +
         (frames + timed_frames) * frame_seconds(cell);
}

double rank_of(std::span<const PaperCell> group, std::uint32_t runs) {
  constexpr double kBeyond = 1e9;
  double seconds = 0.0;
  for (const PaperCell& cell : group) {
    if (std::find(cell.experiments.begin(), cell.experiments.end(), "beyond") != cell.experiments.end())
      return kBeyond + cell.count;
    seconds += expected_seconds(cell, runs);
  }
  return seconds;
}

}  // namespace broadside::bench::paper
