#include "bench/paper/beyond_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "datasets/published/published_figures.hpp"

namespace broadside::bench::paper {
namespace {

constexpr std::array<std::uint32_t, 5> kFactors{1, 3, 10, 30, 100};
// The same first frames at every count. The number of pairs grows while bodies leave their first places, so different
// frames would be different work, and at the largest counts only a few frames can be run.
constexpr std::uint32_t kMostFrames = 20;

// Box tests a second that a cell is expected to do. Used only to decide whether a cell is tried; measured once for
// level A (0.2 ns a test on two cores; 183 million in 138 us on an H100) and rounded down.
constexpr double kTestsPerSecondCpu = 3e9;
constexpr double kTestsPerSecondGpu = 1e12;

struct Method {
  std::string_view name;
  std::string_view settings;  // of the octree engine
  double tests_a_pair;        // tests for each pair of bodies with the published start; 0 = not brute force
};
constexpr std::array<Method, 5> kOctreeMethods{{
    {"tree", "", 0.0},
    {"flat", "[broad=brute,levels=flat]", 1.0},
    {"A", "[broad=brute,levels=A]", 4096.0},
    {"B", "[broad=brute,levels=B]", 64.0},
    {"C", "[broad=brute,levels=C]", 1.0},
}};
constexpr std::array<std::string_view, 5> kBroadPhases{"bullet-dbvt", "bullet-sap", "fcl-tree", "fcl-sap", "all-pairs"};

std::string why_left_out(const PaperCell& cell, double tests_a_pair, const PlanOptions& options, const Device& device) {
  const double pairs = 0.5 * cell.count * (cell.count - 1.0);
  const double rate = device.octree == "octree-gpu" ? kTestsPerSecondGpu : kTestsPerSecondCpu;
  const double seconds = pairs * tests_a_pair / rate * static_cast<double>(cell.frames) * (options.runs + 1.0);
  if (seconds <= options.limit_s) return "";
  return fmt::format("left out: {:.2g} box tests a frame would take about {:.0f} s, more than the limit of {:.0f} s",
                     pairs * tests_a_pair, seconds, options.limit_s);
}

void add_count(const std::string& model, std::uint32_t count, const PlanOptions& options, const Device& device,
               std::vector<PaperCell>& cells) {
  PaperCell cell;
  cell.experiments = {"beyond"};
  cell.model = model;
  cell.count = count;
  cell.scene = "randommove:" + model + ":" + std::to_string(count);
  cell.frames = std::min(options.frames, kMostFrames);
  const auto add = [&](std::string_view method, std::string engine, double tests) {
    PaperCell own = cell;
    own.method = method;
    own.engine = std::move(engine);
    own.left_out = why_left_out(own, tests, options, device);
    cells.push_back(std::move(own));
  };
  for (const Method& m : kOctreeMethods) add(m.name, device.octree + std::string(m.settings), m.tests_a_pair);
  if (device.octree == "octree-cpu") add("octree, L = 2", "octree-cpu[broad=octree]", 0.0);
  add("hash", device.hash, 0.0);
  for (const std::string_view engine : kBroadPhases)
    add(engine, std::string(engine), engine == "all-pairs" ? 1.0 : 0.0);
}

}  // namespace

bool is_broad_only(const std::string& method) {
  return std::find(kBroadPhases.begin(), kBroadPhases.end(), method) != kBroadPhases.end();
}

void add_beyond(const PlanOptions& options, const Device& device, std::vector<PaperCell>& cells) {
  const datasets::PublishedTable& table = datasets::published_table("table5");
  for (const std::string& model : paper_models()) {
    if (!options.models.empty() &&
        std::find(options.models.begin(), options.models.end(), model) == options.models.end())
      continue;
    std::uint32_t base = 0;
    for (std::size_t r = table.rows.size(); r-- > 0;)
      if (table.text(r, "model") == model) base = static_cast<std::uint32_t>(table.number(r, "instances"));
    std::vector<std::uint32_t> counts = options.counts;
    if (counts.empty())
      for (const std::uint32_t factor : kFactors) counts.push_back(base * factor);
    std::sort(counts.begin(), counts.end());
    for (const std::uint32_t count : counts) add_count(model, count, options, device, cells);
  }
}

}  // namespace broadside::bench::paper
