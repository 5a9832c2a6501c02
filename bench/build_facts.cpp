#include "bench/build_facts.hpp"

#include <link.h>
#include <sys/sysinfo.h>
#include <sys/utsname.h>

#include <cstring>
#include <fstream>
#include <thread>

#include "broadside_version.hpp"  // made by CMake
#include "gpu/engines_on_cuda.hpp"

namespace broadside::bench {
namespace {

// The first NT_GNU_BUILD_ID note of the program's own file.
int find_build_id(dl_phdr_info* info, std::size_t, void* out) {
  constexpr std::uint32_t kBuildIdType = 3;
  auto& text = *static_cast<std::string*>(out);
  for (int k = 0; k < info->dlpi_phnum; ++k) {
    const auto& header = info->dlpi_phdr[k];
    if (header.p_type != PT_NOTE) continue;
    // The loader gives addresses as integers.
    const char* at =
        reinterpret_cast<const char*>(info->dlpi_addr + header.p_vaddr);  // NOLINT(performance-no-int-to-ptr)
    const char* const end = at + header.p_memsz;
    while (at + 12 <= end) {
      std::uint32_t sizes[3];
      std::memcpy(sizes, at, sizeof sizes);
      const char* const name = at + 12;
      const char* const note = name + ((sizes[0] + 3U) & ~3U);
      if (sizes[2] == kBuildIdType && sizes[0] == 4 && std::memcmp(name, "GNU", 4) == 0) {
        constexpr char kDigits[] = "0123456789abcdef";
        for (std::uint32_t b = 0; b < sizes[1] && b < 8; ++b) {
          const auto byte = static_cast<unsigned char>(note[b]);
          text += kDigits[byte >> 4U];
          text += kDigits[byte & 15U];
        }
        return 1;
      }
      at = note + ((sizes[1] + 3U) & ~3U);
    }
  }
  return 1;  // the program is the first entry; libraries do not matter
}

std::string after_colon(const std::string& line) {
  const auto colon = line.find(':');
  return colon == std::string::npos ? "" : line.substr(line.find_first_not_of(" \t", colon + 1));
}

std::string cpu_model() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);)
    if (line.starts_with("model name")) return after_colon(line);
  return "unknown CPU";
}

std::string system_name() {
  std::ifstream release("/etc/os-release");
  for (std::string line; std::getline(release, line);) {
    if (!line.starts_with("PRETTY_NAME=")) continue;
    std::string name = line.substr(12);
    std::erase(name, '"');
    return name;
  }
  return "unknown system";
}

}  // namespace

std::string build_line() {
  std::string id;
  dl_iterate_phdr(find_build_id, &id);
  return std::string("Broadside ") + kVersion + ", commit " + kCommit + ", " + kCompiler + ", " + kBuildType +
         ", flags '" + kFlags + "', build id " + (id.empty() ? "unknown" : id);
}

std::string machine_line() {
  struct sysinfo memory {};
  sysinfo(&memory);
  const double gib = static_cast<double>(memory.totalram) * memory.mem_unit / (1024.0 * 1024.0 * 1024.0);
  utsname kernel{};
  uname(&kernel);
  return cpu_model() + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads, " +
         std::to_string(std::lround(gib)) + " GiB, " + system_name() + " (" + kernel.sysname + " " + kernel.release +
         "), GPU: " + gpu::device_name();
}

}  // namespace broadside::bench
