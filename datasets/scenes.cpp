#include "datasets/scenes.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "core/mesh/clean_mesh.hpp"
#include "core/nearest_name.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "datasets/generators/rigid/rigid_scenes.hpp"
#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/small_scenes.hpp"
#include "datasets/scene_file/import_scene.hpp"
#include "datasets/scene_file/scene_file.hpp"
#include "datasets/scene_name.hpp"

namespace broadside::datasets {
namespace {

using core::Error;
using core::Result;
using core::Scene;

// METHOD section 9: the longest side of every mesh's box. The hash cell of 0.25 m is then a quarter of a body.
constexpr double kLongestSide_m = 1.0;

template <typename Number>
bool reads_as(const std::string& text, Number& out) {
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), out);
  return failed == std::errc() && end == text.data() + text.size();
}

// The options of a name: each is queried once, and any that is left over is an error.
class NameOptions {
 public:
  explicit NameOptions(const SceneName& name) : name_(name) {}

  template <typename Number>
  void number(std::string_view key, Number low, Number high, Number& out) {
    known_.push_back(key);
    const auto given = name_.options.find(key);
    if (given == name_.options.end() || error_) return;
    Number value{};
    if (!reads_as(given->second, value) || !(value >= low && value <= high))
      fail(std::string(key) + " is '" + given->second + "'",
           "give a number from " + text_of(low) + " to " + text_of(high));
    out = value;
  }
  [[nodiscard]] std::optional<Error> finish() {
    for (const auto& [key, value] : name_.options)
      if (!error_ && std::find(known_.begin(), known_.end(), key) == known_.end())
        fail("there is no option '" + key + "'", core::advise_name(key, known_));
    return error_;
  }

 private:
  template <typename Number>
  static std::string text_of(Number value) {
    char digits[32];
    const auto [end, failed] = std::to_chars(digits, digits + sizeof digits, value);
    return std::string(digits, failed == std::errc() ? end : digits);
  }
  void fail(std::string what, std::string advice) {
    error_ = Error{std::move(what), "scene '" + name_.text + "'", std::move(advice)};
  }

  const SceneName& name_;
  std::vector<std::string_view> known_;
  std::optional<Error> error_;
};

constexpr std::uint32_t kMostFrames = 0xFFFFFFFFU;
constexpr std::uint64_t kMostSeed = ~std::uint64_t{0};

Error unknown_scene(const std::string& spec, const std::string& plain) {
  for (const BoxStreamRow& row : box_stream_table())
    if (plain.starts_with(row.prefix()))
      return {"it is a stream of boxes, not a scene", "scene '" + spec + "'", "use 'broadside pairs " + spec + "'"};
  const std::vector<SceneRow> table = scene_table();
  std::vector<std::string_view> known;
  known.reserve(table.size());
  for (const SceneRow& row : table) known.push_back(row.example);
  return {"no such scene", "scene '" + spec + "'",
          core::advise_name(plain, known, "broadside list scenes") +
              "; or give the path of a file that ends in .toml, .gltf or .glb"};
}

Result<Scene> small_scene(const SmallSceneRow& row, const SceneName& name, const SceneOptions& options) {
  Scene scene = row.make();
  NameOptions given(name);
  given.number("seed", std::uint64_t{0}, kMostSeed, scene.seed);
  // With another step, the end time stays the same, unless the number of steps is given too.
  double dt_s = scene.dt_s;
  given.number("dt_s", 1e-6, 1.0, dt_s);
  if (dt_s != scene.dt_s) {
    scene.frames = static_cast<std::uint32_t>(std::max(1.0, std::round(scene.frames * (scene.dt_s / dt_s))));
    scene.dt_s = static_cast<float>(dt_s);
  }
  given.number("frames", 1U, kMostFrames, scene.frames);
  if (const auto error = given.finish()) return *error;
  scene.name = name.text;
  scene.description = std::string(row.what);
  scene.frames = options.frames.value_or(scene.frames);
  scene.seed = options.seed.value_or(scene.seed);
  return scene;
}

Result<Scene> family_scene(const SceneFamily& family, const SceneName& name, const SceneOptions& options) {
  const std::string where = "scene '" + name.text + "'";
  if (name.parts.size() != 3)
    return Error{"the name is not of the form " + std::string(family.pattern), where,
                 "for example " + std::string(family.example)};
  std::uint32_t count = 0;
  if (!reads_as(name.parts[2], count) || count > kMaxBodies)
    return Error{"the number of bodies is '" + name.parts[2] + "'", where,
                 "give a whole number from 0 to " + std::to_string(kMaxBodies)};

  NameOptions given(name);
  std::uint64_t seed = kDefaultSeed;
  std::uint32_t frames = family.frames;
  double longest_side_m = kLongestSide_m;
  given.number("seed", std::uint64_t{0}, kMostSeed, seed);
  given.number("frames", 1U, kMostFrames, frames);
  given.number("longest_side_m", 1e-6, 1e6, longest_side_m);
  std::uint32_t rigid = 0;
  given.number("rigid", 0U, 1U, rigid);
  std::vector<double> knobs;
  for (const SceneKnob& knob : family.knobs) {
    knobs.push_back(knob.usual);
    given.number(knob.key, knob.low, knob.high, knobs.back());
  }
  if (const auto error = given.finish()) return *error;

  Result<core::Mesh> mesh = acquire_mesh(name.parts[1], options.meshes);
  if (!mesh) return mesh.error();
  const auto model = std::make_shared<const core::Mesh>(core::normalized(std::move(mesh).value(), longest_side_m));
  seed = options.seed.value_or(seed);
  Scene scene = family.make({model, count, seed, knobs});
  if (rigid == 1) scene.motion = core::Motion::kRigid;
  scene.name = name.text;
  scene.description = std::string(family.what);
  scene.frames = options.frames.value_or(frames);
  scene.seed = seed;
  return scene;
}

bool is_gltf(std::string_view spec) {
  return spec.ends_with(".gltf") || spec.ends_with(".glb");
}

Result<Scene> imported(const std::string& path, const SceneOptions& options) {
  Result<Scene> scene = import_scene(path);
  if (!scene) return scene;
  scene.value().frames = options.frames.value_or(scene.value().frames);
  scene.value().seed = options.seed.value_or(scene.value().seed);
  return scene;
}

Result<Scene> by_name(const std::string& spec, const SceneOptions& options) {
  const Result<SceneName> parsed = parse_scene_name(spec);
  if (!parsed) return parsed.error();
  const SceneName& name = parsed.value();
  for (const auto& rows : {small_scenes(), rigid_scenes()})
    for (const SmallSceneRow& row : rows)
      if (row.name == name.plain) return small_scene(row, name, options);
  if (const SceneFamily* family = find_family(name.parts[0])) return family_scene(*family, name, options);
  return unknown_scene(spec, name.plain);
}

}  // namespace

std::vector<SceneRow> scene_table() {
  std::vector<SceneRow> table;
  for (const SceneFamily& family : scene_families())
    table.push_back({family.pattern, family.example, family.what, family.knobs});
  for (const auto& rows : {small_scenes(), rigid_scenes()})
    for (const SmallSceneRow& row : rows) table.push_back({row.name, row.name, row.what, {}});
  return table;
}

Result<Scene> make_scene(const std::string& spec, const SceneOptions& options) {
  if (spec.ends_with(".toml")) return read_scene_file(spec, options);
  Result<Scene> scene = is_gltf(spec) ? imported(spec, options) : by_name(spec, options);
  if (!scene) return scene;
  if (core::Status s = core::check_scene(scene.value()); !s) return s.error();
  return scene;
}

}  // namespace broadside::datasets
