#include "core/scene/contact_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/exact/convex_hull.hpp"
#include "core/scene/hull_faces.hpp"
#include "core/scene/primitive.hpp"
#include "core/scene/triangle_tree.hpp"

namespace broadside::core {
namespace {

float farthest_m(std::span<const Vec3> points) {
  double most = 0.0;
  for (const Vec3 p : points) {
    const double squared =
        static_cast<double>(p.x) * p.x + static_cast<double>(p.y) * p.y + static_cast<double>(p.z) * p.z;
    most = std::max(most, squared);
  }
  return std::nextafterf(static_cast<float>(std::sqrt(most)), std::numeric_limits<float>::infinity());
}

ContactShape of_primitive(const Primitive& p) {
  ContactShape out;
  constexpr std::array kKinds{ContactKind::kBox, ContactKind::kSphere, ContactKind::kCapsule, ContactKind::kCylinder};
  out.kind = kKinds[static_cast<std::size_t>(p.kind)];
  out.axis = p.axis;
  out.half = p.half_extents;
  out.radius_m = p.radius_m;
  const bool is_long = p.kind == PrimitiveKind::kCapsule || p.kind == PrimitiveKind::kCylinder;
  out.half_length_m = is_long ? p.half_length_m() : 0.0F;
  const std::array corner{p.half_extents};
  // A box reaches its corners. Radius plus half length is exact for a sphere and a capsule, and no less than a
  // cylinder's reach.
  if (p.kind == PrimitiveKind::kBox) out.size_m = farthest_m(corner);
  if (p.kind != PrimitiveKind::kBox) out.size_m = out.radius_m + out.half_length_m;
  return out;
}

class Builder {
 public:
  Builder(const Scene& scene, std::span<const MassProperties> mass) : scene_(scene), mass_(mass) {}

  Result<ContactShapes> build() {
    std::map<std::pair<std::uint32_t, std::array<double, 3>>, std::uint32_t> known;
    for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
      const std::uint32_t mesh = scene_.bodies[i].mesh;
      const auto [found, is_new] =
          known.emplace(std::pair{mesh, mass_[i].center_of_mass_m}, static_cast<std::uint32_t>(out_.shapes.size()));
      out_.shape_of_body.push_back(found->second);
      if (!is_new) continue;
      auto shape = shape_of(mesh);
      if (!shape) return shape.error();
      const auto& c = mass_[i].center_of_mass_m;
      shape.value().center = {-static_cast<float>(c[0]), -static_cast<float>(c[1]), -static_cast<float>(c[2])};
      out_.shapes.push_back(shape.value());
      out_.mesh_of_shape.push_back(mesh);
    }
    point_into_tables();
    return std::move(out_);
  }

 private:
  // Where the hull of a mesh begins in the tables; the same mesh with another center of mass shares the hull.
  struct HullPlace {
    std::size_t vertex = 0;
    std::size_t face = 0;
    std::size_t corner = 0;
    std::size_t edge = 0;
    std::size_t ways = 0;
    std::size_t guide = 0;
    ContactShape shape;
  };
  struct MeshPlace {
    std::size_t vertex = 0;
    std::size_t triangle = 0;
    std::size_t node = 0;
    ContactShape shape;
  };

  Result<ContactShape> shape_of(std::uint32_t index) {
    const Mesh& mesh = *scene_.meshes[index];
    if (const auto primitive = primitive_of(mesh)) return of_primitive(*primitive);
    if (const auto known = hulls_.find(index); known != hulls_.end()) return known->second.shape;
    if (is_convex(mesh)) return add_hull(index, mesh);
    auto solid = uniform_solid(mesh, 1.0);
    if (solid && solid.value().solid == Solid::kHull)
      if (const auto hull = exact::convex_hull(mesh.vertices)) return add_hull(index, *hull);
    if (const auto known = meshes_.find(index); known != meshes_.end()) return known->second.shape;
    return add_mesh(index, mesh, solid && solid.value().solid == Solid::kMesh);
  }

  Result<ContactShape> add_mesh(std::uint32_t index, const Mesh& mesh, bool is_closed) {
    const TriangleTables tables = triangle_tables(mesh);
    if (tables.normals.empty())
      return Error{"no triangle of the mesh has an area", "mesh " + mesh.name, "give a mesh with a surface"};
    MeshPlace place{out_.mesh_vertices.size(), out_.mesh_normals.size(), out_.mesh_nodes.size(), {}};
    append(out_.mesh_vertices, mesh.vertices);
    append(out_.mesh_triangles, tables.triangles);
    append(out_.mesh_normals, tables.normals);
    append(out_.mesh_least_facing, tables.least_facing);
    append(out_.mesh_nodes, tables.nodes);
    place.shape.kind = ContactKind::kMesh;
    place.shape.mesh.is_closed = is_closed;
    place.shape.size_m = farthest_m(mesh.vertices);
    place.shape.mesh.vertex_count = static_cast<std::uint32_t>(mesh.vertices.size());
    place.shape.mesh.triangle_count = static_cast<std::uint32_t>(tables.normals.size());
    place.shape.mesh.node_count = static_cast<std::uint32_t>(tables.nodes.size());
    meshes_.emplace(index, place);
    return place.shape;
  }

  template <typename Table>
  static void append(Table& all, const Table& these) {
    all.insert(all.end(), these.begin(), these.end());
  }

  ContactShape add_hull(std::uint32_t index, const Mesh& convex) {
    const HullTables tables = hull_tables(convex);
    HullPlace place{out_.hull_vertices.size(),
                    out_.hull_faces.size(),
                    out_.hull_corners.size(),
                    out_.hull_edges.size(),
                    out_.hull_ways.size(),
                    out_.hull_guides.size(),
                    {}};
    append(out_.hull_vertices, tables.vertices);
    append(out_.hull_faces, tables.faces);
    append(out_.hull_corners, tables.corners);
    append(out_.hull_edges, tables.edges);
    append(out_.hull_ways, tables.ways);
    append(out_.hull_guides, tables.guide);
    append(out_.hull_beyond, tables.beyond);
    place.shape.kind = ContactKind::kHull;
    place.shape.size_m = farthest_m(tables.vertices);
    place.shape.hull.vertex_count = static_cast<std::uint32_t>(tables.vertices.size());
    place.shape.hull.face_count = static_cast<std::uint32_t>(tables.faces.size());
    place.shape.hull.edge_count = static_cast<std::uint32_t>(tables.edges.size());
    hulls_.emplace(index, place);
    return place.shape;
  }

  void point_into_tables() {
    for (std::size_t k = 0; k < out_.shapes.size(); ++k) {
      if (out_.shapes[k].kind == ContactKind::kMesh) {
        const MeshPlace& place = meshes_.at(out_.mesh_of_shape[k]);
        MeshView& mesh = out_.shapes[k].mesh;
        mesh.vertices = out_.mesh_vertices.data() + place.vertex;
        mesh.triangles = out_.mesh_triangles.data() + 3 * place.triangle;
        mesh.normals = out_.mesh_normals.data() + place.triangle;
        mesh.least_facing = out_.mesh_least_facing.data() + place.triangle;
        mesh.nodes = out_.mesh_nodes.data() + place.node;
      }
      if (out_.shapes[k].kind != ContactKind::kHull) continue;
      const HullPlace& place = hulls_.at(out_.mesh_of_shape[k]);
      HullView& hull = out_.shapes[k].hull;
      hull.vertices = out_.hull_vertices.data() + place.vertex;
      hull.faces = out_.hull_faces.data() + place.face;
      hull.corners = out_.hull_corners.data() + place.corner;
      hull.edges = out_.hull_edges.data() + place.edge;
      hull.ways = out_.hull_ways.data() + place.ways;
      hull.guide = out_.hull_guides.data() + place.guide;
      hull.beyond = out_.hull_beyond.data() + place.corner;
    }
  }

  const Scene& scene_;
  std::span<const MassProperties> mass_;
  std::map<std::uint32_t, HullPlace> hulls_;
  std::map<std::uint32_t, MeshPlace> meshes_;
  ContactShapes out_;
};

}  // namespace

Result<ContactShapes> build_contact_shapes(const Scene& scene, std::span<const MassProperties> mass) {
  return Builder(scene, mass).build();
}

}  // namespace broadside::core
