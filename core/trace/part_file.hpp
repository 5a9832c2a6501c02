// The file on disk under an HDF5 file that is being written: NAME.part, locked against a second writer, that keeps
// HDF5 whole when the disk refuses a write. Private to core/trace/*.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <unordered_map>

#include "core/result.hpp"
#include "core/trace/hdf5_handle.hpp"

namespace broadside::core {

// HDF5 1.10 cannot close a file whose last writes fail: identifiers stay open, and the library trips over them when the
// process exits. So HDF5 writes through a driver of ours. The first refused write is remembered and freezes the file on
// disk as a kill at that moment would; that write and all later ones go to pages in memory, which HDF5 reads back as if
// they had been written, so that it always closes cleanly. Whoever writes asks refused() after every flush.
class PartFile {
 public:
  // Creates or empties the file. A missing or unwritable folder, a name that is a folder, and a file that another
  // writer holds are errors.
  static Result<std::unique_ptr<PartFile>> create(const std::filesystem::path& path);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  // File access properties that make H5Fcreate write here. Latest format, no locking of HDF5's own: ours holds longer.
  Handle access_properties();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  // 0, or the errno of the first refused write.
  [[nodiscard]] int refused() const { return refused_; }
  [[nodiscard]] std::uint64_t size() const { return end_; }
  // To disk, with its data; 0 or an errno.
  int sync();
  // From here on writes wait in memory, and reads see them, until release() puts them on disk: first what lies behind
  // the old end, last the page with the superblock and the root group. So a full disk or a kill leaves the file that
  // hold() found. False when the disk refused; the file is then what it was, and refused() stays 0.
  void hold();
  bool release();
  // Forgets what was held.
  void drop();

  // For the driver alone.
  void write_at(std::uint64_t address, const std::byte* data, std::size_t size);
  [[nodiscard]] bool read_at(std::uint64_t address, std::byte* data, std::size_t size) const;
  void resize(std::uint64_t size);

 private:
  static constexpr std::size_t kPage = 4096;
  using Page = std::array<std::byte, kPage>;

  PartFile(std::filesystem::path path, int fd) : path_(std::move(path)), fd_(fd) {}
  bool read_disk(std::uint64_t address, std::byte* data, std::size_t size) const;
  // 0, or the errno; address and the rest move on by what was written.
  int write_disk(std::uint64_t& address, const std::byte*& data, std::size_t& size) const;
  void write_pages(std::uint64_t address, const std::byte* data, std::size_t size);

  std::filesystem::path path_;
  int fd_ = -1;
  int refused_ = 0;
  std::uint64_t end_ = 0;
  std::optional<std::uint64_t> held_end_;  // of the file on disk, while writes are held back
  std::unordered_map<std::uint64_t, Page> pages_;
  Handle driver_;
};

// A clear line for an errno met while writing path.
Error disk_error(int code, const std::filesystem::path& path, const std::string& doing);

// Gives a file its final name so that it survives a power cut: renames, then syncs the folder.
Status rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);

// Whether a PartFile, of this process or another, holds the file.
bool is_being_written(const std::filesystem::path& path);

}  // namespace broadside::core
