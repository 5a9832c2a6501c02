// The only door through which assimp opens files: regular files of bounded size, so that a mesh that names a FIFO or a
// device as its material or buffer cannot make the reader wait or read without end.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace Assimp {
class IOSystem;
}

namespace broadside::core {

// A file that is no regular one or exceeds kMaxMeshFileBytes cannot be opened.
std::unique_ptr<Assimp::IOSystem> regular_files();
// The same, but `content` is what assimp reads where it opens `path`.
std::unique_ptr<Assimp::IOSystem> regular_files(const std::filesystem::path& path, std::string content);

// A regular file of at most kMaxMeshFileBytes, links followed.
bool is_regular_and_bounded(const std::filesystem::path& path);

}  // namespace broadside::core
