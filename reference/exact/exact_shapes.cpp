// The arbiter of convex bodies: boxes, spheres, capsules and convex meshes in closed form, in double.
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/version.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/exact/convex_core.hpp"
#include "core/scene/primitive.hpp"
#include "reference/engines.hpp"
#include "reference/exact/exact_point.hpp"
#include "reference/pair_check.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"
#include "reference/worker_count.hpp"

namespace broadside::reference {
namespace {

using core::Separation;
using core::Status;
using exact::ConvexCore;
using exact::Point;
using exact::SignedDistance;

constexpr std::string_view kExactShapesId = "exact-shapes";

class ExactShapes final : public core::NarrowPhase {
 public:
  explicit ExactShapes(int workers) : arena_(workers) {}

  Status load(const core::Scene& scene) override {
    cores_.clear();
    mesh_of_body_.clear();
    for (const auto& mesh : scene.meshes) {
      if (Status status = refuse_cylinder(kExactShapesId, *mesh); !status) return status;
      auto core = exact::convex_core_of(*mesh);
      if (!core) return no_shape(kExactShapesId, *mesh);
      cores_.push_back(std::move(*core));
    }
    for (const core::Body& body : scene.bodies) mesh_of_body_.push_back(body.mesh);
    return core::Done{};
  }

  Status measure(std::span<const core::Pair> pairs, std::span<const core::Pose> poses) override {
    if (Status status = check_pairs(kExactShapesId, pairs, poses, mesh_of_body_.size()); !status) return status;
    separations_.assign(pairs.size(), {});
    return vendor_call("exact-shapes: measure", [&]() -> Status {
      arena_.execute([&] {
        tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t k) {
          const auto [i, j] = pairs[k];
          const SignedDistance found =
              signed_distance(placed(cores_[mesh_of_body_[i]], poses[i]), placed(cores_[mesh_of_body_[j]], poses[j]));
          separations_[k] = {found.distance_m, found.distance_m <= 0.0, to_core(found.normal), to_core(found.on_a),
                             to_core(found.on_b)};
        });
      });
      return core::Done{};
    });
  }

  core::Result<std::vector<Separation>> read_back() override { return separations_; }

 private:
  tbb::task_arena arena_;
  std::vector<ConvexCore> cores_;
  std::vector<std::uint32_t> mesh_of_body_;
  std::vector<Separation> separations_;
};

std::span<const core::SettingRow> exact_shapes_settings() {
  static const std::array<core::SettingRow, 1> kSettings{{
      threads_setting(),
  }};
  return kSettings;
}

core::Result<core::Engine> create_exact_shapes(const core::Settings& settings) {
  core::Engine engine;
  engine.id = kExactShapesId;
  engine.build = "own, double, oneTBB " + std::to_string(TBB_VERSION_MAJOR) + "." + std::to_string(TBB_VERSION_MINOR);
  engine.settings = settings;
  const int workers = worker_count(settings.number("threads"));
  engine.equivalence = [build = engine.build, workers](const core::Scene& scene) {
    core::EquivalenceCard card = own_card(build, "float64", "as the compiler made it", workers);
    for (const auto& mesh : scene.meshes) {
      const auto primitive = core::primitive_of(*mesh);
      card.push_back({"shape of " + mesh->name,
                      std::string(primitive ? core::primitive_word(primitive->kind) : "convex body"),
                      primitive && primitive->facet_gap_m > 0.0F ? "a mesh with facets inside that surface" : ""});
    }
    card.push_back({"shape margin", "none", ""});
    card.push_back({"tolerance", "none: rounding of double", ""});
    return card;
  };
  engine.narrow_phase = std::make_unique<ExactShapes>(workers);
  return engine;
}

}  // namespace

core::EngineRow exact_shapes_row() {
  return {.id = kExactShapesId,
          .capabilities = "narrow",
          .what = "signed distance of boxes, spheres, capsules and convex meshes in closed form: the arbiter of these",
          .settings = exact_shapes_settings(),
          .runs_in_child = true,
          .create = create_exact_shapes,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
