#include "datasets/mesh/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>

namespace broadside::datasets {

core::Status write_whole_file(const std::filesystem::path& path, std::string_view content) {
  const std::string part = path.string() + ".part";
  const auto refused = [&](int reason, int descriptor) {
    if (descriptor >= 0) {
      close(descriptor);
      unlink(part.c_str());
    }
    return core::Error{std::string("cannot be written: ") + std::strerror(reason), path.string(),
                       "check the folder, its permissions and the free space"};
  };
  const int file = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) return refused(errno, -1);
  while (!content.empty()) {
    const ssize_t written = write(file, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return refused(errno, file);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  if (fsync(file) != 0) return refused(errno, file);
  close(file);
  if (std::rename(part.c_str(), path.c_str()) != 0) {
    const int reason = errno;
    unlink(part.c_str());
    return refused(reason, -1);
  }
  return core::Done{};
}

}  // namespace broadside::datasets
