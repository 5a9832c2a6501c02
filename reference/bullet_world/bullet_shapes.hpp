// The scene's meshes as Bullet's collision shapes: the primitive that a mesh draws, its hull when it is convex, and
// otherwise what the setting says.
#pragma once

#include <memory>
#include <string>

#include "core/scene/mesh.hpp"

class btCollisionShape;

namespace broadside::reference {

enum class BulletMesh {
  kGimpact,     // the triangles themselves: btGImpactMeshShape
  kHull,        // the convex hull of the vertices
  kTetrahedra,  // a convex decomposition: a compound with one tetrahedron behind every triangle
};

struct BulletShapeOptions {
  BulletMesh mesh = BulletMesh::kGimpact;
  // By how much hulls and triangles are thickened, m. Boxes keep their size and get rounded edges; spheres and capsules
  // do not change.
  float margin_m = 0.0F;
};

struct BulletShape {
  std::shared_ptr<btCollisionShape> shape;
  std::shared_ptr<void> behind;  // what the shape refers to and does not own
  std::string what;              // "box", "GImpact triangle mesh"
  std::string differs;           // from the scene's mesh: "true sphere, facets up to 1.2 mm inside"; or empty
};

// The mesh is kept alive by the shape. Throws what Bullet or memory throws.
BulletShape make_bullet_shape(std::shared_ptr<const core::Mesh> mesh, const BulletShapeOptions& options);

}  // namespace broadside::reference
