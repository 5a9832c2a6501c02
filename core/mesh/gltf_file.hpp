// The two parts of a glTF file: its JSON text and, in a .glb, the binary body behind it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace broadside::core {

struct GltfFile {
  std::string bytes;
  std::string_view json;  // within bytes
  std::string_view body;  // within bytes; empty in a .gltf
  bool is_binary = false;

  GltfFile() = default;
  GltfFile(const GltfFile&) = delete;  // the views point into bytes
  GltfFile& operator=(const GltfFile&) = delete;
};

// Checks every length in a .glb's header against the file's size before anything is allocated for it (glTF 2.0, 4.4).
// Error: what is wrong, in one line.
Status read_gltf_file(const std::filesystem::path& path, bool is_binary, GltfFile& file);

// A file of the same kind with this text in place of its own JSON.
std::string with_json(const GltfFile& file, std::string json);

}  // namespace broadside::core
