#include "core/trace/part_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <iterator>
#include <system_error>
#include <utility>
#include <vector>

namespace broadside::core {
namespace {

// HDF5's data for an open file. HDF5's own part comes first, as its driver interface demands.
struct DriverFile {
  H5FD_t base;
  PartFile* file;
  haddr_t end_of_allocation;
};

struct DriverInfo {
  PartFile* file;
};

const DriverFile& as_driver(const H5FD_t* f) {
  return *reinterpret_cast<const DriverFile*>(f);
}
DriverFile& as_driver(H5FD_t* f) {
  return *reinterpret_cast<DriverFile*>(f);
}

H5FD_t* driver_open(const char* /*name*/, unsigned flags, hid_t properties, haddr_t /*max*/) {
  const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(properties));
  if (info == nullptr) return nullptr;
  if ((flags & H5F_ACC_TRUNC) != 0U) info->file->resize(0);
  return reinterpret_cast<H5FD_t*>(new DriverFile{{}, info->file, 0});
}

herr_t driver_close(H5FD_t* f) {
  delete &as_driver(f);
  return 0;
}

int driver_cmp(const H5FD_t* a, const H5FD_t* b) {
  const std::less<const PartFile*> before;
  if (before(as_driver(a).file, as_driver(b).file)) return -1;
  return before(as_driver(b).file, as_driver(a).file) ? 1 : 0;
}

herr_t driver_query(const H5FD_t* /*f*/, unsigned long* flags) {
  if (flags != nullptr)
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_SUPPORTS_SWMR_IO | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t driver_get_eoa(const H5FD_t* f, H5FD_mem_t /*type*/) {
  return as_driver(f).end_of_allocation;
}

herr_t driver_set_eoa(H5FD_t* f, H5FD_mem_t /*type*/, haddr_t address) {
  as_driver(f).end_of_allocation = address;
  return 0;
}

haddr_t driver_get_eof(const H5FD_t* f, H5FD_mem_t /*type*/) {
  return as_driver(f).file->size();
}

herr_t driver_read(H5FD_t* f, H5FD_mem_t /*type*/, hid_t /*p*/, haddr_t address, size_t size, void* buffer) {
  return as_driver(f).file->read_at(address, static_cast<std::byte*>(buffer), size) ? 0 : -1;
}

herr_t driver_write(H5FD_t* f, H5FD_mem_t /*type*/, hid_t /*p*/, haddr_t address, size_t size, const void* buffer) {
  as_driver(f).file->write_at(address, static_cast<const std::byte*>(buffer), size);
  return 0;
}

herr_t driver_truncate(H5FD_t* f, hid_t /*p*/, hbool_t /*closing*/) {
  as_driver(f).file->resize(as_driver(f).end_of_allocation);
  return 0;
}

// Does nothing. HDF5 marks a file as being written only when its driver can lock, and a reader needs that mark to open
// what a killed writer left. The lock that counts is PartFile's own.
herr_t driver_lock(H5FD_t* /*f*/, hbool_t /*exclusive*/) {
  return 0;
}
herr_t driver_unlock(H5FD_t* /*f*/) {
  return 0;
}

Handle register_driver() {
  H5FD_class_t c{};
  c.name = "broadside_part";
  c.maxaddr = static_cast<haddr_t>(1) << 62;
  c.fc_degree = H5F_CLOSE_WEAK;
  c.fapl_size = sizeof(DriverInfo);
  c.open = driver_open;
  c.close = driver_close;
  c.cmp = driver_cmp;
  c.query = driver_query;
  c.get_eoa = driver_get_eoa;
  c.set_eoa = driver_set_eoa;
  c.get_eof = driver_get_eof;
  c.read = driver_read;
  c.write = driver_write;
  c.truncate = driver_truncate;
  c.lock = driver_lock;
  c.unlock = driver_unlock;
  constexpr H5FD_mem_t kMap[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(kMap), std::end(kMap), std::begin(c.fl_map));
  return {H5FDregister(&c), H5FDunregister};
}

// An open-file-description lock: it belongs to this descriptor, so a second writer in the same process is refused too,
// and the lock ends with the process, however it ends.
bool lock_whole_file(int fd) {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return fcntl(fd, F_OFD_SETLK, &whole) == 0;
}

bool is_still_named(int fd, const std::filesystem::path& path) {
  struct stat by_fd {};
  struct stat by_name {};
  return fstat(fd, &by_fd) == 0 && stat(path.c_str(), &by_name) == 0 && by_fd.st_dev == by_name.st_dev &&
         by_fd.st_ino == by_name.st_ino;
}

}  // namespace

Error disk_error(int code, const std::filesystem::path& path, const std::string& doing) {
  const std::string where = path.string();
  const std::string reason = std::system_category().message(code);
  switch (code) {
    case ENOSPC:
    case EDQUOT:
      return {doing + " failed: the disk is full (" + reason + ")", where, "free space or choose another folder"};
    case EFBIG:
      return {doing + " failed: the file is larger than this process may write (" + reason + ")", where,
              "raise the limit (ulimit -f) or record less"};
    case ENOENT:
    case ENOTDIR:
      return {doing + " failed: its folder does not exist", where, "create the folder or choose another"};
    case EACCES:
    case EPERM:
    case EROFS:
      return {doing + " failed: no permission to write there (" + reason + ")", where,
              "choose a folder that you may write"};
    case EISDIR:
      return {doing + " failed: a folder has that name", where, "choose another name"};
    default:
      return {doing + " failed (" + reason + ")", where, "choose another folder or repair the disk"};
  }
}

Status rename_durably(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (rename(from.c_str(), to.c_str()) != 0) return disk_error(errno, to, "renaming " + from.filename().string());
  const std::filesystem::path folder = to.has_parent_path() ? to.parent_path() : ".";
  const int fd = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return disk_error(errno, folder, "opening the folder");
  // Some file systems have nothing to sync for a folder and return EINVAL.
  const int code = fsync(fd) == 0 || errno == EINVAL ? 0 : errno;
  close(fd);
  if (code != 0) return disk_error(code, folder, "syncing the folder");
  return Done{};
}

bool is_being_written(const std::filesystem::path& path) {
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return false;
  struct flock whole = {};
  whole.l_type = F_RDLCK;
  whole.l_whence = SEEK_SET;
  const bool is_held = fcntl(fd, F_OFD_SETLK, &whole) != 0;
  close(fd);
  return is_held;
}

Result<std::unique_ptr<PartFile>> PartFile::create(const std::filesystem::path& path) {
  for (;;) {
    const int fd = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0) return disk_error(errno, path, "creating the file");
    std::unique_ptr<PartFile> file(new PartFile(path, fd));
    if (!lock_whole_file(fd)) {
      if (errno == EAGAIN || errno == EACCES)
        return Error{"another writer is writing this file", path.string(),
                     "wait until it is done or choose another name"};
      return disk_error(errno, path, "locking the file");
    }
    // Between open and lock, the previous writer may have finished and renamed the file: then this is its final file.
    if (is_still_named(fd, path)) return file;
  }
}

PartFile::~PartFile() {
  driver_.close();
  if (fd_ >= 0) close(fd_);
}

Handle PartFile::access_properties() {
  if (!driver_) driver_ = register_driver();
  Handle properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  const DriverInfo info{this};
  const bool good = driver_ && properties && H5Pset_driver(properties.get(), driver_.get(), &info) >= 0 &&
                    H5Pset_file_locking(properties.get(), 0, 1) >= 0 &&
                    H5Pset_libver_bounds(properties.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST) >= 0;
  return good ? std::move(properties) : Handle();
}

int PartFile::sync() {
  if (refused_ != 0) return refused_;
  return fsync(fd_) == 0 ? 0 : errno;
}

void PartFile::write_at(std::uint64_t address, const std::byte* data, std::size_t size) {
  end_ = std::max(end_, address + size);
  // The page in which the committed part ends counts as committed.
  const std::uint64_t free_from = (committed_end_ + kPageBytes - 1) / kPageBytes * kPageBytes;
  if (address < free_from) {
    const std::size_t n = std::min<std::uint64_t>(size, free_from - address);
    write_pages(address, data, n);
    address += n;
    data += n;
    size -= n;
  }
  if (refused_ == 0) refused_ = write_fully(fd_, address, data, size);
  if (refused_ != 0) write_pages(address, data, size);
}

bool PartFile::commit() {
  if (refused_ != 0) return false;
  // One page is written completely or not at all; more pages need the journal, placed after both the old and the new
  // content.
  const std::uint64_t behind = std::max(end_, committed_end_);
  if (pages_.size() > 1) refused_ = append_journal(fd_, behind, end_, pages_);
  if (refused_ == 0 && (!pages_.empty() || end_ < committed_end_)) refused_ = put_in_place(fd_, end_, pages_);
  if (refused_ != 0) return false;
  committed_end_ = end_;
  pages_.clear();
  return true;
}

void PartFile::rollback() {
  pages_.clear();
  end_ = committed_end_;
  refused_ = ftruncate(fd_, static_cast<off_t>(end_)) == 0 ? 0 : errno;
}

void PartFile::write_pages(std::uint64_t address, const std::byte* data, std::size_t size) {
  while (size > 0) {
    const std::uint64_t index = address / kPageBytes;
    const std::size_t at = address % kPageBytes;
    const std::size_t n = std::min(size, kPageBytes - at);
    const auto [it, is_new] = pages_.try_emplace(index);
    if (is_new) read_disk(index * kPageBytes, it->second.data(), kPageBytes);
    std::memcpy(it->second.data() + at, data, n);
    address += n;
    data += n;
    size -= n;
  }
}

bool PartFile::read_disk(std::uint64_t address, std::byte* data, std::size_t size) const {
  while (size > 0) {
    const ssize_t n = pread(fd_, data, size, static_cast<off_t>(address));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    if (n == 0) {
      std::memset(data, 0, size);  // past the end: HDF5 expects zeros
      return true;
    }
    address += static_cast<std::uint64_t>(n);
    data += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

bool PartFile::read_at(std::uint64_t address, std::byte* data, std::size_t size) const {
  if (pages_.empty()) return read_disk(address, data, size);
  while (size > 0) {
    const std::size_t at = address % kPageBytes;
    const std::size_t n = std::min(size, kPageBytes - at);
    const auto it = pages_.find(address / kPageBytes);
    if (it != pages_.end())
      std::memcpy(data, it->second.data() + at, n);
    else if (!read_disk(address, data, n))
      return false;
    address += n;
    data += n;
    size -= n;
  }
  return true;
}

void PartFile::resize(std::uint64_t size) {
  end_ = size;
  // HDF5 may not truncate committed bytes; commit() does that later.
  if (refused_ == 0 && size >= committed_end_ && ftruncate(fd_, static_cast<off_t>(size)) != 0) refused_ = errno;
}

}  // namespace broadside::core
