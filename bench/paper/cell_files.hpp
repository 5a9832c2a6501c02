// Where finished cells and unfinished work lie, by stamp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/paper/paper_row.hpp"
#include "core/result.hpp"
#include "core/sample.hpp"
#include "core/stamp.hpp"

namespace broadside::bench::paper {

// What a finished cell must have been measured with to be taken over.
struct CellKey {
  core::Stamp stamp;  // without engine_build, which is part of the program's build
  std::uint64_t frames = 0;
  std::uint32_t every = 0;
  std::uint32_t runs = 0;  // 0 where nothing is timed
  bool wants_memory = false;

  // "randommove-bunny-300+octree-cpu+levels=A+0123456789abcdef": readable, and unique by its digits.
  [[nodiscard]] std::string name() const;
};

class CellFiles {
 public:
  explicit CellFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Makes the folders, or says why not.
  [[nodiscard]] core::Status prepare() const;

  // A damaged file counts as absent: the cell is measured again and the file replaced.
  [[nodiscard]] std::optional<PaperRow> finished(const CellKey& key) const;
  [[nodiscard]] core::Status finish(const CellKey& key, const PaperRow& row) const;

  // Runs of a cell that is not finished. A run that is missing or damaged is no run.
  [[nodiscard]] std::optional<core::Sample> run(const CellKey& key, std::uint32_t repetition) const;
  [[nodiscard]] core::Status keep_run(const CellKey& key, const core::Sample& sample) const;

  // Where a scene's traces, cells.json and verdicts.json lie while its cells are not finished.
  [[nodiscard]] std::filesystem::path work(const CellKey& key) const;
  void drop_work(const CellKey& key) const;

 private:
  [[nodiscard]] std::filesystem::path run_folder(const CellKey& key, std::uint32_t repetition) const;
  std::filesystem::path folder_;
};

}  // namespace broadside::bench::paper
