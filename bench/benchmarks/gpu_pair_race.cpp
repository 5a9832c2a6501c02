// The GPU's broad phase on the boxes of the races: boxes on the device, pairs in memory, in any order. Prints one JSON
// line a set: medians over the repetitions, ms.
//   broadside_gpu_race [LARGEST_N [REPETITIONS [KIND [SMALLEST_N]]]]
// KIND: uniform, heaps, mixed; or hard: surfaces, long thin boxes, uneven worlds, each of one size.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/pair.hpp"
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

// `frame`: of a stream, counted from 0.
bool race(const std::string& kind, const std::string& spec, std::uint32_t frame, int repetitions) {
  auto made = datasets::make_box_stream("boxes:" + spec);
  if (!made) return complain(made.error());
  for (std::uint32_t k = 0; k < frame; ++k)
    if (core::Status s = made.value().advance(made.value().boxes); !s) return complain(s.error());
  gpu::PairFinder finder({});
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
  auto pairs = finder.read_back();
  if (!pairs) return complain(pairs.error());
  const auto [least, most] = std::minmax_element(whole.begin(), whole.end());
  std::printf(
      "{\"boxes\": \"%s\", \"n\": %zu, \"passes\": %zu, \"pairs\": %zu, \"digest\": \"0x%016llx\", \"ms\": %.4f, \"least_ms\": %.4f, "
      "\"most_ms\": %.4f, \"count_ms\": %.4f, \"place_ms\": %.4f, \"scatter_ms\": %.4f, \"find_ms\": %.4f}\n",
      kind.c_str(), made.value().boxes.size(), finder.plan().passes.size(), pairs.value().pairs.size(),
      static_cast<unsigned long long>(core::pair_digest(pairs.value().pairs)), median(whole), *least, *most,
      median(count), median(place), median(scatter), median(find));
  std::fflush(stdout);
  return true;
}

struct HardSet {
  const char* kind;
  const char* spec;
  std::uint32_t frame = 0;
};

// A cloth while it is flat, half folded and folded.
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
  bool is_good = true;
  for (const std::string kind : {"uniform", "heaps", "mixed"})
    for (long n = smallest; n <= largest; n *= 10)
      if (count <= 3 || kind == given[3])
        is_good = broadside::bench::race(kind, kind + ":" + std::to_string(n), 0, repetitions) && is_good;
  if (count <= 3 || std::string("hard") == given[3])
    for (const auto& set : broadside::bench::kHardSets)
      is_good = broadside::bench::race(set.kind, set.spec, set.frame, repetitions) && is_good;
  return is_good ? 0 : 1;
}
