// Broad phases on the same boxes, two kinds of work:
//   scratch: load + find, nothing kept from before;
//   moving:  update + find, each box having moved by 1 % of its size, for engines that keep what they found.
// Putting the pairs in canonical order is the counter order_ms. An engine whose pairs differ from the tree's is not
// timed.
//
// Machines that others use too: --benchmark_enable_random_interleaving=true --benchmark_repetitions=5, and compare
// medians of one run.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <string>

#include "bench/engines.hpp"
#include "core/engine/engine.hpp"
#include "datasets/box_streams/box_sets.hpp"
#include "reference/scene_octree/broad_phases.hpp"

namespace broadside::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Boxes = std::vector<core::Box>;

struct BoxSet {
  std::string_view name;
  Boxes (*make)(std::uint32_t n, std::uint64_t seed);
};
constexpr BoxSet kBoxSets[] = {
    {"uniform", datasets::uniform_boxes}, {"heaps", datasets::heap_boxes}, {"mixed", datasets::mixed_boxes}};
constexpr std::uint32_t kCounts[] = {10'000, 100'000, 1'000'000};
constexpr std::uint64_t kSeed = 1;

// Every broad phase of the table of engines takes part as it is; these rows say what differs from that.
struct Entry {
  std::string_view name;
  std::string_view engine;
  std::map<std::string, std::string> settings;
  std::uint32_t most_boxes;  // beyond this a run takes minutes
};

const std::vector<Entry>& exceptions() {
  static const std::vector<Entry> rows{
      {"all-pairs", "all-pairs", {}, 20'000},
      {"hash-cpu", "hash-cpu", {}, 20'000},  // its cell is a quarter of a metre, the boxes are of a metre and more
      {"octree-cpu", "octree-cpu", {}, 10'000'000},
      {"octree-cpu-1-thread", "octree-cpu", {{"threads", "1"}}, 10'000'000},
      {"octree-cpu-complete", "octree-cpu", {{"broad", "octree"}}, 20'000},
      {"octree-gpu", "octree-gpu", {}, 10'000'000},
      {"bullet-dbvt-deferred", "bullet-dbvt", {{"deferred", "on"}}, 1'000'000},
      {"bullet-sap", "bullet-sap", {}, 20'000},  // inserts one box after another: quadratic
      {"fcl-sap", "fcl-sap", {}, 20'000},
  };
  return rows;
}

constexpr std::uint32_t kMostBoxes = 1'000'000;

std::vector<Entry> racers() {
  std::vector<Entry> all = exceptions();
  for (const core::EngineRow& row : engines()) {
    const bool is_named = std::any_of(all.begin(), all.end(), [&](const Entry& e) { return e.name == row.id; });
    if (!is_named && row.capabilities.find("broad") != std::string_view::npos)
      all.push_back({row.id, row.id, {}, kMostBoxes});
  }
  return all;
}

// Null where the engine cannot run here, with the reason in `why`.
std::unique_ptr<core::BroadPhase> broad_phase_of(const Entry& entry, std::string& why) {
  const auto row = find_engine(entry.engine);
  if (!row) return why = row.error().line(), nullptr;
  if (why = why_absent(*row.value()); !why.empty()) return nullptr;
  auto settings = core::Settings::parse(row.value()->id, row.value()->settings, entry.settings);
  if (!settings) return why = settings.error().line(), nullptr;
  auto engine = row.value()->create(settings.value());
  if (!engine) return why = engine.error().line(), nullptr;
  return std::move(engine.value().broad_phase);
}

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

void race(benchmark::State& state, const Entry& entry, const BoxSet& set, std::uint32_t n, Work work) {
  std::string why;
  const auto broad = broad_phase_of(entry, why);
  if (!broad) {
    state.SkipWithError(("not measured: " + why).c_str());
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
  static const std::vector<Entry> all = racers();
  for (const BoxSet& set : kBoxSets)
    for (const std::uint32_t n : kCounts)
      for (const Entry& entry : all) {
        if (n > entry.most_boxes) continue;
        std::string path(name);
        path.append("/").append(set.name).append("/").append(std::to_string(n)).append("/").append(entry.name);
        benchmark::RegisterBenchmark(path.c_str(),
                                     [&entry, &set, n, work](benchmark::State& s) { race(s, entry, set, n, work); })
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
