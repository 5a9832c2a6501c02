// Times the GPU's broad phase on the boxes of the races: boxes on the device, pairs in memory, in any order. Prints one
// JSON line for each set: medians over the repetitions, ms.
//   broadside_gpu_race [LARGEST_N [REPETITIONS [KIND [SMALLEST_N [ORDER]]]]]
// KIND: uniform, heaps, mixed; or hard: surfaces, long thin boxes, uneven worlds, each of one size; or one set by its
// whole name, mesh:bunny:2000. Counts go from SMALLEST_N to LARGEST_N by factors of ten. ORDER: a way to put the boxes
// in order, for comparison:
//   at-once           bulk pairs without bins
//   coarse            in two steps, however few bins there are
//   bulk              as bulk pairs from 4096 boxes on
//   lanes1, lanes4    so many lanes for each box, also as bulk pairs from 4096 boxes on
//   scale1            cells as large as the largest box
//   x0, x1, x2        cells that are halved so often along x
//   apart2, apart4    levels that are so far apart
//   groups, groups0   with or without groups of boxes, also as bulk pairs from 4096 boxes on
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/benchmarks/gpu_pair_digest.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "gpu/broad/pair_finder.hpp"
#include "gpu/engines_on_cuda.hpp"

namespace broadside::bench {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

bool complain(const core::Error& error) {
  std::fprintf(stderr, "%s\n", error.line().c_str());
  return false;
}

// A GPU that was idle takes some tenths of a second to reach its clock rate.
constexpr double kWarmUpS = 0.3;

gpu::PairFinderOptions options_of(const std::string& order) {
  gpu::PairFinderOptions options;
  if (order == "at-once") options.least_for_bins = 0xFFFFFFFFU;
  if (order.starts_with("lanes")) options.lanes_per_box = static_cast<std::uint32_t>(std::atoi(order.c_str() + 5));
  if (order == "bulk" || order.starts_with("lanes")) options.least_for_bulk = 4096;
  if (order.starts_with("groups")) {
    options.groups = order == "groups" ? 1 : 0;
    options.least_for_bulk = 4096;
  }
  if (order == "scale1") options.cell_scale = 1.0F;
  if (order.starts_with("x")) options.x_halvings = static_cast<std::uint32_t>(std::atoi(order.c_str() + 1));
  if (order.starts_with("apart")) options.levels_apart = static_cast<std::uint32_t>(std::atoi(order.c_str() + 5));
  if (order == "coarse") options.most_bins_at_once = 1024;  // two coarse bins have fewer, at any number of boxes
  return options;
}

// `frame`: the number of the stream's frame, counted from 0.
bool race(const std::string& kind, const std::string& spec, std::uint32_t frame, int repetitions,
          const std::string& order) {
  auto made = datasets::make_box_stream("boxes:" + spec);
  if (!made) return complain(made.error());
  for (std::uint32_t k = 0; k < frame; ++k)
    if (core::Status s = made.value().advance(made.value().boxes); !s) return complain(s.error());
  gpu::PairFinder finder(options_of(order));
  const std::vector<std::uint8_t> is_static(made.value().boxes.size());
  if (core::Status s = finder.load(made.value().boxes, is_static); !s) return complain(s.error());
  for (double spent_s = 0.0; spent_s < kWarmUpS; spent_s += 1e-5 + finder.find_time().whole_s)
    if (core::Status s = finder.find(); !s) return complain(s.error());
  std::vector<double> whole, count, place, scatter, find;
  for (int k = 0; k < repetitions; ++k) {
    if (core::Status s = finder.find(); !s) return complain(s.error());
    const gpu::FindTime t = finder.find_time();
    whole.push_back(t.whole_s * 1e3), count.push_back(t.count_s * 1e3), place.push_back(t.place_s * 1e3);
    scatter.push_back(t.scatter_s * 1e3), find.push_back(t.find_s * 1e3);
  }
  auto pairs = finder.pairs_on_device();
  if (!pairs) return complain(pairs.error());
  auto digest = digest_of(pairs.value());
  if (!digest) return complain(digest.error());
  const auto [least, most] = std::minmax_element(whole.begin(), whole.end());
  std::printf(
      "{\"boxes\": \"%s\", \"order\": \"%s\", \"n\": %zu, \"passes\": %zu, \"pairs\": %llu, \"digest\": \"0x%016llx\", \"ms\": %.4f, \"least_ms\": %.4f, "
      "\"most_ms\": %.4f, \"count_ms\": %.4f, \"place_ms\": %.4f, \"scatter_ms\": %.4f, \"find_ms\": %.4f}\n",
      kind.c_str(), order.c_str(), made.value().boxes.size(), finder.plan().passes.size(),
      static_cast<unsigned long long>(pairs.value().count), static_cast<unsigned long long>(digest.value()),
      median(whole), *least, *most, median(count), median(place), median(scatter), median(find));
  std::fflush(stdout);
  return true;
}

struct HardSet {
  const char* kind;
  const char* spec;
  std::uint32_t frame = 0;
};

// The frames at which a cloth is flat, half folded and folded.
constexpr HardSet kHardSets[] = {{"needles", "needles:100000"},
                                 {"slivers", "slivers:100000"},
                                 {"spiral", "spiral:100000"},
                                 {"cantor", "cantor:100000"},
                                 {"exponents", "exponents:30000"},
                                 {"sheet, frame 0", "sheet:150000", 0},
                                 {"sheet, frame 50", "sheet:150000", 50},
                                 {"sheet, frame 99", "sheet:150000", 99},
                                 {"mesh sphere, 117 copies", "mesh:sphere:117"},
                                 {"mesh dragon", "mesh:dragon"},
                                 {"mesh bunny, 30 copies", "mesh:bunny:30"}};

}  // namespace
}  // namespace broadside::bench

int main(int count, char** given) {
  if (const std::string why = broadside::gpu::gpu_absent(); !why.empty())
    return std::fprintf(stderr, "%s\n", why.c_str()), 3;
  const long largest = count > 1 ? std::atol(given[1]) : 1'000'000;
  const int repetitions = count > 2 ? std::max(1, std::atoi(given[2])) : 50;
  const long smallest = count > 4 ? std::max(1L, std::atol(given[4])) : 1000;
  const std::string order = count > 5 ? given[5] : "default";
  bool is_good = true;
  if (count > 3 && std::string(given[3]).find(':') != std::string::npos)
    return broadside::bench::race(given[3], given[3], 0, repetitions, order) ? 0 : 1;
  for (const std::string kind : {"uniform", "heaps", "mixed"})
    for (long n = smallest; n <= largest; n *= 10)
      if (count <= 3 || kind == given[3])
        is_good = broadside::bench::race(kind, kind + ":" + std::to_string(n), 0, repetitions, order) && is_good;
  if (count <= 3 || std::string("hard") == given[3])
    for (const auto& set : broadside::bench::kHardSets)
      is_good = broadside::bench::race(set.kind, set.spec, set.frame, repetitions, order) && is_good;
  return is_good ? 0 : 1;
}
