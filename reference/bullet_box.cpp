// Bullet's box against box (the ODE detector) on the axis-aligned boxes of bodies: the shapes of METHOD section 4.
#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "reference/bullet_vectors.hpp"
#include "reference/engines.hpp"
#include "reference/pair_check.hpp"
#include "reference/turned_shapes.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

using core::Separation;
using core::Status;

constexpr std::string_view kBulletBoxId = "bullet-box";

// Keeps the deepest of the contact points.
struct Deepest final : btStorageResult {
  void setShapeIdentifiersA(int, int) override {}
  void setShapeIdentifiersB(int, int) override {}
};

Separation measure_one(const core::Box& box_a, const core::Box& box_b) {
  // The detector takes half extents with the shape's margin included, so the margin changes nothing here.
  const btBoxShape a(bullet(0.5F * (box_a.max - box_a.min)));
  const btBoxShape b(bullet(0.5F * (box_b.max - box_b.min)));
  btDiscreteCollisionDetectorInterface::ClosestPointInput input;
  input.m_transformA.setIdentity();
  input.m_transformB.setIdentity();
  input.m_transformA.setOrigin(bullet(core::center(box_a)));
  input.m_transformB.setOrigin(bullet(core::center(box_b)));
  Deepest deepest;
  btBoxBoxDetector(&a, &b).getClosestPoints(input, deepest, nullptr);
  Separation out;
  if (deepest.m_distance >= btScalar(BT_LARGE_FLOAT)) {
    out.distance_m = std::numeric_limits<double>::quiet_NaN();  // apart: it makes no contact point
    return out;
  }
  out.is_touching = true;
  out.distance_m = deepest.m_distance;
  out.normal = to_core(deepest.m_normalOnSurfaceB);  // from B to A, as ours
  out.witness_b = to_core(deepest.m_closestPointInB);
  out.witness_a = out.witness_b + deepest.m_distance * out.normal;
  return out;
}

class BulletBox final : public core::NarrowPhase {
 public:
  Status load(const core::Scene& scene) override {
    return vendor_call("bullet-box: load", [&]() -> Status {
      boxes_.load(scene);
      return core::Done{};
    });
  }

  Status measure(std::span<const core::Pair> pairs, std::span<const core::Pose> poses) override {
    if (Status status = check_pairs(kBulletBoxId, pairs, poses, boxes_.body_count()); !status) return status;
    separations_.assign(pairs.size(), {});
    return vendor_call("bullet-box: measure", [&]() -> Status {
      const std::vector<const core::Box*> boxes = boxes_.of(pairs, poses);
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto [i, j] = pairs[k];
        separations_[k] =
            measure_one(core::translated(*boxes[i], poses[i].position), core::translated(*boxes[j], poses[j].position));
      }
      return core::Done{};
    });
  }

  core::Result<std::vector<Separation>> read_back() override { return separations_; }

 private:
  TurnedShapes<core::Box> boxes_{
      [](const core::Mesh& mesh, core::Quat q) { return std::make_unique<core::Box>(turned_bounds(mesh, q)); }};
  std::vector<Separation> separations_;
};

core::Result<core::Engine> create_bullet_box(const core::Settings& settings) {
  core::Engine engine;
  engine.id = kBulletBoxId;
  engine.build = bullet_build();
  engine.settings = settings;
  engine.narrow_phase = std::make_unique<BulletBox>();
  engine.equivalence = [](const core::Scene&) {
    core::EquivalenceCard card = bullet_card();
    card.push_back({"shape", "axis-aligned boxes of the bodies", "triangle surfaces"});
    card.push_back({"shape margin", "none", ""});
    card.push_back({"tolerance", "none: separating axes in float32", ""});
    return card;
  };
  return engine;
}

}  // namespace

core::EngineRow bullet_box_row() {
  return {.id = kBulletBoxId,
          .capabilities = "narrow",
          .what = "Bullet's box against box on the axis-aligned boxes of bodies: depth and direction when they meet",
          .settings = {},
          .runs_in_child = true,
          .create = create_bullet_box,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
