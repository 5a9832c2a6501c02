// A mesh as a small raster of brightness: hidden surfaces removed, smoothly shaded.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/mesh.hpp"
#include "reports/plots/model_picture.hpp"

namespace broadside::reports::plots {

// The square of the projection plane that the raster shows; the same unit as the mesh.
struct Window {
  double left = 0.0;
  double top = 0.0;  // largest y
  double side = 1.0;
};

struct Raster {
  std::uint32_t side = 0;         // cells per row and column
  std::vector<float> brightness;  // [row * side + column], row 0 on top; 0 to 1, negative = nothing there
};

// Each cell is the mean over the finer cells of a depth buffer, so that hundreds of thousands of triangles do not
// flicker from cell to cell. Light comes from the eye's upper left.
Raster shade_model(const core::Mesh& mesh, const View& view, const Window& window, std::uint32_t side);

// How bright the raster shows a surface of this normal, which is in the mesh's axes: from 0.3 in the shade to 1.
double brightness_toward(core::Vec3 normal, const View& view);

}  // namespace broadside::reports::plots
