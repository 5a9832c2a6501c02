// Compares a set of boxes that is spread over several devices with the same set on one of them. The boxes lie on the
// devices already, part by part. Prints one JSON line for each set and number of parts: medians over the repetitions,
// ms, by the host's clock.
//   broadside_gpu_spread REPETITIONS N[,N]... KIND[,KIND]...      e.g. broadside_gpu_spread 10 10000000,100000000
//   uniform
// Times of the steps of the search (count_ms, place_ms, scatter_ms, find_ms) are those of the part that took longest.
// Each set runs three times: one device's share of the boxes on one device, for weak scaling; all boxes on one device,
// for the digest and strong scaling; all boxes on all devices. KIND may be mesh:NAME: copies of a mesh, of about N
// boxes together.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <future>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "core/engine/space_parts.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "gpu/broad/spread_finder.hpp"
#include "gpu/engines_on_cuda.hpp"
#include "gpu/runtime/device_choice.hpp"

namespace broadside::bench {
namespace {

using core::Box;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

bool complain(const core::Error& error) {
  std::fprintf(stderr, "%s\n", error.line().c_str());
  return false;
}

std::vector<std::string> list_of(const std::string& text) {
  std::vector<std::string> items;
  std::stringstream stream(text);
  for (std::string item; std::getline(stream, item, ',');) items.push_back(item);
  return items;
}

core::Result<std::vector<Box>> boxes_of(const std::string& kind, std::uint64_t n) {
  std::string spec = "boxes:" + kind + ":" + std::to_string(n);
  if (kind.starts_with("mesh:")) {
    auto one = datasets::make_box_stream("boxes:" + kind);
    if (!one) return one.error();
    spec = "boxes:" + kind + ":" + std::to_string(std::max<std::uint64_t>(1, n / one.value().boxes.size()));
  }
  auto made = datasets::make_box_stream(spec);
  if (!made) return made.error();
  return std::move(made.value().boxes);
}

// Sorts the boxes by the part in which they begin, so that the numbers that the parts give them are those of the set.
core::SpaceCut put_part_by_part(std::vector<Box>& boxes, std::uint32_t parts) {
  core::SpaceCut cut = core::cut_space(boxes, parts);
  // The boxes are distributed in one pass: sorting three hundred million boxes would take most of a minute.
  std::vector<std::vector<Box>> of_part(cut.parts());
  for (const Box& box : boxes) of_part[cut.part_at(box.min[cut.axis])].push_back(box);
  boxes.clear();
  for (const std::vector<Box>& part : of_part) boxes.insert(boxes.end(), part.begin(), part.end());
  return cut;
}

// Returns false after it printed an error. `cut`: of one part or of all.
bool race(const char* what, const std::string& kind, const std::vector<Box>& boxes, const core::SpaceCut& cut,
          int repetitions) {
  const std::vector<std::uint8_t> is_static(boxes.size());
  gpu::SpreadFinder finder({cut.parts(), cut.parts()});
  if (core::Status s = finder.load_cut(boxes, is_static, cut); !s) return complain(s.error());
  std::vector<double> whole, borders, exchange, search, count, place, scatter, find;
  // The first runs are not counted: arrays still grow.
  for (int k = -3; k < repetitions; ++k) {
    if (core::Status s = finder.find(); !s) return complain(s.error());
    if (k < 0) continue;
    const gpu::SpreadTime t = finder.time();
    whole.push_back(t.whole_s() * 1e3), borders.push_back(t.borders_s * 1e3);
    exchange.push_back(t.exchange_s * 1e3), search.push_back(t.search_s * 1e3);
    const gpu::FindTime steps = finder.slowest_steps();
    count.push_back(steps.count_s * 1e3), place.push_back(steps.place_s * 1e3);
    scatter.push_back(steps.scatter_s * 1e3), find.push_back(steps.find_s * 1e3);
  }
  auto digest = finder.digest();
  if (!digest) return complain(digest.error());
  const auto [least, most] = std::minmax_element(whole.begin(), whole.end());
  const auto counters = finder.counters();
  std::printf(
      "{\"what\": \"%s\", \"boxes\": \"%s\", \"n\": %zu, \"parts\": %u, \"pairs\": %llu, \"digest\": \"0x%016llx\", "
      "\"ms\": %.4f, \"least_ms\": %.4f, \"most_ms\": %.4f, \"borders_ms\": %.4f, \"exchange_ms\": %.4f, "
      "\"search_ms\": %.4f, \"count_ms\": %.4f, \"place_ms\": %.4f, \"scatter_ms\": %.4f, \"find_ms\": %.4f, "
      "\"bytes_between\": %llu, \"bytes_needed\": %llu, \"device_bytes\": %llu}\n",
      what, kind.c_str(), boxes.size(), cut.parts(), static_cast<unsigned long long>(finder.pair_count()),
      static_cast<unsigned long long>(digest.value()), median(whole), *least, *most, median(borders), median(exchange),
      median(search), median(count), median(place), median(scatter), median(find),
      static_cast<unsigned long long>(counters[0].count / (repetitions + 3U)),
      static_cast<unsigned long long>(counters[1].count / (repetitions + 3U)),
      static_cast<unsigned long long>(counters[2].count));
  std::fflush(stdout);
  return true;
}

struct Request {
  std::string kind;
  std::uint64_t n = 0;
  std::uint32_t parts = 1;
};
struct MadeSet {
  std::vector<Box> boxes;
  core::SpaceCut cut;
};

core::Status make_set(const Request& wanted, MadeSet& set) {
  auto made = boxes_of(wanted.kind, wanted.n);
  if (!made) return made.error();
  set.boxes = std::move(made).value();
  set.cut = put_part_by_part(set.boxes, wanted.parts);
  return core::Done{};
}

// When a set does not fit on one device, that is reported, and the set is still raced on all devices.
bool race_set(const Request& wanted, const MadeSet& set, int repetitions) {
  bool is_good = race("one", wanted.kind, set.boxes, {}, repetitions);
  if (wanted.parts > 1) is_good = race("all", wanted.kind, set.boxes, set.cut, repetitions) && is_good;
  return is_good;
}

}  // namespace
}  // namespace broadside::bench

int main(int count, char** given) {
  using namespace broadside;
  if (const std::string why = gpu::gpu_absent(); !why.empty()) return std::fprintf(stderr, "%s\n", why.c_str()), 3;
  if (count != 4) return std::fprintf(stderr, "usage: broadside_gpu_spread REPETITIONS N[,N]... KIND[,KIND]...\n"), 2;
  const int repetitions = std::max(1, std::atoi(given[1]));
  auto devices = gpu::device_count();
  if (!devices) return bench::complain(devices.error()), 4;
  const auto all = static_cast<std::uint32_t>(devices.value());
  std::vector<bench::Request> wanted;
  for (const std::string& kind : bench::list_of(given[3])) {
    for (const std::string& n : bench::list_of(given[2])) {
      const std::uint64_t boxes = std::strtoull(n.c_str(), nullptr, 10);
      // The share that one device has when all devices together have this many boxes: weak scaling.
      if (all > 1) wanted.push_back({kind, boxes / all, 1});
      wanted.push_back({kind, boxes, all});
    }
  }
  // Making a set takes longer than racing on it, so a second thread makes the next set meanwhile.
  bench::MadeSet made[2];
  std::future<core::Status> next;
  const auto start = [&](std::size_t k) {
    next = std::async(std::launch::async, bench::make_set, std::cref(wanted[k]), std::ref(made[k % 2]));
  };
  if (!wanted.empty()) start(0);
  bool is_good = true;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const core::Status status = next.get();
    if (k + 1 < wanted.size()) start(k + 1);
    is_good =
        (status ? bench::race_set(wanted[k], made[k % 2], repetitions) : bench::complain(status.error())) && is_good;
  }
  return is_good ? 0 : 1;
}
