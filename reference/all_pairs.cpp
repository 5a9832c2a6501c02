// The arbiter of every broad phase: P(6) on each of the n (n - 1) / 2 pairs, by float comparison of the stored boxes,
// with no structure that could lose one. Quadratic on purpose; tiled and branch-free so that it stays usable.
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/version.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <utility>

#include "reference/engines.hpp"
#include "reference/given_boxes.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"
#include "reference/worker_count.hpp"

namespace broadside::reference {
namespace {

using core::Pair;
using core::PairSet;
using core::Status;

constexpr std::string_view kAllPairsId = "all-pairs";
// Boxes of one tile: 6 arrays of 512 floats are 12 KiB, so a tile stays in a 32 KiB first-level cache beside the flags.
constexpr std::uint32_t kTile = 512;
// Rows of one task: enough tests per task to hide its scheduling, and few enough rows to balance the triangle.
constexpr std::uint32_t kRows = 64;

// Structure of arrays: one compare instruction tests several boxes.
struct Columns {
  std::array<std::vector<float>, 3> min;
  std::array<std::vector<float>, 3> max;

  void assign(std::span<const core::Box> boxes) {
    for (int axis = 0; axis < 3; ++axis) {
      min[axis].resize(boxes.size());
      max[axis].resize(boxes.size());
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        min[axis][i] = boxes[i].min[axis];
        max[axis][i] = boxes[i].max[axis];
      }
    }
  }
};

// hit[k] = 1 where box i overlaps box first + k. No branch and no early out, so the loop vectorizes.
void test_tile(const Columns& c, std::uint32_t i, std::uint32_t first, std::uint32_t count, std::uint8_t* hit) {
  std::fill_n(hit, count, std::uint8_t{1});
  for (int axis = 0; axis < 3; ++axis) {
    const float lo = c.min[axis][i];
    const float hi = c.max[axis][i];
    const float* min = c.min[axis].data() + first;
    const float* max = c.max[axis].data() + first;
    for (std::uint32_t k = 0; k < count; ++k) hit[k] &= static_cast<std::uint8_t>((lo <= max[k]) & (min[k] <= hi));
  }
}

class AllPairs final : public core::BroadPhase {
 public:
  explicit AllPairs(int workers) : arena_(workers) {}

  [[nodiscard]] core::BroadPhaseTraits traits() const override { return {}; }

  Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override {
    if (Status status = given_.load(kAllPairsId, boxes, is_static); !status) return status;
    columns_.assign(given_.boxes());
    rows_.assign((given_.count() + kRows - 1) / kRows, {});
    return core::Done{};
  }

  Status update(std::span<const core::Box> boxes) override {
    if (Status status = given_.update(kAllPairsId, boxes); !status) return status;
    columns_.assign(given_.boxes());
    return core::Done{};
  }

  Status find() override {
    return vendor_call("all-pairs: find", [&]() -> Status {
      arena_.execute([&] { tbb::parallel_for(std::size_t{0}, rows_.size(), [&](std::size_t k) { test_rows(k); }); });
      return core::Done{};
    });
  }

  core::Result<PairSet> read_back() override {
    PairSet set;
    for (const std::vector<Pair>& block : rows_) set.raw += block.size();
    set.pairs.reserve(set.raw);
    // Blocks are in order of i and each is sorted, so the joined list is sorted whatever thread made which block.
    for (const std::vector<Pair>& block : rows_) set.pairs.insert(set.pairs.end(), block.begin(), block.end());
    set.demanded = set.raw;
    return set;
  }

 private:
  void test_rows(std::size_t block) {
    const std::uint32_t n = given_.count();
    const auto begin = static_cast<std::uint32_t>(block) * kRows;
    const std::uint32_t end = std::min(n, begin + kRows);
    std::vector<Pair>& out = rows_[block];
    out.clear();
    std::array<std::uint8_t, kTile> hit;
    // Tile outside, rows inside, so that the tile is read from memory once per block; sorted again at the end.
    for (std::uint32_t tile = begin + 1; tile < n; tile += kTile) {
      const std::uint32_t tile_end = std::min(n, tile + kTile);
      for (std::uint32_t i = begin; i < end; ++i) {
        const std::uint32_t first = std::max(tile, i + 1);
        if (first >= tile_end) continue;
        test_tile(columns_, i, first, tile_end - first, hit.data());
        collect(i, first, tile_end - first, hit.data(), out);
      }
    }
    std::sort(out.begin(), out.end());
  }

  void collect(std::uint32_t i, std::uint32_t first, std::uint32_t count, const std::uint8_t* hit,
               std::vector<Pair>& out) const {
    const std::span<const std::uint8_t> is_static = given_.is_static();
    const auto take = [&](std::uint32_t k) {
      if (hit[k] != 0 && (is_static[i] == 0 || is_static[first + k] == 0)) out.push_back({i, first + k});
    };
    std::uint32_t k = 0;
    // Hits are rare: eight flags that are all 0 are skipped at a time.
    for (; k + 8 <= count; k += 8) {
      std::uint64_t eight = 0;
      std::memcpy(&eight, hit + k, sizeof(eight));
      if (eight == 0) continue;
      for (std::uint32_t m = k; m < k + 8; ++m) take(m);
    }
    for (; k < count; ++k) take(k);
  }

  tbb::task_arena arena_;
  GivenBoxes given_;
  Columns columns_;
  std::vector<std::vector<Pair>> rows_;
};

std::span<const core::SettingRow> all_pairs_settings() {
  static const std::array<core::SettingRow, 1> kSettings{{
      threads_setting(),
  }};
  return kSettings;
}

core::Result<core::Engine> create_all_pairs(const core::Settings& settings) {
  core::Engine engine;
  engine.id = kAllPairsId;
  engine.build =
      "own, float32 compare, oneTBB " + std::to_string(TBB_VERSION_MAJOR) + "." + std::to_string(TBB_VERSION_MINOR);
  engine.settings = settings;
  const int workers = worker_count(settings.number("threads"));
  engine.equivalence = [build = engine.build, workers](const core::Scene&) {
    core::EquivalenceCard card =
        own_card(build, "float32", "rows of columns, as the compiler vectorizes them", workers);
    card.push_back({"broad-phase margin", "none", ""});
    return card;
  };
  engine.broad_phase = std::make_unique<AllPairs>(workers);
  return engine;
}

}  // namespace

core::EngineRow all_pairs_row() {
  return {.id = kAllPairsId,
          .capabilities = "broad",
          .what = "every pair of boxes by float comparison: exact, the arbiter of broad phases",
          .settings = all_pairs_settings(),
          .runs_in_child = true,
          .create = create_all_pairs,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
