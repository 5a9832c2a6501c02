// The scene's meshes as ODE's geoms.
#pragma once

#include <memory>
#include <vector>

#include "reference/plain_rigid/linear.hpp"
#include "reference/rigid_world/solid.hpp"

struct dxGeom;
struct dxSpace;

namespace broadside::reference {

// Data of a mesh to which its geoms refer and which they do not own. It must be kept until the geoms are gone.
struct OdeShape {
  Solid solid;
  std::vector<double> planes;  // convex: normal and offset of each triangle
  std::vector<double> points;  // convex: about their mean
  std::vector<unsigned int> polygons;
  std::shared_ptr<void> triangles;  // ODE's data of a mesh
  plain::Vec origin;                // of the geom in mesh coordinates, m
  plain::Quaternion q;              // mesh axes from the geom's
};

OdeShape make_ode_shape(std::shared_ptr<const core::Mesh> mesh, bool convex_as_mesh);

// A new geom in the space, which owns it.
dxGeom* make_geom(const OdeShape& shape, dxSpace* space);

}  // namespace broadside::reference
