// Device memory of what does not change during a run of turning bodies: shapes with their tables, masses, materials,
// wrenches, faces.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/rigid_bodies.hpp"
#include "core/scene/scene.hpp"
#include "gpu/rigid/device_table.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/runtime/device_buffer.hpp"

namespace broadside::gpu {

class RigidScene {
 public:
  core::Status load(const core::Scene& scene, const core::RigidBodies& bodies);
  void fill(RigidFrameView& view) const;
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  // Where the arrays of one shape begin in the tables.
  struct Places {
    std::size_t vertices = 0;
    std::size_t faces = 0;
    std::size_t corners = 0;
    std::size_t edges = 0;
    std::size_t ways = 0;
    std::size_t guide = 0;
    std::size_t beyond = 0;
    std::size_t triangles = 0;
    std::size_t normals = 0;
    std::size_t least_facing = 0;
    std::size_t nodes = 0;
    std::size_t tree_boxes = 0;
    std::size_t leaf_begin = 0;
    std::size_t tree_vertices = 0;
    std::size_t levels = 0;
  };
  Places add_tables(const core::RigidShape& shape);
  core::Status upload_tables();
  [[nodiscard]] RigidShapeView view_of(const core::RigidShape& shape, const Places& at) const;

  DeviceTable<core::Vec3> vectors_;
  DeviceTable<std::uint32_t> indices_;
  DeviceTable<float> numbers_;
  DeviceTable<core::HullFace> faces_;
  DeviceTable<core::HullEdge> edges_;
  DeviceTable<core::HullWay> ways_;
  DeviceTable<core::TriangleNode> nodes_;
  DeviceTable<core::Box> boxes_;
  DeviceTable<core::NodeBoxes> levels_;
  DeviceBuffer<RigidShapeView> shapes_;
  DeviceBuffer<std::uint32_t> shape_of_body_;
  DeviceBuffer<std::uint8_t> is_swept_;
  DeviceBuffer<core::RigidMass> mass_;
  DeviceBuffer<core::Material> material_;
  DeviceBuffer<core::RigidWrench> wrench_;
  DeviceBuffer<core::ContactShape> face_shapes_;
  DeviceBuffer<core::ContactPose> face_poses_;
  bool has_wrenches_ = false;
};

}  // namespace broadside::gpu
