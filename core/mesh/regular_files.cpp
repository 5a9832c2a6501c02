#include "core/mesh/regular_files.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>

#include <cstdint>
#include <system_error>
#include <utility>

#include "core/mesh/load_mesh.hpp"

namespace broadside::core {
namespace {

class RegularFiles final : public Assimp::DefaultIOSystem {
 public:
  RegularFiles(std::string path, std::string content) : path_(std::move(path)), content_(std::move(content)) {}

  bool Exists(const char* file) const override {
    return (!path_.empty() && path_ == file) || is_regular_and_bounded(file);
  }

  // Returns null for a refused file; assimp reports that as a file that cannot be opened.
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (!path_.empty() && path_ == file)
      return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(content_.data()), content_.size());
    return is_regular_and_bounded(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
  }

 private:
  std::string path_;
  std::string content_;
};

}  // namespace

std::unique_ptr<Assimp::IOSystem> regular_files() {
  return regular_files({}, {});
}

std::unique_ptr<Assimp::IOSystem> regular_files(const std::filesystem::path& path, std::string content) {
  return std::make_unique<RegularFiles>(path.string(), std::move(content));
}

bool is_regular_and_bounded(const std::filesystem::path& path) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed) || failed) return false;
  const auto size = std::filesystem::file_size(path, failed);
  return !failed && size <= kMaxMeshFileBytes;
}

}  // namespace broadside::core
