#include "datasets/box_streams/box_stream.hpp"

#include <array>
#include <charconv>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/nearest_name.hpp"
#include "core/trace/box_file.hpp"
#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/broadmark_boxes.hpp"
#include "datasets/box_streams/check_boxes.hpp"
#include "datasets/box_streams/degenerate_boxes.hpp"
#include "datasets/box_streams/mesh_boxes.hpp"
#include "datasets/box_streams/raw_boxes.hpp"
#include "datasets/box_streams/sheet_boxes.hpp"
#include "datasets/box_streams/thin_boxes.hpp"
#include "datasets/box_streams/uneven_boxes.hpp"
#include "datasets/generators/scene_options.hpp"

namespace broadside::datasets {
namespace {

using core::Error;
using core::Result;

// 24 bytes per box: 24 GB in all, a small part of the memory of machines that run such sets.
constexpr std::uint32_t kMaxBoxes = 1'000'000'000;
// Part of the set's definition: long enough for an engine that uses frame coherence to settle.
constexpr std::uint32_t kMovingFrames = 100;

BoxStream one_frame(std::vector<core::Box> boxes) {
  BoxStream stream;
  stream.boxes = std::move(boxes);
  return stream;
}

struct BoxSet {
  BoxStreamRow row;
  BoxStream (*make)(std::uint32_t n, std::uint64_t seed);
  std::uint32_t most = kMaxBoxes;
};

// A stream of one frame.
template <auto Make>
BoxStream still(std::uint32_t n, std::uint64_t seed) {
  if constexpr (std::is_invocable_v<decltype(Make), std::uint32_t>) {
    return one_frame(Make(n));
  } else {
    return one_frame(Make(n, seed));
  }
}

template <BroadmarkScene Scene, BroadmarkObjects Objects>
BoxStream broadmark(std::uint32_t n, std::uint64_t seed) {
  return broadmark_boxes(Scene, Objects, n, seed);
}

using enum BroadmarkScene;
using enum BroadmarkObjects;

// All pairs of identical boxes overlap: with this count 450 million of them, 3.6 GB.
constexpr std::uint32_t kMostIdentical = 30'000;

constexpr std::array<BoxSet, 28> kBoxSets{{
    {{"boxes:uniform:N", "boxes:uniform:100000", "boxes of similar size spread evenly, about 8 overlaps each"},
     still<uniform_boxes>},
    {{"boxes:heaps:N", "boxes:heaps:100000", "16 cone-shaped heaps far apart, and 1 % strays over a wide ground"},
     still<heap_boxes>},
    {{"boxes:mixed:N", "boxes:mixed:100000", "sizes from 1 to 1000: a few giants overlap thousands"},
     still<mixed_boxes>},
    {{"boxes:moving:N", "boxes:moving:100000", "uniform, each box moves 1 % of its size a frame, 100 frames"},
     [](std::uint32_t n, std::uint64_t seed) { return moving_boxes(n, seed, kMovingFrames, 0.0); }},
    {{"boxes:teleporting:N", "boxes:teleporting:100000", "moving, and a tenth of the boxes jump elsewhere each frame"},
     [](std::uint32_t n, std::uint64_t seed) { return moving_boxes(n, seed, kMovingFrames, 0.1); }},
    {{"boxes:identical:N", "boxes:identical:1000", "one box N times: every pair overlaps", false},
     still<identical_boxes>,
     kMostIdentical},
    {{"boxes:touching:N", "boxes:touching:1000", "unit cubes on a lattice: neighbors touch and overlap no further",
      false},
     still<touching_boxes>},
    {{"boxes:line:N", "boxes:line:1000", "centers on one line"}, still<line_boxes>},
    {{"boxes:plane:N", "boxes:plane:1000", "centers in one plane"}, still<plane_boxes>},
    {{"boxes:flat:N", "boxes:flat:1000", "points, segments and squares without volume, many of them at one place"},
     still<flat_boxes>},
    {{"boxes:far:N", "boxes:far:1000", "uniform, 1e6 from the origin, where a float's step is 1/16"}, still<far_boxes>},
    {{"boxes:tiny:N", "boxes:tiny:1000", "uniform, a millionth of the size"}, still<tiny_boxes>},
    {{"boxes:subnormal:N", "boxes:subnormal:1000", "uniform, so small that every coordinate is a subnormal float"},
     still<subnormal_boxes>},
    {{"boxes:slivers:N", "boxes:slivers:100000", "a thousand times longer than thick, about 8 overlaps each"},
     still<sliver_boxes>},
    {{"boxes:needles:N", "boxes:needles:100000", "100 m long and 0.1 mm thick in a cube of 100 m: hardly any overlap"},
     still<needle_boxes>},
    {{"boxes:spiral:N", "boxes:spiral:100000", "along a spiral, ever smaller towards its center"}, still<spiral_boxes>},
    {{"boxes:cantor:N", "boxes:cantor:100000", "centers in a Cantor set on each axis"}, still<cantor_boxes>},
    {{"boxes:exponents:N", "boxes:exponents:30000", "places and sizes over all exponents of a float"},
     still<exponent_boxes>},
    {{"boxes:sheet:N", "boxes:sheet:150000", "triangles of a wrinkled cloth that folds, 100 frames", false},
     [](std::uint32_t n, std::uint64_t) { return sheet_boxes(n, kMovingFrames); }},
    {{"broadmark-brownian:cubes:N", "broadmark-brownian:cubes:10000",
      "Broadmark: no gravity, 1 % get a new velocity a frame; tumbling cubes, 300 frames"},
     broadmark<kBrownian, kCubes>},
    {{"broadmark-brownian:spheres:N", "broadmark-brownian:spheres:10000", "the same with spheres of diameter 1"},
     broadmark<kBrownian, kSpheres>},
    {{"broadmark-brownian:assorted:N", "broadmark-brownian:assorted:10000", "the same with sides from 0.1 to 1.9"},
     broadmark<kBrownian, kAssorted>},
    {{"broadmark-freefall:cubes:N", "broadmark-freefall:cubes:10000",
      "Broadmark: tumbling cubes fall, pile up and lie still, 300 frames"},
     broadmark<kFreefall, kCubes>},
    {{"broadmark-freefall:spheres:N", "broadmark-freefall:spheres:10000", "the same with spheres of diameter 1"},
     broadmark<kFreefall, kSpheres>},
    {{"broadmark-freefall:assorted:N", "broadmark-freefall:assorted:10000", "the same with sides from 0.1 to 1.9"},
     broadmark<kFreefall, kAssorted>},
    {{"broadmark-gravity:cubes:N", "broadmark-gravity:cubes:10000",
      "Broadmark: fourfold gravity that turns 1.9 degrees a frame; tumbling cubes, 300 frames"},
     broadmark<kTurningGravity, kCubes>},
    {{"broadmark-gravity:spheres:N", "broadmark-gravity:spheres:10000", "the same with spheres of diameter 1"},
     broadmark<kTurningGravity, kSpheres>},
    {{"broadmark-gravity:assorted:N", "broadmark-gravity:assorted:10000", "the same with sides from 0.1 to 1.9"},
     broadmark<kTurningGravity, kAssorted>},
}};

constexpr BoxStreamRow kMeshStream{"boxes:mesh:NAME[:copies]", "boxes:mesh:bunny:20",
                                   "triangles of a mesh of the catalogue; several copies lie turned, in a heap", true,
                                   false};

Result<BoxStream> from_mesh(const std::string& spec, std::uint64_t seed) {
  Result<std::vector<core::Box>> boxes = mesh_boxes_of(spec.substr(kMeshStream.prefix().size()), seed, kMaxBoxes);
  if (!boxes) return boxes.error();
  BoxStream stream = one_frame(std::move(boxes).value());
  stream.name = spec;
  stream.what = std::string(kMeshStream.what);
  return stream;
}

Result<BoxStream> from_raw_file(const std::string& path) {
  Result<std::vector<core::Box>> boxes = read_raw_boxes(path);
  if (!boxes) return boxes.error();
  return one_frame(std::move(boxes).value());
}

Result<std::vector<core::Box>> checked_frame(core::BoxFile& file, std::uint64_t frame, const std::string& path) {
  Result<std::vector<core::Box>> boxes = file.read(frame);
  if (!boxes) return boxes;
  if (core::Status s = check_boxes(boxes.value(), path + ": frame " + std::to_string(frame)); !s) return s.error();
  return boxes;
}

Result<BoxStream> from_hdf5_file(const std::string& path) {
  Result<core::BoxFile> opened = core::BoxFile::open(path);
  if (!opened) return opened.error();
  const auto file = std::make_shared<core::BoxFile>(std::move(opened).value());
  Result<std::vector<core::Box>> first = checked_frame(*file, 0, path);
  if (!first) return first.error();
  BoxStream stream = one_frame(std::move(first).value());
  stream.frames = static_cast<std::uint32_t>(file->frames());
  stream.advance = [file, path, frame = std::uint64_t{0}](std::vector<core::Box>& boxes) mutable -> core::Status {
    Result<std::vector<core::Box>> next = checked_frame(*file, ++frame, path);
    if (!next) return next.error();
    boxes = std::move(next).value();
    return core::Done{};
  };
  return stream;
}

Result<BoxStream> from_file(const std::string& path) {
  const bool is_hdf5 = path.ends_with(".h5") || path.ends_with(".h5.part");
  Result<BoxStream> stream = is_hdf5 ? from_hdf5_file(path) : from_raw_file(path);
  if (!stream) return stream;
  stream.value().name = path;
  stream.value().what = "boxes of a file";
  return stream;
}

bool names_a_file(const std::string& spec) {
  for (const std::string_view ending : {".boxes", ".bin", ".h5", ".h5.part"})
    if (spec.ends_with(ending)) return true;
  return false;
}

Error unknown_boxes(const std::string& spec) {
  std::vector<std::string_view> known;
  for (const BoxStreamRow& row : box_stream_table()) {
    if (row.example.starts_with(spec + ":"))
      return Error{"it has no number", "boxes '" + spec + "'", "give '" + std::string(row.example) + "', for example"};
    known.push_back(row.example);
  }
  return Error{"no such boxes", "boxes '" + spec + "'",
               core::advise_name(spec, known, "broadside list scenes") +
                   "; or give a box file that ends in .boxes, .bin or .h5"};
}

}  // namespace

std::vector<BoxStreamRow> box_stream_table() {
  std::vector<BoxStreamRow> table;
  table.reserve(std::size(kBoxSets));
  for (const BoxSet& set : kBoxSets) table.push_back(set.row);
  table.push_back(kMeshStream);
  return table;
}

Result<BoxStream> make_box_stream(const std::string& spec, std::optional<std::uint64_t> seed) {
  if (names_a_file(spec)) return from_file(spec);
  if (spec.starts_with(kMeshStream.prefix())) return from_mesh(spec, seed.value_or(kDefaultSeed));
  for (const BoxSet& set : kBoxSets) {
    if (!spec.starts_with(set.row.prefix())) continue;
    const std::string_view digits = std::string_view(spec).substr(set.row.prefix().size());
    std::uint32_t n = 0;
    const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
    if (failed != std::errc() || end != digits.data() + digits.size() || n > set.most)
      return Error{"the number of boxes is '" + std::string(digits) + "'", "boxes '" + spec + "'",
                   "give a whole number from 0 to " + std::to_string(set.most)};
    BoxStream stream = set.make(n, seed.value_or(kDefaultSeed));
    stream.name = spec;
    stream.what = std::string(set.row.what);
    return stream;
  }
  return unknown_boxes(spec);
}

core::Status check_boxes_name(const std::string& spec) {
  if (names_a_file(spec)) return core::Done{};
  for (const BoxStreamRow& row : box_stream_table())
    if (spec.starts_with(row.prefix())) return core::Done{};
  return unknown_boxes(spec);
}

}  // namespace broadside::datasets
