// Remembers which traces the verdicts of a folder belong to, so that a later call judges only what changed.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "core/rows.hpp"

namespace broadside::bench {

// The folder's file judged.txt: this program's build line, then the content of each recorded trace and of the rows that
// judging wrote, one a line. Laws are part of the program, so another law is another build.
class JudgedTraces {
 public:
  explicit JudgedTraces(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Removes rows that differ from those that were kept: rows that are damaged, of another build, or of a call that was
  // interrupted before it kept them.
  [[nodiscard]] core::Status drop_changed_rows() const;
  // Whether the folder's verdicts were made from these traces as they are now, and by this program.
  [[nodiscard]] core::Result<bool> are_of(const std::vector<core::Cell>& cells) const;
  // To be called when all rows are written.
  [[nodiscard]] core::Status keep(const std::vector<core::Cell>& cells) const;

 private:
  // What the file should say now.
  [[nodiscard]] core::Result<std::string> text_of(const std::vector<core::Cell>& cells) const;

  std::filesystem::path folder_;
};

}  // namespace broadside::bench
