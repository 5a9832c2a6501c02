// The only door through which assimp opens files: regular files of bounded size, so that a mesh that names a FIFO or a
// device as its material or buffer cannot make the reader wait or read without end.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <string>

namespace broadside::core {

class RegularFiles final : public Assimp::DefaultIOSystem {
 public:
  RegularFiles() = default;
  // `content` is what assimp reads where it opens `path`.
  RegularFiles(const std::filesystem::path& path, std::string content)
      : path_(path.string()), content_(std::move(content)) {}

  bool Exists(const char* file) const override;
  // Null, which assimp reports as a file that cannot be opened, for what is no regular file or exceeds
  // kMaxMeshFileBytes.
  Assimp::IOStream* Open(const char* file, const char* mode) override;

 private:
  std::string path_;
  std::string content_;
};

// A regular file of at most kMaxMeshFileBytes, links followed.
bool is_regular_and_bounded(const std::filesystem::path& path);

}  // namespace broadside::core
