// A mesh in shaded gray with boxes around it in red wireframe: parallel projection, y upward.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/scene/mesh.hpp"
#include "reports/plots/drawing.hpp"

namespace broadside::reports::plots {

// Where the eye is, in degrees: azimuth 0 looks along -z, growing toward +x; elevation above the horizon.
struct View {
  double azimuth_deg = 30.0;
  double elevation_deg = 18.0;
};

// A point on the picture's plane (x to the right, y up) and how far it is toward the eye.
struct Projected {
  double x = 0.0;
  double y = 0.0;
  double toward_eye = 0.0;
};
Projected project(core::Vec3 point, const View& view);

struct ModelPicture {
  std::string title;        // drawn too
  std::string description;  // for readers who cannot see it
  View view;
};

// Empty boxes are left out; without boxes, the model alone. The mesh is drawn with hidden surfaces removed, in a few
// shades of gray that read on light and dark; edges of a box that its own faces hide are fainter.
std::string svg(const ModelPicture& picture, const core::Mesh& mesh, std::span<const core::Box> boxes,
                Placement placement = Placement::kFile);

}  // namespace broadside::reports::plots
