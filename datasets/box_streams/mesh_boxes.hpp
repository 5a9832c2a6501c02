// The triangles' boxes of a mesh of the catalogue: a real surface, thin and curved, whose neighbors touch.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/math/box.hpp"
#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::datasets {

// One copy lies as its file has it. Of more, each is turned at random and put at random in a cube whose side is the
// mesh's longest times half the cube root of `copies`: a heap in which surfaces cross. 1 <= copies.
std::vector<core::Box> mesh_boxes(const core::Mesh& mesh, std::uint32_t copies, std::uint64_t seed);

// `given`: "NAME" or "NAME:copies". Errors: an unknown mesh or one that is not on this machine, a number of copies that
// is none, more triangles than `most`.
core::Result<std::vector<core::Box>> mesh_boxes_of(const std::string& given, std::uint64_t seed, std::uint32_t most);

}  // namespace broadside::datasets
