#include "core/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace broadside::core {
namespace {

// Closes the file on every path. close_now() reports the result of close(), which is where some file systems first
// report a full disk.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  [[nodiscard]] int get() const { return fd_; }
  int close_now() { return ::close(std::exchange(fd_, -1)); }

 private:
  int fd_;
};

Error system_error(const std::string& doing, const std::filesystem::path& file, int code) {
  return Error{.what = doing + ": " + std::generic_category().message(code),
               .where = file.string(),
               .advice = code == ENOSPC   ? "free some space, or choose another output folder"
                         : code == EACCES ? "check the folder's permissions, or choose another output folder"
                         : code == ENOENT ? "check that the folder exists"
                                          : ""};
}

bool write_all(int fd, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(fd, content.data(), content.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// The rename itself must survive a power cut. Some file systems refuse to sync a folder; then nothing more can be done.
void sync_folder_of(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const Descriptor fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (fd.get() >= 0) ::fsync(fd.get());
}

}  // namespace

Status write_whole_file(const std::filesystem::path& file, std::string_view content) {
  std::filesystem::path part = file;
  part += ".part";
  Descriptor fd(::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (fd.get() < 0) return system_error("cannot be written", file, errno);
  if (!write_all(fd.get(), content) || ::fsync(fd.get()) != 0 || fd.close_now() != 0) {
    const int code = errno;
    ::unlink(part.c_str());
    return system_error("cannot be written", file, code);
  }
  if (::rename(part.c_str(), file.c_str()) != 0) {
    const int code = errno;
    ::unlink(part.c_str());
    return system_error("cannot be given its final name", file, code);
  }
  sync_folder_of(file);
  return Done{};
}

Result<std::string> read_whole_file(const std::filesystem::path& file) {
  const Descriptor fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (fd.get() < 0) return system_error("cannot be read", file, errno);
  std::string content;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const ssize_t count = ::read(fd.get(), buffer.data(), buffer.size());
    if (count == 0) return content;
    if (count > 0) {
      content.append(buffer.data(), static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      return system_error("cannot be read", file, errno);
    }
  }
}

}  // namespace broadside::core
