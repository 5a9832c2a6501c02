#include "bench/process/kept_hello.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "bench/build_facts.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kInterpreter = "node";

// The path of the program that a command of this name starts; empty when PATH has none.
fs::path on_path(std::string_view name) {
  // Engines are named before any thread begins, so nothing writes the environment meanwhile.
  const char* given = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe)
  std::string_view left = given == nullptr ? "" : given;
  while (!left.empty()) {
    const std::string_view folder = left.substr(0, left.find(':'));
    left.remove_prefix(std::min(left.size(), folder.size() + 1));
    std::error_code failed;
    fs::path file = fs::canonical(fs::path(folder) / name, failed);
    if (!failed && fs::is_regular_file(file, failed)) return file;
  }
  return {};
}

// Identifies the file by size and time, because reading its hundred megabytes would be slow: a package manager that
// replaces it sets another time.
std::string identity_of(const fs::path& file) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(file, failed);
  if (failed) return {};
  const auto written = fs::last_write_time(file, failed).time_since_epoch().count();
  return failed ? std::string() : fmt::format("{}, {} bytes, written {}", file.string(), size, written);
}

std::string stamp_of_hello(const fs::path& program_folder) {
  // In this file npm lists what it installed, with the sum of each package.
  const auto package = core::read_whole_file(program_folder / "node_modules" / ".package-lock.json");
  const std::string interpreter = identity_of(on_path(kInterpreter));
  if (!package || interpreter.empty()) return {};
  return fmt::format("{}\n{}\n{}\n", build_line(), interpreter, package.value());
}

}  // namespace

KeptHello::KeptHello(const fs::path& program_folder)
    : file_(program_folder / "hello.txt"), stamp_(stamp_of_hello(program_folder)) {}

std::optional<std::string> KeptHello::answer() const {
  auto text = core::read_whole_file(file_);
  if (stamp_.empty() || !text || !text.value().starts_with(stamp_)) return std::nullopt;
  return text.value().substr(stamp_.size());
}

void KeptHello::keep(const std::string& answer) const {
  if (!stamp_.empty()) static_cast<void>(core::write_whole_file(file_, stamp_ + answer));
}

}  // namespace broadside::bench
