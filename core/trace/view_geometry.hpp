// The geometry that is drawn for each body, as points that move with it. Private to core/trace/*.cpp.
#pragma once

#include <vector>

#include "core/scene/body_octree.hpp"
#include "core/scene/scene.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/view_file.hpp"
#include "core/trace/vtkhdf_group.hpp"

namespace broadside::core {

class ViewGeometry {
 public:
  ViewGeometry(const Scene& scene, ViewOf of);

  [[nodiscard]] const VtkTopology& topology() const { return topology_; }
  // For a frame that has the group detection: topology().points points in the world frame, m.
  [[nodiscard]] std::vector<Vec3> points(const FrameRecord& frame) const;

 private:
  void add_box(std::uint32_t body, const Box& box);
  void add_mesh(std::uint32_t body, const Mesh& mesh, const BodyOctree& octree);

  bool is_boxes_;
  VtkTopology topology_;
  std::vector<Vec3> local_;             // relative to the body's position; empty for boxes, which the trace has
  std::vector<std::uint32_t> body_of_;  // the body of each local point
};

}  // namespace broadside::core
