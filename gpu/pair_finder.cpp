#include "gpu/pair_finder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "gpu/device_buffer.hpp"
#include "gpu/frame_kernel.hpp"
#include "gpu/host_side.hpp"

namespace broadside::gpu {
namespace {

using core::Box;

// Some eight overlaps a box in the densest scenes of the campaign; a frame that finds more is found again.
constexpr std::uint64_t kPairsPerBox = 8;

}  // namespace

struct PairFinder::Impl {
  bool has_tree = true;
  Stream stream;
  OutcomeMemory outcome;
  LaunchShape launch;
  FrameView view;
  std::vector<std::uint8_t> is_static;
  std::vector<PackedBox> packed;
  Counters counts;
  DeviceBuffer<PackedBox> boxes;
  DeviceBuffer<std::uint32_t> bucket_count;
  DeviceBuffer<std::uint32_t> bucket_begin;
  DeviceBuffer<std::uint32_t> rank;
  DeviceBuffer<PackedBox> entries;
  DeviceBuffer<std::uint32_t> levels;
  DeviceBuffer<core::Pair> pairs;
  DeviceBuffer<Counters> counters;

  core::Status reserve(std::size_t count);
  core::Status pack_boxes(std::span<const Box> given);
};

PairFinder::PairFinder(bool has_tree) : impl_(std::make_unique<Impl>()) {
  impl_->has_tree = has_tree;
}
PairFinder::~PairFinder() = default;

core::Status PairFinder::Impl::reserve(std::size_t count) {
  BROADSIDE_TRY(stream.create());
  BROADSIDE_TRY(outcome.allocate());
  BROADSIDE_TRY(boxes.reserve(count, "boxes"));
  BROADSIDE_TRY(counters.reserve(1, "counters"));
  BROADSIDE_TRY(pairs.reserve(std::max<std::uint64_t>(1024, kPairsPerBox * count), "pairs"));
  view = {};
  view.start = has_tree && count >= kLeastBodiesForGrid ? Start::kGrid : Start::kTiles;
  if (view.start == Start::kGrid) {
    const std::uint64_t buckets = std::bit_ceil(2 * std::uint64_t{count});
    BROADSIDE_TRY(bucket_count.reserve(buckets, "grid"));
    BROADSIDE_TRY(bucket_begin.reserve(buckets, "grid"));
    BROADSIDE_TRY(rank.reserve(count, "grid"));
    BROADSIDE_TRY(entries.reserve(count, "grid"));
    BROADSIDE_TRY(levels.reserve(1, "grid"));
    BROADSIDE_TRY(bucket_count.fill_bytes(0));
    BROADSIDE_TRY(levels.fill_bytes(0));
  }
  auto shape = pairs_launch_shape();
  if (!shape.ok()) return shape.error();
  launch = shape.value();
  view.body_count = static_cast<std::uint32_t>(count);
  view.boxes = boxes.data();
  view.grid = {static_cast<std::uint32_t>(bucket_count.capacity()) - 1,
               bucket_count.data(),
               bucket_begin.data(),
               rank.data(),
               entries.data(),
               levels.data(),
               1.0F};
  view.counters = counters.data();
  view.outcome = outcome.device();
  return cuda_status(cudaDeviceSynchronize(), "clearing the grid");
}

// Checks and packs, and sizes the cells of the coarsest level: as large as the largest box, and so large that they are
// many units in the last place of the coordinates.
core::Status PairFinder::Impl::pack_boxes(std::span<const Box> given) {
  packed.resize(given.size());
  float side = 0.0F;
  float range = 0.0F;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const Box& box = given[i];
    for (int k = 0; k < 3; ++k) {
      if (!(std::isfinite(box.min[k]) && std::isfinite(box.max[k]) && box.min[k] <= box.max[k]))
        return core::Error{"a box has min > max, or is NaN or infinite", "octree-gpu: box " + std::to_string(i),
                           "give finite boxes with min <= max"};
      side = std::max(side, box.max[k] - box.min[k]);
      range = std::max({range, std::abs(box.min[k]), std::abs(box.max[k])});
    }
    packed[i] = pack(box, static_cast<std::uint32_t>(i), is_static[i] != 0 ? 1U : 0U);
  }
  view.grid.cell_m = grid_cell_m(side, range);
  return core::Done{};
}

core::Status PairFinder::load(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) {
  impl_->is_static.assign(is_static.begin(), is_static.end());
  BROADSIDE_TRY(impl_->reserve(boxes.size()));
  return update(boxes);
}

core::Status PairFinder::update(std::span<const Box> boxes) {
  Impl& d = *impl_;
  if (boxes.size() != d.is_static.size())
    return core::Error{"update was given " + std::to_string(boxes.size()) + " boxes after a load of " +
                           std::to_string(d.is_static.size()),
                       "octree-gpu", "load again when the number of boxes changes"};
  BROADSIDE_TRY(d.pack_boxes(boxes));
  return d.boxes.upload(d.packed, "boxes");
}

core::Status PairFinder::find() {
  Impl& d = *impl_;
  for (;;) {
    d.view.pairs = {d.pairs.data(), d.pairs.capacity()};
    BROADSIDE_TRY(launch_pairs(d.view, d.launch, d.stream.get()));
    BROADSIDE_TRY(cuda_status(cudaStreamSynchronize(d.stream.get()), "finding pairs"));
    d.counts = (*d.outcome).counters;
    if (d.counts.is_aborted == 0) return core::Done{};
    BROADSIDE_TRY(d.pairs.reserve(d.counts.pairs, "pairs"));
  }
}

core::Result<core::PairSet> PairFinder::read_back() {
  core::PairSet set;
  BROADSIDE_TRY(impl_->pairs.download(set.pairs, impl_->counts.pairs));
  std::sort(set.pairs.begin(), set.pairs.end());
  set.demanded = set.raw = set.pairs.size();
  return set;
}

}  // namespace broadside::gpu
