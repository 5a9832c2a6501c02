// Finds, on the GPU, when features of a moving surface first touch.
#pragma once

#include <cstdint>
#include <vector>

#include "core/continuous/moving_surface.hpp"
#include "gpu/continuous/impact_view.hpp"
#include "gpu/runtime/device_buffer.hpp"

namespace broadside::gpu {

struct ImpactFinderOptions {
  // Queries of one launch. If only the earliest time is asked for, few are better: each launch knows what the launches
  // before it found.
  std::uint32_t queries_a_launch = 1U << 22U;
  std::uint32_t hits = 1U << 16U;  // room for touches that were the earliest when they were found
};

// The time of each pair, in the order of the pairs; kNoTouch if they do not touch.
struct ImpactTimes {
  std::vector<double> vertex_face;
  std::vector<double> edge_edge;
};

// The earliest touch; among equally early ones, that of the lowest kind and pair.
struct FirstHit {
  bool touches = false;
  double time = 1.0;
  continuous::FeatureKind kind = continuous::FeatureKind::kVertexFace;
  continuous::FeaturePair pair;
};

class ImpactFinder {
 public:
  explicit ImpactFinder(const ImpactFinderOptions& options = {}) : options_(options) {}

  // Copies to the device. The pairs must be of these features.
  core::Status load(const continuous::MovingSurface& surface, const continuous::SurfaceFeatures& features,
                    const continuous::FeaturePairs& pairs);
  // Both return when the answers exist on the device; find_earliest copies its one answer to the host.
  core::Status find_times();
  core::Result<FirstHit> find_earliest();
  // The time of the last find, by the device's events around its launches.
  [[nodiscard]] double seconds() const { return seconds_; }
  // Copies the times that find_times found, 8 bytes a pair.
  [[nodiscard]] core::Result<ImpactTimes> read_back() const;

 private:
  core::Status run(bool finds_times);
  core::Status run_kind(ImpactView& view, StreamHandle stream);

  ImpactFinderOptions options_;
  DeviceBuffer<continuous::VertexPath> paths_;
  DeviceBuffer<core::Triangle> triangles_;
  DeviceBuffer<std::array<std::uint32_t, 2>> edges_;
  DeviceBuffer<continuous::FeaturePair> faces_, edge_pairs_;
  DeviceBuffer<double> face_times_, edge_times_;
  DeviceBuffer<std::uint32_t> left_;
  DeviceBuffer<ImpactHit> hits_;
  DeviceBuffer<ImpactCounts> counts_;
  std::uint32_t face_count_ = 0;
  std::uint32_t edge_count_ = 0;
  double seconds_ = 0.0;
};

}  // namespace broadside::gpu
