// Broad phases on the same boxes, four suites:
//   scratch: load + find, nothing kept from before, over the count of boxes;
//   moving:  update + find, each box having moved by 1 % of its size, for engines that keep what they found;
//   sweep:   as scratch, with one property of a million boxes varied;
//   hard:    as scratch, on surfaces, long thin boxes and uneven worlds.
// take_ms and find_ms are the two parts of the time; putting the pairs in canonical order is order_ms. An engine whose
// pairs differ from those of octree-cpu, or for octree-cpu from those of Embree, is not timed.
//
// On machines that other programs use too, pass --benchmark_enable_random_interleaving=true --benchmark_repetitions=5,
// and compare medians of one run.
#include <benchmark/benchmark.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>

#include "bench/benchmarks/box_families.hpp"
#include "bench/benchmarks/feature_queries.hpp"
#include "bench/benchmarks/racers.hpp"
#include "core/pair.hpp"

namespace broadside::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Boxes = std::vector<core::Box>;

// Only the last set is kept: ten million boxes are 240 MB, and benchmarks run set by set.
const Boxes& boxes_of(const BoxSet& set) {
  static std::string path;
  static Boxes boxes;
  if (path != set.path) {
    boxes = set.boxes();
    path = set.path;
  }
  return boxes;
}

core::Result<core::PairSet> pairs_of(core::BroadPhase& broad, const Boxes& boxes) {
  const std::vector<std::uint8_t> is_static(boxes.size(), 0);
  if (core::Status s = broad.load(boxes, is_static); !s) return s.error();
  if (core::Status s = broad.find(); !s) return s.error();
  return broad.read_back();
}

// The digest that the engine must find, computed by an engine that shares no code with it.
std::uint64_t expected_digest(const BoxSet& set, bool is_for_octree) {
  static std::map<std::pair<std::string, bool>, std::uint64_t> known;
  const auto [at, is_new] = known.try_emplace({set.path, is_for_octree}, 0);
  if (is_new) {
    const Racer arbiter{"", is_for_octree ? "embree-collide" : "octree-cpu", {}, 0};
    std::string why;
    const auto broad = broad_phase_of(arbiter, why);
    if (broad == nullptr) return 0;
    const auto found = pairs_of(*broad, boxes_of(set));
    if (found.ok()) at->second = core::pair_digest(found.value().pairs);
  }
  return at->second;
}

// Checked once for all repetitions, because on a million boxes a check takes as long as the timed work.
bool is_right(core::BroadPhase& broad, const Racer& racer, const BoxSet& set) {
  static std::map<std::pair<std::string, std::string>, bool> known;
  const auto [at, is_new] = known.try_emplace({set.path, std::string(racer.name)}, false);
  if (is_new) {
    const auto found = pairs_of(broad, boxes_of(set));
    at->second = found.ok() &&
                 core::pair_digest(found.value().pairs) == expected_digest(set, racer.engine.substr(0, 6) == "octree");
  }
  return at->second;
}

enum class Work { kScratch, kMoving };

// The frames run forward and then backward, so that every step is a small motion.
std::vector<Boxes> moving_frames(const Boxes& boxes) {
  constexpr std::size_t kFrames = 4;
  std::vector<Boxes> frames{boxes};
  while (frames.size() < kFrames) {
    Boxes next = frames.back();
    for (core::Box& box : next) box = core::translated(box, 0.01F * (box.max - box.min));
    frames.push_back(std::move(next));
  }
  for (std::size_t k = kFrames - 2; k > 0; --k) frames.push_back(frames[k]);
  return frames;
}

double seconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

void race(benchmark::State& state, const Racer& racer, const BoxSet& set, Work work) {
  std::string why;
  const auto broad = broad_phase_of(racer, why);
  if (broad == nullptr) {
    state.SkipWithError(("not measured: " + why).c_str());
    return;
  }
  const Boxes& boxes = boxes_of(set);
  if (boxes.empty()) {
    state.SkipWithError("not measured: these boxes cannot be made on this machine");
    return;
  }
  if (!is_right(*broad, racer, set)) {
    state.SkipWithError("not measured: its pairs are not those of the arbiter");
    return;
  }
  const std::vector<std::uint8_t> is_static(boxes.size(), 0);
  // On a GPU the first find of a set may have too little memory for its pairs; then it is repeated with more.
  const bool is_on_gpu = racer.engine.ends_with("-gpu");
  if ((work == Work::kMoving || is_on_gpu) && (!broad->load(boxes, is_static).ok() || !broad->find().ok())) {
    state.SkipWithError("failed");
    return;
  }
  const std::vector<Boxes> frames = work == Work::kMoving ? moving_frames(boxes) : std::vector<Boxes>{};
  double take_s = 0.0;
  double find_s = 0.0;
  double order_s = 0.0;
  std::size_t frame = 0;
  std::size_t pairs = 0;
  for (auto _ : state) {
    const auto start = Clock::now();
    const core::Status taken =
        work == Work::kScratch ? broad->load(boxes, is_static) : broad->update(frames[++frame % frames.size()]);
    const auto ready = Clock::now();
    const core::Status looked = broad->find();
    const auto found = Clock::now();
    const auto set_of_pairs = broad->read_back();
    take_s += seconds(start, ready);
    find_s += seconds(ready, found);
    order_s += seconds(found, Clock::now());
    state.SetIterationTime(seconds(start, found));
    if (!taken.ok() || !looked.ok() || !set_of_pairs.ok()) {
      state.SkipWithError("failed");
      return;
    }
    pairs = set_of_pairs.value().pairs.size();
  }
  const auto milliseconds = [](double s) { return benchmark::Counter(1e3 * s, benchmark::Counter::kAvgIterations); };
  state.counters["take_ms"] = milliseconds(take_s);
  state.counters["find_ms"] = milliseconds(find_s);
  state.counters["order_ms"] = milliseconds(order_s);
  state.counters["boxes"] = static_cast<double>(boxes.size());
  state.counters["pairs"] = static_cast<double>(pairs);
}

void register_suite(const std::string& name, const std::vector<BoxSet>& sets, Work work) {
  for (const BoxSet& set : sets)
    for (const Racer& racer : racers()) {
      if (set.count > racer.most_boxes) continue;
      const std::string path = name + "/" + set.path + "/" + std::string(racer.name);
      benchmark::RegisterBenchmark(path.c_str(),
                                   [&racer, &set, work](benchmark::State& s) { race(s, racer, set, work); })
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond);
    }
}

}  // namespace
}  // namespace broadside::bench

int main(int argc, char** argv) {
  using namespace broadside::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const std::vector<BoxSet> counted = race_sets({1'000, 10'000, 100'000, 1'000'000, 10'000'000});
  const std::vector<BoxSet> moved = race_sets({1'000, 10'000, 100'000, 1'000'000});
  const std::vector<BoxSet> swept = sweep_sets(1'000'000);
  const std::vector<BoxSet> hard = hard_sets();
  register_suite("scratch", counted, Work::kScratch);
  register_suite("moving", moved, Work::kMoving);
  register_suite("sweep", swept, Work::kScratch);
  register_suite("hard", hard, Work::kScratch);
  register_feature_queries();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
