// Makes a complete trace from what a killed writer left.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/result.hpp"

namespace broadside::core {

struct RecoverReport {
  std::uint64_t frames_kept = 0;     // complete frames, all of them in the new file
  std::uint64_t frames_begun = 0;    // frames of which some dataset had rows
  std::uint64_t frames_planned = 0;  // frames of the complete recording: the scene's frames / every
  std::uint64_t last_step = 0;       // step of the last frame that was kept

  // "412 of 3000 frames recovered (up to step 412); 3 more were begun but not finished".
  [[nodiscard]] std::string line() const;
};

// part: NAME.h5.part (or any trace); out: a name that is not in use. Truncates to the last frame that every dataset
// reaches and writes a new file, with a note "recovered" in its provenance; part stays as it is. Errors: part is still
// being written, holds no complete frame or cannot be read; out exists or cannot be written.
Result<RecoverReport> recover_trace(const std::filesystem::path& part, const std::filesystem::path& out);

// Renames what a killed writer left, so that its own name can be written again. Error: its writer is still at work, or
// renaming failed.
Status set_aside(const std::filesystem::path& part, const std::filesystem::path& to);

}  // namespace broadside::core
