#include "reference/bullet_world/bullet_shapes.hpp"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/Gimpact/btCompoundFromGimpact.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "core/scene/primitive.hpp"
#include "reference/bullet_vectors.hpp"

namespace broadside::reference {
namespace {

using core::Mesh;

// Depth of the tetrahedra behind a mesh's triangles, as a share of the shortest side of its box: deep enough that
// bodies do not pass through a shell in one step, shallow enough that few stick out on the far side.
constexpr float kTetrahedronDepth = 0.25F;

std::string millimeters(double meters) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", 1e3 * meters);
  return text;
}

// At most this share of the least half side, as Bullet does for its own boxes, so that thin boxes keep their form.
constexpr float kLargestBoxMargin = 0.1F;

float least_of(core::Vec3 v) {
  return std::min({v.x, v.y, v.z});
}

BulletShape primitive_shape(const core::Primitive& p, const BulletShapeOptions& options) {
  BulletShape out;
  out.what = core::primitive_word(p.kind);
  if (p.kind == core::PrimitiveKind::kBox) {
    auto box = std::make_shared<btBoxShape>(bullet(p.half_extents));
    // Bullet's margin of a box lies inside it: the size stays, but to GJK edges and corners are rounded by the margin.
    box->setMargin(std::min(options.margin_m, kLargestBoxMargin * least_of(p.half_extents)));
    if (options.margin_m > 0.0F) out.differs = "sharp edges";
    out.shape = std::move(box);
    return out;
  }
  if (p.kind == core::PrimitiveKind::kSphere) {
    out.shape = std::make_shared<btSphereShape>(p.radius_m);
  } else if (p.kind == core::PrimitiveKind::kCylinder) {
    const btVector3 half(p.half_extents.x, p.half_extents.y, p.half_extents.z);
    std::shared_ptr<btCylinderShape> cylinder;
    if (p.axis == 0) cylinder = std::make_shared<btCylinderShapeX>(half);
    if (p.axis == 1) cylinder = std::make_shared<btCylinderShape>(half);
    if (p.axis == 2) cylinder = std::make_shared<btCylinderShapeZ>(half);
    // As for a box, the margin lies inside.
    cylinder->setMargin(std::min(options.margin_m, kLargestBoxMargin * least_of(p.half_extents)));
    out.shape = std::move(cylinder);
  } else {
    const btScalar height = 2 * p.half_length_m();
    if (p.axis == 0) out.shape = std::make_shared<btCapsuleShapeX>(p.radius_m, height);
    if (p.axis == 1) out.shape = std::make_shared<btCapsuleShape>(p.radius_m, height);
    if (p.axis == 2) out.shape = std::make_shared<btCapsuleShapeZ>(p.radius_m, height);
  }
  out.differs = "a mesh with facets up to " + millimeters(p.facet_gap_m) + " inside that surface";
  return out;
}

BulletShape hull_shape(const Mesh& mesh, const BulletShapeOptions& options, bool is_convex) {
  auto hull = std::make_shared<btConvexHullShape>();
  for (const core::Vec3 v : mesh.vertices) hull->addPoint(bullet(v), false);
  hull->recalcLocalAabb();
  if (!is_convex) hull->optimizeConvexHull();
  hull->setMargin(options.margin_m);
  BulletShape out;
  out.shape = std::move(hull);
  out.what = is_convex ? "convex body" : "hull of the vertices";
  if (!is_convex) out.differs = "a mesh that is not convex";
  return out;
}

// Bullet reads vertices and indices where they are; core's triangles are three 32-bit indices each.
struct Triangles {
  std::shared_ptr<const Mesh> mesh;
  btTriangleIndexVertexArray arrays;

  explicit Triangles(std::shared_ptr<const Mesh> kept)
      : mesh(std::move(kept)),
        arrays(static_cast<int>(mesh->triangles.size()),
               // Bullet takes pointers to non-const, but writes only when it rescales a mesh, which is never asked for.
               const_cast<int*>(reinterpret_cast<const int*>(mesh->triangles.data())), sizeof(core::Triangle),
               static_cast<int>(mesh->vertices.size()), const_cast<btScalar*>(&mesh->vertices.front().x),
               sizeof(core::Vec3)) {
    static_assert(sizeof(core::Triangle) == 3 * sizeof(int) && sizeof(core::Vec3) == 3 * sizeof(btScalar));
  }
};

std::shared_ptr<btGImpactMeshShape> gimpact(Triangles& triangles, float margin_m) {
  auto shape = std::make_shared<btGImpactMeshShape>(&triangles.arrays);
  shape->setMargin(margin_m);
  shape->updateBound();
  return shape;
}

BulletShape gimpact_shape(std::shared_ptr<const Mesh> mesh, const BulletShapeOptions& options) {
  auto triangles = std::make_shared<Triangles>(std::move(mesh));
  BulletShape out;
  out.shape = gimpact(*triangles, options.margin_m);
  out.behind = std::move(triangles);
  out.what = "GImpact triangle mesh";
  return out;
}

// A compound that owns its children; Bullet's own does not.
struct OwningCompound {
  std::unique_ptr<btCompoundShape> compound;

  explicit OwningCompound(btCompoundShape* made) : compound(made) {}
  OwningCompound(const OwningCompound&) = delete;
  OwningCompound& operator=(const OwningCompound&) = delete;
  ~OwningCompound() {
    for (int k = compound->getNumChildShapes() - 1; k >= 0; --k) {
      btCollisionShape* child = compound->getChildShape(k);
      compound->removeChildShapeByIndex(k);
      delete child;
    }
  }
};

BulletShape tetrahedra_shape(std::shared_ptr<const Mesh> mesh, const BulletShapeOptions& options) {
  const core::Box box = core::bounds(*mesh);
  const core::Vec3 size = box.max - box.min;
  Triangles triangles(std::move(mesh));
  const auto surface = gimpact(triangles, 0.0F);
  auto owner = std::make_shared<OwningCompound>(
      btCreateCompoundFromGimpactShape(surface.get(), kTetrahedronDepth * std::min({size.x, size.y, size.z})));
  for (int k = 0; k < owner->compound->getNumChildShapes(); ++k)
    owner->compound->getChildShape(k)->setMargin(options.margin_m);
  owner->compound->recalculateLocalAabb();
  BulletShape out;
  out.shape = {owner, owner->compound.get()};
  out.what = "compound of " + std::to_string(owner->compound->getNumChildShapes()) + " tetrahedra";
  out.differs = "a triangle mesh";
  return out;
}

}  // namespace

BulletShape make_bullet_shape(std::shared_ptr<const Mesh> mesh, const BulletShapeOptions& options) {
  if (const auto primitive = core::primitive_of(*mesh)) return primitive_shape(*primitive, options);
  const bool is_convex = core::is_convex(*mesh);
  if (is_convex || options.mesh == BulletMesh::kHull) return hull_shape(*mesh, options, is_convex);
  if (options.mesh == BulletMesh::kTetrahedra) return tetrahedra_shape(std::move(mesh), options);
  return gimpact_shape(std::move(mesh), options);
}

}  // namespace broadside::reference
