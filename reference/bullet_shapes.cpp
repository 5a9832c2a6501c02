// Bullet's GJK and EPA on the shapes that bullet-world gives the scene's meshes: signed distance in float.
#include "reference/bullet_world/bullet_shapes.hpp"

#include <BulletCollision/CollisionShapes/btCollisionMargin.h>
#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/primitive.hpp"
#include "reference/bullet_margin.hpp"
#include "reference/bullet_vectors.hpp"
#include "reference/engines.hpp"
#include "reference/pair_check.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"
#include "reference/vendor_defects.hpp"

namespace broadside::reference {
namespace {

using core::Separation;
using core::Status;

constexpr std::string_view kBulletShapesId = "bullet-shapes";

// Which branch btGjkPairDetector took, by the numbers in its source.
constexpr int kNormalOfDistance = 6;
constexpr int kNormalOfDistanceTurnedRound = 10;

class BulletShapes final : public core::NarrowPhase {
 public:
  BulletShapes(const BulletShapeOptions& options, SharedDefectCounter near_normals)
      : options_(options), near_normals_(std::move(near_normals)) {}

  Status load(const core::Scene& scene) override {
    return vendor_call("bullet-shapes: load", [&]() -> Status {
      shapes_.clear();
      mesh_of_body_.clear();
      for (const auto& mesh : scene.meshes) {
        if (!core::primitive_of(*mesh) && !core::is_convex(*mesh)) return no_shape(kBulletShapesId, *mesh);
        shapes_.push_back(make_bullet_shape(mesh, options_));
      }
      for (const core::Body& body : scene.bodies) mesh_of_body_.push_back(body.mesh);
      return core::Done{};
    });
  }

  Status measure(std::span<const core::Pair> pairs, std::span<const core::Pose> poses) override {
    if (Status status = check_pairs(kBulletShapesId, pairs, poses, mesh_of_body_.size()); !status) return status;
    separations_.assign(pairs.size(), {});
    return vendor_call("bullet-shapes: measure", [&]() -> Status {
      for (std::size_t k = 0; k < pairs.size(); ++k)
        separations_[k] = measure_one(shape(pairs[k].i), shape(pairs[k].j), poses[pairs[k].i], poses[pairs[k].j]);
      return core::Done{};
    });
  }

  core::Result<std::vector<Separation>> read_back() override { return separations_; }

 private:
  [[nodiscard]] const btConvexShape& shape(std::uint32_t body) const {
    return static_cast<const btConvexShape&>(*shapes_[mesh_of_body_[body]].shape);
  }

  static bool is_in_frame_of_a(int method) {
    return method == kNormalOfDistance || method == kNormalOfDistanceTurnedRound;
  }

  Separation measure_one(const btConvexShape& a, const btConvexShape& b, const core::Pose& pose_a,
                         const core::Pose& pose_b) {
    btGjkPairDetector detector(&a, &b, &simplex_, &depth_);
    btDiscreteCollisionDetectorInterface::ClosestPointInput input;
    input.m_transformA = bullet_transform(pose_a.position, pose_a.orientation);
    input.m_transformB = bullet_transform(pose_b.position, pose_b.orientation);
    btPointCollector found;
    detector.getClosestPoints(input, found, nullptr);
    near_normals_->note(found.m_hasResult && found.m_distance > 0 && is_in_frame_of_a(detector.m_lastUsedMethod) &&
                                pose_a.orientation != core::Quat{}
                            ? 1
                            : 0,
                        1);
    Separation out;
    if (!found.m_hasResult) {
      out.distance_m = std::numeric_limits<double>::quiet_NaN();
      return out;
    }
    out.distance_m = found.m_distance;
    out.is_touching = found.m_distance <= 0;
    out.normal = to_core(found.m_normalOnBInWorld);  // from B to A, as ours
    out.witness_b = to_core(found.m_pointInWorld);
    out.witness_a = out.witness_b + found.m_distance * out.normal;
    return out;
  }

  BulletShapeOptions options_;
  SharedDefectCounter near_normals_;
  std::vector<BulletShape> shapes_;
  std::vector<std::uint32_t> mesh_of_body_;
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver depth_;
  std::vector<Separation> separations_;
};

std::span<const core::SettingRow> bullet_shapes_settings() {
  static const std::array<core::SettingRow, 1> kSettings{{
      {"margin",
       "0",
       {"bullet", core::kMeters},
       "rounds the edges of boxes and thickens hulls: meters, or what Bullet ships (0.04 m)"},
  }};
  return kSettings;
}

core::EquivalenceCard bullet_shapes_card(const core::Scene& scene, const BulletShapeOptions& options) {
  core::EquivalenceCard card = bullet_card();
  for (const auto& mesh : scene.meshes) {
    const BulletShape shape = make_bullet_shape(mesh, options);
    card.push_back({"shape of " + mesh->name, shape.what, shape.differs});
  }
  card.push_back(shape_margin_fact(options.margin_m));
  card.push_back({"tolerance", "1e-6 of the squared distance in GJK, 1e-4 of the depth in EPA", "none"});
  return card;
}

core::Result<core::Engine> create_bullet_shapes(const core::Settings& settings) {
  const BulletShapeOptions options{.margin_m = margin_m_of(settings, CONVEX_DISTANCE_MARGIN)};
  const auto near_normals = std::make_shared<DefectCounter>(Defect::kBulletNearNormal);
  core::Engine engine;
  engine.id = kBulletShapesId;
  engine.build = bullet_build();
  engine.settings = settings;
  engine.narrow_phase = std::make_unique<BulletShapes>(options, near_normals);
  engine.equivalence = [options](const core::Scene& scene) { return bullet_shapes_card(scene, options); };
  engine.defects = defects_of(near_normals);
  return engine;
}

}  // namespace

core::EngineRow bullet_shapes_row() {
  return {.id = kBulletShapesId,
          .capabilities = "narrow",
          .what = "Bullet's GJK and EPA on boxes, spheres, capsules and convex meshes: signed distance",
          .settings = bullet_shapes_settings(),
          .runs_in_child = true,
          .create = create_bullet_shapes,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
