#include "datasets/mesh/write_ply.hpp"

#include <bit>
#include <cstdint>
#include <string>

#include "core/whole_file.hpp"

namespace broadside::datasets {

core::Status write_ply(const core::Mesh& mesh, const std::filesystem::path& path) {
  static_assert(std::endian::native == std::endian::little, "the bytes are written as they lie in memory");
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  bytes.reserve(bytes.size() + mesh.vertices.size() * sizeof(core::Vec3) + mesh.triangles.size() * 13);
  bytes.append(reinterpret_cast<const char*>(mesh.vertices.data()), mesh.vertices.size() * sizeof(core::Vec3));
  for (const core::Triangle& t : mesh.triangles) {
    bytes += '\3';
    bytes.append(reinterpret_cast<const char*>(t.data()), sizeof t);
  }
  return core::write_whole_file(path, bytes);
}

}  // namespace broadside::datasets
