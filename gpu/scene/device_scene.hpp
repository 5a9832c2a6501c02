// Device memory of those parts of a scene that do not change during a run.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/quat.hpp"
#include "core/scene/scene.hpp"
#include "gpu/broad/broad_buffers.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/runtime/device_buffer.hpp"

namespace broadside::gpu {

struct SceneNeeds {
  float hash_cell_m = 0.0F;           // cell of the spatial hash, if that is the broad phase
  std::uint32_t least_for_cells = 0;  // shapes that fewer bodies have get no cells of near vertices
};

class DeviceScene {
 public:
  core::Status load(const core::Scene& scene, const SceneNeeds& needs);
  // Fills those parts of the view that the scene fixes.
  void fill(FrameView& view) const;

  [[nodiscard]] const core::Quat* orientation() const { return orientation_.data(); }
  // The number of levels of the deepest vertex tree.
  [[nodiscard]] std::uint32_t tree_levels() const { return tree_levels_; }
  // Whether any shape has cells of near vertices.
  [[nodiscard]] bool has_cells() const { return has_cells_; }
  // What the broad phase must know before the first frame. A body's box has the size of its shape's box, wherever the
  // body is.
  [[nodiscard]] const BoxFacts& box_facts() const { return box_facts_; }
  [[nodiscard]] std::uint64_t shape_bytes() const;
  [[nodiscard]] std::uint64_t body_bytes() const;

 private:
  core::Status load_springs(const core::Scene& scene);

  DeviceBuffer<PackedBox> octree_;
  DeviceBuffer<PackedBox> level2_;
  DeviceBuffer<std::uint32_t> level2_count_;
  DeviceBuffer<TreeHeader> trees_;
  DeviceBuffer<PackedBox> tree_nodes_;
  DeviceBuffer<PackedBox> tree_upper_;
  DeviceBuffer<PackedVec3> tree_vertices_;
  DeviceBuffer<NearCells> near_cells_;
  DeviceBuffer<std::uint8_t> near_lower_;
  DeviceBuffer<std::uint32_t> near_lists_;
  DeviceBuffer<NearEntry> near_entries_;
  DeviceBuffer<QuantizedVertex> quantized_;
  std::uint32_t shape_count_ = 0;
  std::uint32_t tree_upper_count_ = 0;
  float extent_m_ = 0.0F;
  DeviceBuffer<std::uint32_t> shape_of_body_;
  DeviceBuffer<core::Material> material_;
  DeviceBuffer<core::Quat> orientation_;
  DeviceBuffer<core::Spring> springs_;
  DeviceBuffer<std::uint32_t> spring_begin_;
  bool has_springs_ = false;
  bool has_cells_ = false;
  std::uint32_t tree_levels_ = 1;
  BoxFacts box_facts_;
};

}  // namespace broadside::gpu
