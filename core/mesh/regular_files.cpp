#include "core/mesh/regular_files.hpp"

#include <assimp/MemoryIOWrapper.h>

#include <cstdint>
#include <system_error>

#include "core/mesh/load_mesh.hpp"

namespace broadside::core {

bool is_regular_and_bounded(const std::filesystem::path& path) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed) || failed) return false;
  const auto size = std::filesystem::file_size(path, failed);
  return !failed && size <= kMaxMeshFileBytes;
}

bool RegularFiles::Exists(const char* file) const {
  return (!path_.empty() && path_ == file) || is_regular_and_bounded(file);
}

Assimp::IOStream* RegularFiles::Open(const char* file, const char* mode) {
  if (!path_.empty() && path_ == file)
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(content_.data()), content_.size());
  return is_regular_and_bounded(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
}

}  // namespace broadside::core
