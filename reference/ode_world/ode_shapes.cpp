#include "reference/ode_world/ode_shapes.hpp"

#include <ode/ode.h>

#include <utility>

namespace broadside::reference {
namespace {

using plain::Vec;

static_assert(sizeof(dReal) == sizeof(double), "points and planes are given to ODE as doubles");

Vec wide(core::Vec3 v) {
  return {v.x, v.y, v.z};
}

// ODE's convex geom must contain its own origin, so points lie about their mean.
void add_convex(OdeShape& shape) {
  const core::Mesh& mesh = *shape.solid.mesh;
  for (const core::Vec3 v : mesh.vertices) shape.origin = shape.origin + wide(v);
  shape.origin = (1.0 / static_cast<double>(mesh.vertices.size())) * shape.origin;
  for (const core::Vec3 v : mesh.vertices) {
    const Vec p = wide(v) - shape.origin;
    shape.points.insert(shape.points.end(), {p.x, p.y, p.z});
  }
  for (const core::Triangle& t : mesh.triangles) {
    const Vec a = wide(mesh.vertices[t[0]]) - shape.origin;
    const Vec n = plain::cross(wide(mesh.vertices[t[1]]) - wide(mesh.vertices[t[0]]),
                               wide(mesh.vertices[t[2]]) - wide(mesh.vertices[t[0]]));
    const double size = plain::length(n);
    if (!(size > 0.0)) continue;
    const Vec unit = (1.0 / size) * n;
    shape.planes.insert(shape.planes.end(), {unit.x, unit.y, unit.z, plain::dot(unit, a)});
    shape.polygons.insert(shape.polygons.end(), {3U, t[0], t[1], t[2]});
  }
}

void add_triangles(OdeShape& shape) {
  static_assert(sizeof(core::Triangle) == 3 * sizeof(dTriIndex));
  const core::Mesh& mesh = *shape.solid.mesh;
  const dTriMeshDataID data = dGeomTriMeshDataCreate();
  shape.triangles = {data, [](void* made) { dGeomTriMeshDataDestroy(static_cast<dTriMeshDataID>(made)); }};
  dGeomTriMeshDataBuildSingle(data, mesh.vertices.data(), sizeof(core::Vec3), static_cast<int>(mesh.vertices.size()),
                              mesh.triangles.data(), static_cast<int>(3 * mesh.triangles.size()),
                              sizeof(core::Triangle));
}

}  // namespace

OdeShape make_ode_shape(std::shared_ptr<const core::Mesh> mesh, bool convex_as_mesh) {
  OdeShape shape;
  shape.solid = solid_of(std::move(mesh));
  const SolidKind kind = shape.solid.kind;
  if (kind == SolidKind::kCapsule || kind == SolidKind::kCylinder) shape.q = turned_from_z(shape.solid.axis);
  if (kind == SolidKind::kConvex && !convex_as_mesh) add_convex(shape);
  if (kind == SolidKind::kMesh || (kind == SolidKind::kConvex && convex_as_mesh)) add_triangles(shape);
  return shape;
}

dxGeom* make_geom(const OdeShape& shape, dxSpace* space) {
  const Solid& s = shape.solid;
  const core::Vec3 half = s.half_extents;
  switch (s.kind) {
    case SolidKind::kBox:
      return dCreateBox(space, 2.0 * half.x, 2.0 * half.y, 2.0 * half.z);
    case SolidKind::kSphere:
      return dCreateSphere(space, s.radius_m);
    case SolidKind::kCapsule:
      return dCreateCapsule(space, s.radius_m, 2.0 * s.half_length_m);
    case SolidKind::kCylinder:
      return dCreateCylinder(space, s.radius_m, 2.0 * s.half_length_m);
    case SolidKind::kConvex:
    case SolidKind::kMesh:
      break;
  }
  if (shape.triangles != nullptr)
    return dCreateTriMesh(space, static_cast<dTriMeshDataID>(shape.triangles.get()), nullptr, nullptr, nullptr);
  return dCreateConvex(space, shape.planes.data(), static_cast<unsigned>(shape.planes.size() / 4), shape.points.data(),
                       static_cast<unsigned>(shape.points.size() / 3), shape.polygons.data());
}

}  // namespace broadside::reference
