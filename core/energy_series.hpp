// Where the energy of a run went, frame by frame: the result of validation's ledger, kept in a run's folder for
// reports.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace broadside::core {

// The ledger's columns, J: the energies at the end of a frame, and the works that add up to their change in that frame.
inline constexpr std::string_view kEnergyColumns[] = {"kinetic",  "potential",  "integration", "normal impulses",
                                                      "friction", "correction", "cap"};
inline constexpr std::size_t kEnergyColumnCount = std::size(kEnergyColumns);

struct EnergySeries {
  std::string trace_file;
  std::string scene_name;
  std::string label;                                          // the engine and its settings
  std::vector<std::uint64_t> step;                            // rising
  std::array<std::vector<double>, kEnergyColumnCount> joule;  // each as long as step
};

// energy.json of a run's folder: {"format": "broadside-energy", "version": 1, "rows": [{..., "step": [..], "kinetic":
// [..]}]}, written beside its final name and renamed. An absent file reads as no series; a malformed one is an error
// that names file and field.
Status write_energy(const std::filesystem::path& file, const std::vector<EnergySeries>& series);
Result<std::vector<EnergySeries>> read_energy(const std::filesystem::path& folder);

}  // namespace broadside::core
