#include "datasets/box_streams/mesh_boxes.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "datasets/box_streams/box_of.hpp"
#include "datasets/cube_root.hpp"
#include "datasets/mesh/acquire_mesh.hpp"

namespace broadside::datasets {
namespace {

using core::Box;
using Matrix = std::array<Triple, 3>;

// The matrix of a uniformly drawn unit quaternion, by rejection from the four-dimensional cube.
Matrix drawn_turn(RandomStream& random) {
  for (;;) {
    const Triple v = drawn(random, -1.0, 1.0);
    const double w = random.between(-1.0, 1.0);
    const double squared = ((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]) + w * w;
    if (squared > 1.0 || squared < 1e-4) continue;  // near the center digits would be lost
    const double s = 2.0 / squared;
    const double x = v[0], y = v[1], z = v[2];
    return {{{1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
             {s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)},
             {s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)}}};
  }
}

void add_boxes(const core::Mesh& mesh, const std::vector<core::Vec3>& vertices, std::vector<Box>& boxes) {
  for (const core::Triangle& t : mesh.triangles) {
    Box box = core::empty_box();
    for (const std::uint32_t corner : t) box = core::grown(box, vertices[corner]);
    boxes.push_back(box);
  }
}

}  // namespace

std::vector<Box> mesh_boxes(const core::Mesh& mesh, std::uint32_t copies, std::uint64_t seed) {
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangles.size() * copies);
  if (copies == 1) {
    add_boxes(mesh, mesh.vertices, boxes);
    return boxes;
  }
  const Box whole = core::bounds(mesh);
  double longest = 0.0;
  Triple middle;
  for (int axis = 0; axis < 3; ++axis) {
    longest = std::max(longest, static_cast<double>(whole.max[axis]) - static_cast<double>(whole.min[axis]));
    middle[axis] = 0.5 * (static_cast<double>(whole.min[axis]) + static_cast<double>(whole.max[axis]));
  }
  const double width = 0.5 * longest * cube_root(copies);
  RandomStream random(seed);
  std::vector<core::Vec3> turned(mesh.vertices.size());
  for (std::uint32_t copy = 0; copy < copies; ++copy) {
    const Triple center = drawn(random, 0.0, width);
    const Matrix turn = drawn_turn(random);
    for (std::size_t k = 0; k < turned.size(); ++k) {
      Triple from;
      for (int axis = 0; axis < 3; ++axis) from[axis] = static_cast<double>(mesh.vertices[k][axis]) - middle[axis];
      // Each vertex is rounded only once, so that triangles that share it still touch.
      for (int axis = 0; axis < 3; ++axis)
        turned[k][axis] = static_cast<float>(
            center[axis] + ((turn[axis][0] * from[0] + turn[axis][1] * from[1]) + turn[axis][2] * from[2]));
    }
    add_boxes(mesh, turned, boxes);
  }
  return boxes;
}

core::Result<std::vector<Box>> mesh_boxes_of(const std::string& given, std::uint64_t seed, std::uint32_t most) {
  const std::size_t colon = given.find(':');
  const std::string name = given.substr(0, colon);
  std::uint32_t copies = 1;
  if (colon != std::string::npos) {
    const std::string_view digits = std::string_view(given).substr(colon + 1);
    const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), copies);
    if (failed != std::errc() || end != digits.data() + digits.size() || copies == 0)
      return core::Error{"the number of copies is '" + std::string(digits) + "'", "boxes 'boxes:mesh:" + given + "'",
                         "give a whole number from 1 on"};
  }
  core::Result<core::Mesh> mesh = acquire_mesh(name, MeshOptions::from_environment());
  if (!mesh) return mesh.error();
  const std::uint64_t triangles = std::uint64_t{mesh.value().triangles.size()} * copies;
  if (triangles > most)
    return core::Error{"these are " + std::to_string(triangles) + " triangles", "boxes 'boxes:mesh:" + given + "'",
                       "give fewer copies: there may be " + std::to_string(most) + " boxes"};
  return mesh_boxes(mesh.value(), copies, seed);
}

}  // namespace broadside::datasets
