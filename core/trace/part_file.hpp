// The file on disk below an HDF5 file that is being written: NAME.part, locked against a second writer. It keeps HDF5
// consistent when the disk refuses a write. Private to core/trace/*.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/result.hpp"
#include "core/trace/hdf5_handle.hpp"
#include "core/trace/page_journal.hpp"

namespace broadside::core {

// HDF5 1.10 cannot close a file whose last writes fail: identifiers stay open, and the library fails on them when the
// process exits. So HDF5 writes through our own driver. The first refused write is remembered, and from then on the
// file on disk stays as a kill at that moment would leave it. That write and all later ones go to pages in memory. HDF5
// reads these back as if they had been written, so that it always closes cleanly. The caller checks refused() after
// every commit.
//
// Between commits, the committed part is not changed: writes past its end go to disk, where nothing refers to them yet,
// and writes into it wait in memory. So a kill at any moment leaves the last commit complete.
class PartFile {
 public:
  // Creates or truncates the file. Errors: a missing or unwritable folder, a name that is a folder, and a file that
  // another writer holds.
  static Result<std::unique_ptr<PartFile>> create(const std::filesystem::path& path);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  // File access properties that make H5Fcreate write here. Latest format, without HDF5's own locking: our lock is held
  // longer.
  Handle access_properties();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  // 0, or the errno of the first refused write.
  [[nodiscard]] int refused() const { return refused_; }
  [[nodiscard]] std::uint64_t size() const { return end_; }
  // Syncs the file with its data to disk. Returns 0 or an errno.
  int sync();
  // Makes everything written since the last commit part of the file. False when the disk refused.
  bool commit();
  // Restores the last commit, also after a refusal. HDF5 must have closed the file.
  void rollback();

  // Used only by the driver.
  void write_at(std::uint64_t address, const std::byte* data, std::size_t size);
  [[nodiscard]] bool read_at(std::uint64_t address, std::byte* data, std::size_t size) const;
  void resize(std::uint64_t size);

 private:
  PartFile(std::filesystem::path path, int fd) : path_(std::move(path)), fd_(fd) {}
  bool read_disk(std::uint64_t address, std::byte* data, std::size_t size) const;
  void write_pages(std::uint64_t address, const std::byte* data, std::size_t size);

  std::filesystem::path path_;
  int fd_ = -1;
  int refused_ = 0;
  std::uint64_t end_ = 0;
  std::uint64_t committed_end_ = 0;
  Pages pages_;
  Handle driver_;
};

// An error for an errno that occurred while writing path.
Error disk_error(int code, const std::filesystem::path& path, const std::string& doing);

// Gives a file its final name such that it survives a power cut: renames it, then syncs the folder.
Status rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);

// Whether a PartFile, of this process or another, holds the file.
bool is_being_written(const std::filesystem::path& path);

}  // namespace broadside::core
