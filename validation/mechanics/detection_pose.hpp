// The pose that boxes, gaps and points of a frame belong to, as the declaration says.
#pragma once

#include <optional>

#include "core/trace/trace_header.hpp"
#include "validation/mechanics/motion.hpp"

namespace broadside::validation {

struct DetectionPose {
  Vec3d origin;  // of the mesh, m
  Quatd q;       // unit
};

// From the recorded detection where there is one, else from the start or the end of the step. Nothing when a pose
// midway was declared and not recorded.
inline std::optional<DetectionPose> detection_pose(const core::TraceHeader& header, const core::FrameRecord& frame,
                                                   const Motion& m, std::size_t body) {
  const auto at = header.declaration.text("detection_at");
  const bool is_start = at == "start" || at == "within";
  const BodyState& state = is_start ? m.bodies[body].before : m.bodies[body].after;
  DetectionPose pose{state.origin, state.q};
  const bool has_position = frame.detected_position.size() == m.bodies.size();
  if (!has_position && header.declaration.text("detection_at") == "midway") return std::nullopt;
  if (has_position) pose.origin = Vec3d(frame.detected_position[body]);
  if (frame.detected_orientation.size() == m.bodies.size())
    pose.q = normalized(to_quatd(frame.detected_orientation[body]));
  return pose;
}

}  // namespace broadside::validation
