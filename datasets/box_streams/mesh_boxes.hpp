// The boxes of a mesh's triangles, from the catalogue: a real surface, thin and curved, whose neighbors touch.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/math/box.hpp"
#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::datasets {

// A single copy has the coordinates of its file. Several copies are each rotated and placed at random in a cube whose
// side is the mesh's longest side times half the cube root of `copies`: a heap in which surfaces cross. 1 <= copies.
std::vector<core::Box> mesh_boxes(const core::Mesh& mesh, std::uint32_t copies, std::uint64_t seed);

// `given`: "NAME" or "NAME:copies". Errors: an unknown mesh or one that is not on this machine, copies that are not a
// number above zero, more triangles than `most`.
core::Result<std::vector<core::Box>> mesh_boxes_of(const std::string& given, std::uint64_t seed, std::uint32_t most);

}  // namespace broadside::datasets
