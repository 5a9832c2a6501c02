#include "core/mesh/gltf_file.hpp"

#include <fstream>
#include <sstream>
#include <utility>

namespace broadside::core {
namespace {

constexpr std::size_t kHeaderBytes = 12;      // magic, version, length of the whole file
constexpr std::size_t kChunkHeaderBytes = 8;  // length, type
constexpr std::uint32_t kGltfMagic = 0x46546C67U;
constexpr std::uint32_t kJson = 0x4E4F534AU;
constexpr std::uint32_t kBody = 0x004E4942U;

// Little-endian, as everything in a .glb.
std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 4; k-- > 0;) value = value << 8U | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

void append_word(std::string& bytes, std::uint32_t value) {
  for (unsigned k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xFFU);
}

void append_chunk(std::string& bytes, std::uint32_t type, std::string_view content, char padding) {
  const std::size_t padded = (content.size() + 3) / 4 * 4;
  append_word(bytes, static_cast<std::uint32_t>(padded));
  append_word(bytes, type);
  bytes += content;
  bytes.append(padded - content.size(), padding);
}

// Reads the chunk at `at` and moves `at` past it; false when the chunk's length runs past the end of the file.
bool take_chunk(std::string_view bytes, std::size_t& at, std::uint32_t& type, std::string_view& content) {
  if (bytes.size() - at < kChunkHeaderBytes) return false;
  const std::uint32_t length = word_at(bytes, at);
  type = word_at(bytes, at + 4);
  at += kChunkHeaderBytes;
  if (length > bytes.size() - at) return false;
  content = bytes.substr(at, length);
  at += length;
  return true;
}

}  // namespace

Status read_gltf_file(const std::filesystem::path& path, bool is_binary, GltfFile& file) {
  const auto bad = [&](const std::string& what) {
    return Error{"not a readable mesh: " + what, path.string(), "check that the file is whole"};
  };
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  file.bytes = std::move(content).str();
  file.is_binary = is_binary;
  file.json = file.bytes;
  if (!is_binary) return Done{};

  const std::string_view all = file.bytes;
  if (all.size() < kHeaderBytes || word_at(all, 0) != kGltfMagic) return bad("it does not begin with 'glTF'");
  const std::uint32_t version = word_at(all, 4);
  if (version != 2) return bad("its container has version " + std::to_string(version) + ", and version 2 is read here");
  const std::uint32_t length = word_at(all, 8);
  if (length > all.size())
    return bad("its header says " + std::to_string(length) + " bytes, and it has " + std::to_string(all.size()));
  const std::string_view said = all.substr(0, length);
  std::size_t at = kHeaderBytes;
  std::uint32_t type = 0;
  if (length < at || !take_chunk(said, at, type, file.json)) return bad("its JSON chunk is longer than the file");
  if (type != kJson) return bad("its first chunk is not JSON");
  if (at == said.size()) return Done{};
  if (!take_chunk(said, at, type, file.body)) return bad("its second chunk is longer than the file");
  if (type != kBody) file.body = {};  // a chunk of a later extension: readers skip chunks that they do not know
  return Done{};
}

std::string with_json(const GltfFile& file, std::string json) {
  if (!file.is_binary) return json;
  std::string bytes;
  append_word(bytes, kGltfMagic);
  append_word(bytes, 2);
  append_word(bytes, 0);
  append_chunk(bytes, kJson, json, ' ');
  if (!file.body.empty()) append_chunk(bytes, kBody, file.body, '\0');
  std::string length;
  append_word(length, static_cast<std::uint32_t>(bytes.size()));
  bytes.replace(8, 4, length);
  return bytes;
}

}  // namespace broadside::core
