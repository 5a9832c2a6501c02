// Bullet's convex casts: conservative advancement with rotation, and two casts of translations.
#include <BulletCollision/CollisionShapes/btCollisionMargin.h>
#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/primitive.hpp"
#include "reference/bullet_margin.hpp"
#include "reference/bullet_world/bullet_shapes.hpp"
#include "reference/motion/motion_engines.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

btTransform transform(const exact::RigidMotion& motion, double t) {
  const exact::Placement at = placement_at(motion, t);
  const auto [w, x, y, z] = at.orientation;
  const auto f = [](double v) { return static_cast<btScalar>(v); };
  return btTransform(btQuaternion(f(x), f(y), f(z), f(w)).normalized(),
                     btVector3(f(at.origin.x), f(at.origin.y), f(at.origin.z)));
}

bool turns(const exact::RigidMotion& motion) {
  return length(motion.rotation_rad) > 0.0;
}

class Bodies final : public core::BodyMotionQuery {
 public:
  Bodies(std::string method, const BulletShapeOptions& options) : method_(std::move(method)), options_(options) {}

  core::Status load(std::span<const std::shared_ptr<const core::Mesh>> meshes) override {
    return vendor_call("bullet-cast: load", [&]() -> core::Status {
      shapes_.clear();
      for (const auto& mesh : meshes) {
        if (!core::primitive_of(*mesh) && !core::is_convex(*mesh))
          return core::Error{"mesh '" + mesh->name + "' is no box, sphere, capsule or convex body", "bullet-cast",
                             "ask it about other kinds", core::Exit::kMissing};
        shapes_.push_back(make_bullet_shape(mesh, options_));
      }
      return core::Done{};
    });
  }

  [[nodiscard]] bool follows(const exact::RigidMotion& motion) const override {
    return method_ == "continuous" || !turns(motion);
  }

  core::Result<core::FirstTouch> first_touch(const core::MovingBody& a, const core::MovingBody& b) override {
    return vendor_call("bullet-cast: first touch", [&]() -> core::Result<core::FirstTouch> {
      const auto cast = make_cast(shape(a.mesh), shape(b.mesh));
      btConvexCast::CastResult result;
      result.m_fraction = 1;
      const bool touches = cast->calcTimeOfImpact(transform(a.motion, 0.0), transform(a.motion, 1.0),
                                                  transform(b.motion, 0.0), transform(b.motion, 1.0), result);
      return core::FirstTouch{touches, touches ? static_cast<double>(result.m_fraction) : 1.0};
    });
  }

 private:
  [[nodiscard]] const btConvexShape& shape(std::uint32_t mesh) const {
    return static_cast<const btConvexShape&>(*shapes_[mesh].shape);
  }

  std::unique_ptr<btConvexCast> make_cast(const btConvexShape& a, const btConvexShape& b) {
    if (method_ == "subsimplex") return std::make_unique<btSubsimplexConvexCast>(&a, &b, &simplex_);
    if (method_ == "gjk") return std::make_unique<btGjkConvexCast>(&a, &b, &simplex_);
    return std::make_unique<btContinuousConvexCollision>(&a, &b, &simplex_, &depth_);
  }

  std::string method_;
  BulletShapeOptions options_;
  std::vector<BulletShape> shapes_;
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver depth_;
};

std::span<const core::SettingRow> setting_rows() {
  static const std::array<core::SettingRow, 2> kSettings{{
      {"method",
       "continuous",
       {"continuous", "subsimplex", "gjk"},
       "btContinuousConvexCollision, btSubsimplexConvexCast or btGjkConvexCast; the last two leave turning out"},
      {"margin",
       "0",
       {"bullet", core::kMeters},
       "rounds the edges of boxes and thickens hulls: meters, or what Bullet ships (0.04 m)"},
  }};
  return kSettings;
}

core::Result<core::MotionEngine> create(const core::Settings& settings) {
  core::MotionEngine engine;
  engine.id = "bullet-cast";
  engine.build = bullet_build();
  engine.settings = settings;
  engine.bodies = std::make_unique<Bodies>(
      settings.text("method"), BulletShapeOptions{.margin_m = margin_m_of(settings, CONVEX_DISTANCE_MARGIN)});
  return engine;
}

}  // namespace

core::MotionEngineRow bullet_cast_row() {
  return {"bullet-cast", "Bullet's convex casts: boxes, spheres, capsules and convex bodies", setting_rows(), create};
}

}  // namespace broadside::reference
