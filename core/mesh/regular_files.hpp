// assimp opens files only through this: regular files of bounded size, so that a mesh that names a FIFO or a device as
// its material or buffer cannot make the reader wait or read without end.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace Assimp {
class IOSystem;
}

namespace broadside::core {

// A file that is not regular or exceeds kMaxMeshFileBytes cannot be opened.
std::unique_ptr<Assimp::IOSystem> regular_files();
// The same, but where assimp opens `path` it reads `content`.
std::unique_ptr<Assimp::IOSystem> regular_files(const std::filesystem::path& path, std::string content);

// Whether it is a regular file of at most kMaxMeshFileBytes, links followed.
bool is_regular_and_bounded(const std::filesystem::path& path);

}  // namespace broadside::core
