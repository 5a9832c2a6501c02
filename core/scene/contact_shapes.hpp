// The shapes from which contacts of turning bodies are computed, one for each mesh and center of mass of a scene.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/method/rigid/contact_shape.hpp"
#include "core/result.hpp"
#include "core/scene/mass_properties.hpp"
#include "core/scene/scene.hpp"

namespace broadside::core {

// Owns what the views in `shapes` point to. Each table holds the entries of all shapes, one after another, so a whole
// table can be copied to a device and the views moved by one offset. Moving the object keeps the views valid; copying
// is not allowed.
struct ContactShapes {
  std::vector<ContactShape> shapes;
  std::vector<std::uint32_t> mesh_of_shape;
  std::vector<std::uint32_t> shape_of_body;

  std::vector<Vec3> hull_vertices;
  std::vector<HullFace> hull_faces;
  std::vector<std::uint32_t> hull_corners;
  std::vector<HullEdge> hull_edges;
  std::vector<HullWay> hull_ways;
  std::vector<std::uint32_t> hull_guides;
  std::vector<std::uint32_t> hull_beyond;

  std::vector<Vec3> mesh_vertices;
  std::vector<std::uint32_t> mesh_triangles;
  std::vector<Vec3> mesh_normals;
  std::vector<float> mesh_least_facing;
  std::vector<TriangleNode> mesh_nodes;

  ContactShapes() = default;
  ContactShapes(ContactShapes&&) = default;
  ContactShapes& operator=(ContactShapes&&) = default;
  ContactShapes(const ContactShapes&) = delete;
  ContactShapes& operator=(const ContactShapes&) = delete;
  ~ContactShapes() = default;
};

// mass: one per body, from all_mass_properties. A mesh that primitive_of recognizes becomes that closed-form shape, a
// convex mesh is its own hull, and a mesh that is open or crosses itself is replaced by its hull, as for its inertia
// (hull_notes reports it). Other meshes, and flat ones, are represented by their triangles.
Result<ContactShapes> build_contact_shapes(const Scene& scene, std::span<const MassProperties> mass);

}  // namespace broadside::core
