#include "reference/loaded_library.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace broadside::reference {

std::string loaded_library(const void* address) {
  Dl_info library;
  Dl_info program;
  if (dladdr(address, &library) == 0 || library.dli_fname == nullptr) return "unknown";
  if (dladdr(reinterpret_cast<const void*>(&loaded_library), &program) != 0 && program.dli_fbase == library.dli_fbase)
    return "static";
  std::error_code failed;
  const std::filesystem::path file = std::filesystem::canonical(library.dli_fname, failed);
  return failed ? "unknown" : file.filename().string();
}

std::optional<bool> library_mentions(const void* address, std::string_view text) {
  Dl_info library;
  if (dladdr(address, &library) == 0 || library.dli_fname == nullptr) return std::nullopt;
  std::ifstream file(library.dli_fname, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file || bytes.empty()) return std::nullopt;
  return bytes.find(text) != std::string::npos;
}

}  // namespace broadside::reference
