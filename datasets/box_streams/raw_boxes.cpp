#include "datasets/box_streams/raw_boxes.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include "core/whole_file.hpp"
#include "datasets/box_streams/check_boxes.hpp"

namespace broadside::datasets {
namespace {

using core::Box;
using core::Error;

static_assert(std::endian::native == std::endian::little, "the bytes are read and written as they lie in memory");
static_assert(sizeof(Box) == 24);

}  // namespace

core::Result<std::vector<Box>> read_raw_boxes(const std::filesystem::path& path) {
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (status.type() == std::filesystem::file_type::not_found)
    return Error{"no such box file", path.string(), "check the path"};
  if (status.type() != std::filesystem::file_type::regular)
    return Error{"not a file", path.string(), "give a box file"};
  const std::uint64_t size = std::filesystem::file_size(path, failed);
  std::ifstream file(path, std::ios::binary);
  if (failed || !file) return Error{"cannot be read", path.string(), "check its permissions"};
  std::uint32_t count = 0;
  if (size < sizeof count || !file.read(reinterpret_cast<char*>(&count), sizeof count))
    return Error{"the file has " + std::to_string(size) + " bytes, too few for a count", path.string(),
                 "give uint32 n, then n times min xyz, max xyz as float32"};
  if (size != sizeof count + std::uint64_t{count} * sizeof(Box))
    return Error{"it says " + std::to_string(count) + " boxes and has " + std::to_string(size) + " bytes",
                 path.string(), "n boxes take 4 + 24 n bytes"};
  std::vector<Box> boxes(count);
  if (count > 0 && !file.read(reinterpret_cast<char*>(boxes.data()), static_cast<std::streamsize>(count * sizeof(Box))))
    return Error{"cannot be read to its end", path.string(), "check the disk"};
  if (core::Status s = check_boxes(boxes, path.string()); !s) return s.error();
  return boxes;
}

core::Status write_raw_boxes(std::span<const Box> boxes, const std::filesystem::path& path) {
  const auto count = static_cast<std::uint32_t>(boxes.size());
  std::string bytes(sizeof count + boxes.size_bytes(), '\0');
  std::memcpy(bytes.data(), &count, sizeof count);
  if (!boxes.empty()) std::memcpy(bytes.data() + sizeof count, boxes.data(), boxes.size_bytes());
  return core::write_whole_file(path, bytes);
}

}  // namespace broadside::datasets
