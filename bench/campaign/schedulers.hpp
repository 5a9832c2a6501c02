// Files that hand a campaign to a cluster's scheduler. Each only says how to call `broadside run DIR
// --cell`.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "bench/campaign/manifest.hpp"
#include "core/result.hpp"

namespace broadside::bench::campaign {

struct Scheduler {
  std::string_view name;  // "slurm"
  std::string_view file;  // what is written: "slurm.sh"
  std::string_view use;   // how it is started
  std::string (*text)(const Manifest& manifest, const std::filesystem::path& folder, const std::string& program);
};

// To add one: its function and its row.
const std::array<Scheduler, 3>& schedulers();

}  // namespace broadside::bench::campaign
