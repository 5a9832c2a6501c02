// Makes a proper trace of what a killed writer left behind.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/result.hpp"

namespace broadside::core {

struct RecoverReport {
  std::uint64_t frames_kept = 0;     // complete frames, all of them in the new file
  std::uint64_t frames_begun = 0;    // frames of which some dataset held something
  std::uint64_t frames_planned = 0;  // what the recording would have had: the scene's frames / every
  std::uint64_t last_step = 0;       // of the last frame that was kept

  // "412 of 3000 frames recovered (up to step 412); 3 more had been begun".
  [[nodiscard]] std::string line() const;
};

// part: NAME.h5.part (or any trace); out: a name that no file has. Trims to the last frame that every dataset reaches
// and writes it anew, with a note "recovered" in its provenance; part stays as it is. Errors: part is still being
// written, holds no whole frame or cannot be read; out exists or cannot be written.
Result<RecoverReport> recover_trace(const std::filesystem::path& part, const std::filesystem::path& out);

// Gives what a killed writer left another name, so that its own can be written again. Error: its writer is still at
// work, or the renaming failed.
Status set_aside(const std::filesystem::path& part, const std::filesystem::path& to);

}  // namespace broadside::core
