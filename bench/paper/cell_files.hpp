// Where finished cells and unfinished work of the paper's experiments lie in a campaign's folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "bench/paper/paper_plan.hpp"
#include "bench/paper/paper_row.hpp"
#include "core/result.hpp"
#include "core/rows.hpp"
#include "core/sample.hpp"

namespace broadside::bench::paper {

// DIR/cells/ID is a finished cell: row.json, and cells.json and verdicts.json as every campaign has them. It appears
// whole, by a rename. DIR/cells/ID.part holds its single runs until then, and row.json where it says why there is no
// result. TURNS in the folder work of DIR holds the traces of a scene until all its cells are finished.
// What the plan says about a cell and no measurement does: which experiments show it, and under which name.
void describe(const PaperCell& cell, PaperRow& row);

class CellFiles {
 public:
  explicit CellFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // The row of a finished cell. A damaged file counts as absent: the cell is measured again, and the file is replaced.
  [[nodiscard]] std::optional<PaperRow> finished(const std::string& id) const;
  // The row of a cell as its plan names it; an unfinished cell's row says why.
  [[nodiscard]] PaperRow row(const PaperCell& cell) const;
  [[nodiscard]] core::Status finish(const std::string& id, const PaperRow& row, const core::RunRows& proof) const;
  // Keeps a row that says why there is no result, for row(); the next call tries the cell again.
  [[nodiscard]] core::Status give_up(const std::string& id, const PaperRow& row) const;

  // A finished run of a cell that is not finished. A run that is missing or damaged does not count.
  [[nodiscard]] std::optional<core::Sample> run(const std::string& id, std::uint32_t repetition) const;
  [[nodiscard]] core::Status keep_run(const std::string& id, const core::Sample& sample) const;

  [[nodiscard]] std::filesystem::path work(const std::string& turns) const { return folder_ / "work" / turns; }
  void drop_work(const std::string& turns) const;

 private:
  [[nodiscard]] std::filesystem::path done(const std::string& id) const { return folder_ / "cells" / id; }
  [[nodiscard]] std::filesystem::path part(const std::string& id) const { return folder_ / "cells" / (id + ".part"); }
  [[nodiscard]] std::filesystem::path run_folder(const std::string& id, std::uint32_t repetition) const;
  std::filesystem::path folder_;
};

}  // namespace broadside::bench::paper
