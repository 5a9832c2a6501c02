#include "datasets/box_streams/box_stream.hpp"

#include <array>
#include <charconv>
#include <utility>

#include "core/nearest_name.hpp"
#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/raw_boxes.hpp"
#include "datasets/generators/scene_options.hpp"

namespace broadside::datasets {
namespace {

using core::Error;
using core::Result;

// 24 bytes a box: 2.4 GB, which the machines that such a set is meant for hold many times.
constexpr std::uint32_t kMaxBoxes = 100'000'000;
// The set's definition: long enough for a coherent engine to settle.
constexpr std::uint32_t kMovingFrames = 100;

BoxStream one_frame(std::vector<core::Box> boxes) {
  BoxStream stream;
  stream.boxes = std::move(boxes);
  return stream;
}

struct BoxSet {
  std::string_view prefix;
  BoxStreamRow row;
  BoxStream (*make)(std::uint32_t n, std::uint64_t seed);
};

constexpr std::array<BoxSet, 5> kBoxSets{{
    {"boxes:uniform:",
     {"boxes:uniform:N", "boxes:uniform:100000", "boxes of similar size spread evenly, about 8 overlaps each"},
     [](std::uint32_t n, std::uint64_t seed) { return one_frame(uniform_boxes(n, seed)); }},
    {"boxes:heaps:",
     {"boxes:heaps:N", "boxes:heaps:100000", "16 cone-shaped heaps far apart, and 1 % strays over a wide ground"},
     [](std::uint32_t n, std::uint64_t seed) { return one_frame(heap_boxes(n, seed)); }},
    {"boxes:mixed:",
     {"boxes:mixed:N", "boxes:mixed:100000", "sizes from 1 to 1000: a few giants overlap thousands"},
     [](std::uint32_t n, std::uint64_t seed) { return one_frame(mixed_boxes(n, seed)); }},
    {"boxes:moving:",
     {"boxes:moving:N", "boxes:moving:100000", "uniform, each box moves 1 % of its size a frame, 100 frames"},
     [](std::uint32_t n, std::uint64_t seed) { return moving_boxes(n, seed, kMovingFrames, 0.0); }},
    {"boxes:teleporting:",
     {"boxes:teleporting:N", "boxes:teleporting:100000", "moving, and a tenth of the boxes jump elsewhere each frame"},
     [](std::uint32_t n, std::uint64_t seed) { return moving_boxes(n, seed, kMovingFrames, 0.1); }},
}};

Result<BoxStream> from_file(const std::string& path) {
  Result<std::vector<core::Box>> boxes = read_raw_boxes(path);
  if (!boxes) return boxes.error();
  BoxStream stream = one_frame(std::move(boxes).value());
  stream.name = path;
  stream.what = "boxes of a file";
  return stream;
}

}  // namespace

std::vector<BoxStreamRow> box_stream_table() {
  std::vector<BoxStreamRow> table;
  for (const BoxSet& set : kBoxSets) table.push_back(set.row);
  return table;
}

Result<BoxStream> make_box_stream(const std::string& spec, std::optional<std::uint64_t> seed) {
  if (spec.ends_with(".boxes") || spec.ends_with(".bin")) return from_file(spec);
  for (const BoxSet& set : kBoxSets) {
    if (!spec.starts_with(set.prefix)) continue;
    const std::string_view digits = std::string_view(spec).substr(set.prefix.size());
    std::uint32_t n = 0;
    const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
    if (failed != std::errc() || end != digits.data() + digits.size() || n > kMaxBoxes)
      return Error{"the number of boxes is '" + std::string(digits) + "'", "boxes '" + spec + "'",
                   "give a whole number from 0 to " + std::to_string(kMaxBoxes)};
    BoxStream stream = set.make(n, seed.value_or(kDefaultSeed));
    stream.name = spec;
    stream.what = std::string(set.row.what);
    return stream;
  }
  std::vector<std::string_view> known;
  for (const BoxSet& set : kBoxSets) known.push_back(set.row.example);
  return Error{"no such boxes", "boxes '" + spec + "'",
               core::advise_name(spec, known) + "; or give a raw box file that ends in .boxes or .bin"};
}

}  // namespace broadside::datasets
