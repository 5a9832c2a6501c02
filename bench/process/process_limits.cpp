#include "bench/process/process_limits.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

namespace broadside::bench {
namespace {

// Bytes of address space in use, from /proc/self/statm; 0 when it cannot be read.
std::uint64_t address_space_in_use() {
  const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  char text[64];
  const ssize_t size = read(file, text, sizeof text);
  close(file);
  std::uint64_t pages = 0;
  for (ssize_t k = 0; k < size && text[k] >= '0' && text[k] <= '9'; ++k)
    pages = 10 * pages + static_cast<std::uint64_t>(text[k] - '0');
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void lower(int resource, rlim_t most) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_max, most);
  setrlimit(resource, &limit);
}

}  // namespace

void leave_no_core_file() {
  lower(RLIMIT_CORE, 0);
}

void limit_this_process(std::uint64_t memory_mib) {
  leave_no_core_file();
  if (memory_mib > 0) lower(RLIMIT_AS, address_space_in_use() + (memory_mib << 20U));
}

void die_with(int parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
}

}  // namespace broadside::bench
