// The order of boxes in the tree: by size class, then along the Hilbert curve, again and again where they crowd.
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>

#include "reference/scene_octree/box_check.hpp"
#include "reference/scene_octree/size_tree.hpp"

namespace broadside::reference {
namespace {

using core::Box;

// Boxes per task: some 100 us of work.
constexpr std::size_t kChunk = std::size_t{1} << 14U;
// Cells are computed this many at a time, one step of the curve for all, so that the loop vectorizes.
constexpr std::size_t kTile = 64;
// More boxes than this in one cell of the curve are sorted again in a grid over that cell's own centers. Up to it,
// their packs cover the cell a few times over at worst.
constexpr std::size_t kLongRun = 64;
// Runs from here on are worth all workers.
constexpr std::size_t kHugeRun = 4 * kChunk;

std::size_t chunk_count(std::size_t n) {
  return (n + kChunk - 1U) / kChunk;
}

template <typename Work>
void for_each_chunk(std::size_t n, const Work& work) {
  const auto chunk = [&](std::size_t c) { work(c, c * kChunk, std::min(n, (c + 1U) * kChunk)); };
  if (n <= kChunk)
    chunk(0);
  else
    tbb::parallel_for(std::size_t{0}, chunk_count(n), chunk);
}

// Replaces the keys of entries by Hilbert codes of their boxes' centers, below a class where class_of is given.
template <typename ClassOf>
void write_keys(std::span<const Box> boxes, std::span<KeyedId> entries, const core::CurveGrid& grid,
                const ClassOf& class_of) {
  std::uint32_t x[kTile];
  std::uint32_t y[kTile];
  std::uint32_t z[kTile];
  for (std::size_t first = 0; first < entries.size(); first += kTile) {
    const std::size_t count = std::min(kTile, entries.size() - first);
    for (std::size_t k = 0; k < count; ++k) {
      const core::CurveCell cell = core::curve_cell(grid, boxes[id_of(entries[first + k])]);
      x[k] = cell.x;
      y[k] = cell.y;
      z[k] = cell.z;
    }
    for (std::size_t k = count; k < kTile; ++k) x[k] = y[k] = z[k] = 0;
    for (int bit = grid.bits - 1; bit > 0; --bit)
      for (std::size_t k = 0; k < kTile; ++k) core::hilbert_step(x[k], y[k], z[k], bit);
    for (std::size_t k = 0; k < kTile; ++k) x[k] = core::hilbert_finish(x[k], y[k], z[k]);
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t id = id_of(entries[first + k]);
      entries[first + k] = keyed_id(class_of(boxes[id]) | x[k], id);
    }
  }
}

Box half_centers_of(std::span<const Box> boxes, std::span<const KeyedId> entries) {
  Box bounds = core::empty_box();
  for (const KeyedId entry : entries) bounds = core::grown(bounds, core::half_center(boxes[id_of(entry)]));
  return bounds;
}

Box united(const Box& a, const Box& b) {
  return core::grown(core::grown(a, b.min), b.max);
}

}  // namespace

void SizeTree::survey(std::span<const Box> boxes) {
  const std::size_t n = boxes.size();
  surveys_.resize(std::max(std::size_t{1}, chunk_count(n)));
  for_each_chunk(n, [&](std::size_t c, std::size_t begin, std::size_t end) {
    Survey survey;
    for (std::size_t i = begin; i < end; ++i) {
      survey.is_sound &= is_sound_box(boxes[i]);
      survey.bounds = united(survey.bounds, boxes[i]);
      survey.half_centers = core::grown(survey.half_centers, core::half_center(boxes[i]));
      // The mask keeps an unsound box's sign bit, and with it the index, in range.
      ++survey.sizes[static_cast<std::size_t>(core::size_bin(boxes[i])) & 255U];
    }
    surveys_[c] = survey;
  });
  whole_ = surveys_[0];
  for (std::size_t c = 1; c < surveys_.size(); ++c) {
    const Survey& part = surveys_[c];
    whole_.is_sound &= part.is_sound;
    whole_.bounds = united(whole_.bounds, part.bounds);
    whole_.half_centers = united(whole_.half_centers, part.half_centers);
    for (std::size_t bin = 0; bin < whole_.sizes.size(); ++bin) whole_.sizes[bin] += part.sizes[bin];
  }
}

void SizeTree::sort_boxes(std::span<const Box> boxes) {
  const std::size_t n = boxes.size();
  double bounds_m3 = 1.0;
  for (int axis = 0; axis < 3; ++axis)
    bounds_m3 *= static_cast<double>(whole_.bounds.max[axis]) - static_cast<double>(whole_.bounds.min[axis]);
  plan_ = plan_size_classes(whole_.sizes, bounds_m3);

  const auto class_bits = static_cast<int>(std::bit_width(plan_.counts.size() - 1U));
  const int most = std::min(core::kCurveBits, (32 - class_bits) / 3);
  const core::CurveGrid grid =
      core::make_curve_grid(whole_.half_centers, core::curve_bits(static_cast<std::uint32_t>(n), most));
  const auto class_shift = static_cast<unsigned>(3 * grid.bits);
  std::array<std::uint32_t, core::kSizeBins> class_key;
  for (std::size_t bin = 0; bin < class_key.size(); ++bin)
    class_key[bin] = class_bits == 0 ? 0U : std::uint32_t{plan_.class_of_bin[bin]} << class_shift;

  sorted_.resize(n);
  scratch_.resize(n);
  for_each_chunk(n, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) sorted_[i] = keyed_id(0, static_cast<std::uint32_t>(i));
    const std::span<KeyedId> part = std::span(sorted_).subspan(begin, end - begin);
    if (class_bits == 0)
      write_keys(boxes, part, grid, [](const Box&) { return 0U; });
    else
      write_keys(boxes, part, grid,
                 [&](const Box& box) { return class_key[static_cast<std::size_t>(core::size_bin(box))]; });
  });
  key_sort_.sort(sorted_, scratch_, 3 * grid.bits + class_bits);
  sort_long_runs(boxes);
}

// Runs of one key, longer than kLongRun, that begin in [begin, end) of the sorted order.
void SizeTree::find_runs(std::size_t begin, std::size_t end, std::vector<Run>& runs) const {
  for (std::size_t at = begin; at + kLongRun < end;) {
    const std::uint32_t key = key_of(sorted_[at]);
    // Most places are no long run: one look ahead tells.
    if (key_of(sorted_[at + kLongRun]) != key) {
      ++at;
      continue;
    }
    std::size_t past = at + kLongRun + 1U;
    while (past < end && key_of(sorted_[past]) == key) ++past;
    runs.push_back({static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(past)});
    at = past;
  }
}

void SizeTree::sort_long_runs(std::span<const Box> boxes) {
  const std::size_t n = boxes.size();
  if (n <= kLongRun) return;
  // Usually there are none, and one parallel look over the keys says so.
  for_each_chunk(n, [&](std::size_t c, std::size_t begin, std::size_t end) {
    bool any = false;
    for (std::size_t at = begin; at < std::min(end, n - kLongRun); ++at)
      any |= key_of(sorted_[at]) == key_of(sorted_[at + kLongRun]);
    surveys_[c].is_sound = !any;
  });
  if (std::all_of(surveys_.begin(), surveys_.end(), [](const Survey& s) { return s.is_sound; })) return;
  std::vector<Run> runs;
  find_runs(0, n, runs);
  const auto huge = std::partition(runs.begin(), runs.end(), [](Run r) { return r.end - r.begin < kHugeRun; });
  std::for_each(huge, runs.end(), [&](Run run) { sort_run(boxes, run, false); });
  tbb::parallel_for(std::ptrdiff_t{0}, huge - runs.begin(),
                    [&](std::ptrdiff_t k) { sort_run(boxes, runs[static_cast<std::size_t>(k)], true); });
}

// Sorts one run in a grid over its own centers, and the long runs that remain again in theirs. Centers at opposite ends
// of a grid fall into different cells, so every round splits the run; it ends when centers coincide.
void SizeTree::sort_run(std::span<const Box> boxes, Run run, bool alone) {
  const std::uint32_t n = run.end - run.begin;
  const std::span<KeyedId> entries = std::span(sorted_).subspan(run.begin, n);
  const std::span<KeyedId> scratch = std::span(scratch_).subspan(run.begin, n);
  Box half_centers = core::empty_box();
  if (alone) {
    half_centers = half_centers_of(boxes, entries);
  } else {
    std::vector<Box> parts(chunk_count(n));
    for_each_chunk(n, [&](std::size_t c, std::size_t begin, std::size_t end) {
      parts[c] = half_centers_of(boxes, entries.subspan(begin, end - begin));
    });
    for (const Box& part : parts) half_centers = united(half_centers, part);
  }
  const core::CurveGrid grid = core::make_curve_grid(half_centers, core::curve_bits(n, core::kCurveBits));
  if (grid.cells_per_m == 0.0F) return;
  const auto no_class = [](const Box&) { return 0U; };
  std::vector<Run> runs;
  if (alone) {
    write_keys(boxes, entries, grid, no_class);
    sort_alone(entries, scratch, 3 * grid.bits);
    find_runs(run.begin, run.end, runs);
    if (runs.size() == 1 && runs[0].end - runs[0].begin == n) return;
    for (const Run inner : runs) sort_run(boxes, inner, true);
    return;
  }
  for_each_chunk(n, [&](std::size_t, std::size_t begin, std::size_t end) {
    write_keys(boxes, entries.subspan(begin, end - begin), grid, no_class);
  });
  key_sort_.sort(entries, scratch, 3 * grid.bits);
  find_runs(run.begin, run.end, runs);
  if (runs.size() == 1 && runs[0].end - runs[0].begin == n) return;
  const auto huge = std::partition(runs.begin(), runs.end(), [](Run r) { return r.end - r.begin < kHugeRun; });
  std::for_each(huge, runs.end(), [&](Run inner) { sort_run(boxes, inner, false); });
  tbb::parallel_for(std::ptrdiff_t{0}, huge - runs.begin(),
                    [&](std::ptrdiff_t k) { sort_run(boxes, runs[static_cast<std::size_t>(k)], true); });
}

}  // namespace broadside::reference
