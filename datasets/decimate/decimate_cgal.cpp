#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <array>
#include <exception>
#include <string>
#include <vector>

#include "datasets/decimate/decimate.hpp"

namespace broadside::datasets {
namespace {

// Doubles without exact predicates: the collapse compares costs only, and plain arithmetic gives the same bits
// anywhere.
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
namespace processing = CGAL::Polygon_mesh_processing;
namespace simplification = CGAL::Surface_mesh_simplification;

// CGAL's own stop rule counts edges, which determine the number of triangles only where there is no boundary.
class AtMostTriangles {
 public:
  explicit AtMostTriangles(std::uint64_t triangles) : triangles_(triangles) {}

  template <typename Cost, typename Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
    return profile.surface_mesh().number_of_faces() <= triangles_;
  }

 private:
  std::uint64_t triangles_;
};

core::Result<Surface> surface_of(const core::Mesh& mesh) {
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> faces;
  points.reserve(mesh.vertices.size());
  faces.reserve(mesh.triangles.size());
  for (const core::Vec3 v : mesh.vertices) points.emplace_back(double{v.x}, double{v.y}, double{v.z});
  for (const core::Triangle& t : mesh.triangles) faces.push_back({t[0], t[1], t[2]});
  if (!processing::is_polygon_soup_a_polygon_mesh(faces)) processing::orient_polygon_soup(points, faces);
  if (!processing::is_polygon_soup_a_polygon_mesh(faces))
    return core::Error{"its triangles do not form an orientable surface", "mesh " + mesh.name, "repair the mesh"};
  Surface surface;
  processing::polygon_soup_to_polygon_mesh(points, faces, surface);
  return surface;
}

core::Mesh mesh_of(Surface& surface) {
  surface.collect_garbage();
  core::Mesh mesh;
  for (const auto v : surface.vertices()) {
    const Point& p = surface.point(v);
    mesh.vertices.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  for (const auto f : surface.faces()) {
    core::Triangle t{};
    int corner = 0;
    for (const auto v : CGAL::vertices_around_face(surface.halfedge(f), surface))
      t[corner++] = static_cast<std::uint32_t>(static_cast<std::size_t>(v));
    mesh.triangles.push_back(t);
  }
  return mesh;
}

core::Result<core::Mesh> collapsed(const core::Mesh& mesh, std::uint64_t triangles) {
  core::Result<Surface> made = surface_of(mesh);
  if (!made) return made.error();
  Surface& surface = made.value();
  const simplification::GarlandHeckbert_plane_policies<Surface, Kernel> quadrics(surface);
  simplification::edge_collapse(surface, AtMostTriangles(triangles),
                                CGAL::parameters::get_cost(quadrics.get_cost())
                                    .filter(simplification::Bounded_normal_change_filter<>())
                                    .get_placement(quadrics.get_placement()));
  if (surface.number_of_faces() > triangles)
    return core::Error{"it cannot be brought below " + std::to_string(surface.number_of_faces()) + " triangles",
                       "mesh " + mesh.name, "ask for more"};
  core::Mesh result = mesh_of(surface);
  result.name = mesh.name;
  result.source = mesh.source;
  result.is_stand_in = mesh.is_stand_in;
  return result;
}

}  // namespace

bool can_decimate() {
  return true;
}

core::Result<core::Mesh> decimated(const core::Mesh& mesh, std::uint64_t triangles) {
  try {
    return collapsed(mesh, triangles);
  } catch (const std::exception& e) {
    return core::Error{std::string("decimation failed: ") + e.what(), "mesh " + mesh.name, "repair the mesh",
                       core::Exit::kInternal};
  }
}

}  // namespace broadside::datasets
