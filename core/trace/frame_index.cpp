#include "core/trace/frame_index.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

namespace broadside::core {
namespace {

// The value that HDF5 returns for an unwritten element of /trace/step.
constexpr std::uint64_t kMissingStep = std::numeric_limits<std::uint64_t>::max();

std::uint64_t frames_of(const std::vector<std::uint64_t>& offsets) {
  return offsets.empty() ? 0 : offsets.size() - 1;
}

void shorten(FrameIndex& index, std::uint64_t count) {
  index.steps.resize(count);
  index.times.resize(count);
  index.digests.resize(count);
  for (auto& [records, list] : index.offsets) list.resize(std::min<std::uint64_t>(list.size(), count + 1));
}

void check_proximities(const FrameIndex& index, Hdf5Source& source) {
  const auto given = index.offsets.find(Records::kProximity);
  const auto wanted = index.offsets.find(Records::kConfirmed);
  if (given == index.offsets.end() || wanted == index.offsets.end()) return;
  for (std::uint64_t k = 0; k < index.frame_count(); ++k) {
    const std::uint64_t rows = given->second[k + 1] - given->second[k];
    const std::uint64_t pairs = wanted->second[k + 1] - wanted->second[k];
    if (rows == 0 || rows == pairs) continue;
    return source.fail("/trace/confirmed/proximity_offsets",
                       "frame " + std::to_string(k) + " has " + std::to_string(rows) + " proximities for " +
                           std::to_string(pairs) + " confirmed pairs",
                       "give one per pair or none");
  }
}

}  // namespace

std::uint64_t FrameIndex::rows_before(const Column& column, std::uint64_t frame) const {
  return column.layout == Layout::kRows ? offsets.at(offsets_of(column.records))[frame] : frame;
}

FrameIndex read_index(Hdf5Source& source, std::uint32_t groups) {
  FrameIndex index;
  index.steps = source.whole<std::uint64_t>("/trace/step", Element::kU64, 1);
  index.times = source.whole<double>("/trace/time", Element::kF64, 1);
  index.digests = source.whole<std::uint64_t>("/trace/digest", Element::kU64, 1);
  for (const Column& c : columns())
    if (c.layout == Layout::kOffsets && (c.groups & groups) != 0U)
      index.offsets[c.records] = source.whole<std::uint64_t>(std::string(c.path), c.element, 1);
  return index;
}

void keep_complete(FrameIndex& index) {
  const auto written =
      static_cast<std::uint64_t>(std::find(index.steps.begin(), index.steps.end(), kMissingStep) - index.steps.begin());
  std::uint64_t shortest = std::min<std::uint64_t>({written, index.times.size(), index.digests.size()});
  std::uint64_t longest = std::max<std::uint64_t>({index.steps.size(), index.times.size(), index.digests.size()});
  for (const auto& [records, list] : index.offsets) {
    shortest = std::min(shortest, frames_of(list));
    longest = std::max(longest, frames_of(list));
  }
  index.frames_begun = std::max(index.frames_begun, longest);
  shorten(index, shortest);
}

void keep_reached(FrameIndex& index, const Column& column, const OpenArray& array) {
  std::uint64_t count = index.frame_count();
  if (column.layout == Layout::kRows) {
    while (count > 0 && index.rows_before(column, count) > array.rows) --count;
  } else {
    index.frames_begun = std::max(index.frames_begun, array.rows);
    count = std::min(count, array.rows);
  }
  shorten(index, count);
}

void check_order(const FrameIndex& index, Hdf5Source& source) {
  if (std::adjacent_find(index.steps.begin(), index.steps.end(), std::greater_equal<>()) != index.steps.end())
    source.fail("/trace/step", "steps do not rise", "give the frames in order, each once");
  for (const Column& c : columns()) {
    if (c.layout != Layout::kOffsets || !index.offsets.contains(c.records)) continue;
    const std::vector<std::uint64_t>& list = index.offsets.at(c.records);
    if (!list.empty() && (list.front() != 0 || !std::is_sorted(list.begin(), list.end())))
      source.fail(std::string(c.path), "offsets do not start with 0, or they fall",
                  "give running sums of the frames' row counts");
  }
  check_proximities(index, source);
}

}  // namespace broadside::core
