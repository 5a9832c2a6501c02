// Broad phases on the same boxes, two kinds of work:
//   scratch: load + find, nothing kept from before;
//   moving:  update + find, each box having moved by 1 % of its size, for engines that keep what they found.
// Putting the pairs in canonical order is the counter order_ms. An engine whose pairs differ from the tree's is not
// timed.
//
// Machines that others use too: --benchmark_enable_random_interleaving=true --benchmark_repetitions=5, and compare
// medians of one run.
#include <benchmark/benchmark.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>

#include "core/engine/engine.hpp"
#include "datasets/box_streams/box_sets.hpp"
#include "reference/engines.hpp"
#include "reference/scene_octree/broad_phases.hpp"

namespace broadside::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Boxes = std::vector<core::Box>;
using Maker = std::unique_ptr<core::BroadPhase> (*)();

struct BoxSet {
  std::string_view name;
  Boxes (*make)(std::uint32_t n, std::uint64_t seed);
};
constexpr BoxSet kBoxSets[] = {
    {"uniform", datasets::uniform_boxes}, {"heaps", datasets::heap_boxes}, {"mixed", datasets::mixed_boxes}};
constexpr std::uint32_t kCounts[] = {10'000, 100'000, 1'000'000};
constexpr std::uint64_t kSeed = 1;

template <core::EngineRow (*Row)()>
std::unique_ptr<core::BroadPhase> from_row() {
  const core::EngineRow row = Row();
  auto settings = core::Settings::parse(row.id, row.settings, {});
  if (!settings) return nullptr;
  auto engine = row.create(settings.value());
  return engine.ok() ? std::move(engine.value().broad_phase) : nullptr;
}

struct Racer {
  std::string_view name;
  Maker make;
  std::uint32_t most_boxes;  // beyond this a run takes minutes
};
constexpr Racer kRacers[] = {
    {"tree", [] { return reference::make_tree_broad_phase(); }, 10'000'000},
    {"tree-1-thread", [] { return reference::make_tree_broad_phase(1); }, 10'000'000},
    {"scene-octree", [] { return reference::make_scene_octree_broad_phase(core::empty_box()); }, 20'000},
    {"scene-octree-depth-6", [] { return reference::make_scene_octree_broad_phase(core::empty_box(), 6); }, 20'000},
    {"all-pairs", from_row<reference::all_pairs_row>, 20'000},
    {"hash-cpu", from_row<reference::hash_cpu_row>, 20'000},
    {"bullet-dbvt", from_row<reference::bullet_dbvt_row>, 1'000'000},
    {"bullet-dbvt-tree", from_row<reference::bullet_dbvt_tree_row>, 1'000'000},
    {"fcl-tree", from_row<reference::fcl_tree_row>, 1'000'000},
};

// Made once for all racers.
const Boxes& boxes_of(const BoxSet& set, std::uint32_t n) {
  static std::map<std::pair<std::string_view, std::uint32_t>, Boxes> made;
  Boxes& boxes = made[{set.name, n}];
  if (boxes.empty()) boxes = set.make(n, kSeed);
  return boxes;
}

core::Result<core::PairSet> pairs_of(core::BroadPhase& broad, const Boxes& boxes) {
  const std::vector<std::uint8_t> is_static(boxes.size(), 0);
  if (core::Status s = broad.load(boxes, is_static); !s) return s.error();
  if (core::Status s = broad.find(); !s) return s.error();
  return broad.read_back();
}

// The tree's answer, which tests hold to brute force.
std::uint64_t expected_digest(const BoxSet& set, std::uint32_t n) {
  static std::map<std::pair<std::string_view, std::uint32_t>, std::uint64_t> known;
  const auto [at, is_new] = known.try_emplace({set.name, n}, 0);
  if (is_new) {
    auto found = pairs_of(*reference::make_tree_broad_phase(), boxes_of(set, n));
    if (found.ok()) at->second = core::pair_digest(found.value().pairs);
  }
  return at->second;
}

enum class Work { kScratch, kMoving };

// Frame after frame to and fro, so that every step is a small one.
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

bool answers_agree(core::BroadPhase& broad, const BoxSet& set, std::uint32_t n) {
  const auto found = pairs_of(broad, boxes_of(set, n));
  return found.ok() && core::pair_digest(found.value().pairs) == expected_digest(set, n);
}

void race(benchmark::State& state, const Racer& racer, const BoxSet& set, std::uint32_t n, Work work) {
  const auto broad = racer.make();
  if (!broad) {
    state.SkipWithError("not measured: the engine cannot be made here");
    return;
  }
  if (!answers_agree(*broad, set, n)) {
    state.SkipWithError("not measured: its pairs differ from the tree's");
    return;
  }
  const Boxes& boxes = boxes_of(set, n);
  const std::vector<std::uint8_t> is_static(n, 0);
  const std::vector<Boxes> frames = work == Work::kMoving ? moving_frames(boxes) : std::vector<Boxes>{};
  double order_s = 0.0;
  std::size_t frame = 0;
  std::size_t pairs = 0;
  for (auto _ : state) {
    const auto start = Clock::now();
    const core::Status taken =
        work == Work::kScratch ? broad->load(boxes, is_static) : broad->update(frames[++frame % frames.size()]);
    const bool good = taken.ok() && broad->find().ok();
    const auto found = Clock::now();
    const auto set_of_pairs = broad->read_back();
    order_s += std::chrono::duration<double>(Clock::now() - found).count();
    state.SetIterationTime(std::chrono::duration<double>(found - start).count());
    if (!good || !set_of_pairs.ok()) {
      state.SkipWithError("failed");
      return;
    }
    pairs = set_of_pairs.value().pairs.size();
  }
  state.counters["order_ms"] = benchmark::Counter(1e3 * order_s, benchmark::Counter::kAvgIterations);
  state.counters["pairs"] = static_cast<double>(pairs);
}

void register_work(std::string_view name, Work work) {
  for (const BoxSet& set : kBoxSets)
    for (const std::uint32_t n : kCounts)
      for (const Racer& racer : kRacers) {
        if (n > racer.most_boxes) continue;
        std::string path(name);
        path.append("/").append(set.name).append("/").append(std::to_string(n)).append("/").append(racer.name);
        benchmark::RegisterBenchmark(path.c_str(),
                                     [&racer, &set, n, work](benchmark::State& s) { race(s, racer, set, n, work); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
      }
}

}  // namespace
}  // namespace broadside::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  broadside::bench::register_work("scratch", broadside::bench::Work::kScratch);
  broadside::bench::register_work("moving", broadside::bench::Work::kMoving);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
