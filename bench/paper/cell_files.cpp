#include "bench/paper/cell_files.hpp"

#include <system_error>
#include <utility>

#include "bench/record/run_plan.hpp"

namespace broadside::bench::paper {
namespace {

namespace fs = std::filesystem;

std::optional<PaperRow> row_in(const fs::path& folder) {
  auto rows = read_paper_rows(folder / "row.json");
  if (!rows || rows.value().size() != 1) return std::nullopt;
  return std::move(rows).value().front();
}

}  // namespace

void describe(const PaperCell& cell, PaperRow& row) {
  row.experiments = cell.experiments;
  row.model = cell.model;
  row.count = cell.count;
  row.method = cell.method;
  row.beta = cell.beta;
  row.delta_m = cell.delta_m;
}

std::optional<PaperRow> CellFiles::finished(const std::string& id) const {
  return row_in(done(id));
}

PaperRow CellFiles::row(const PaperCell& cell) const {
  std::optional<PaperRow> known = finished(cell.id);
  if (!known) known = row_in(part(cell.id));
  PaperRow row;
  if (known) {
    row = *std::move(known);
  } else {
    std::error_code failed;
    row.absence = fs::exists(part(cell.id), failed) ? "begun and not finished" : "not begun";
    row.frames = cell.frames;
    row.stamp.scene_name = cell.scene;
    row.stamp.engine = cell.engine;
  }
  describe(cell, row);
  return row;
}

core::Status CellFiles::finish(const std::string& id, const PaperRow& row, const core::RunRows& proof) const {
  if (core::Status s = prepare_folder(part(id)); !s) return s;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(part(id), failed))
    if (entry.is_directory()) fs::remove_all(entry.path(), failed);
  if (core::Status s = core::write_cells(part(id) / "cells.json", proof.cells); !s) return s;
  if (core::Status s = core::write_verdicts(part(id) / "verdicts.json", proof.verdicts); !s) return s;
  if (core::Status s = write_paper_rows(part(id) / "row.json", {row}); !s) return s;
  fs::remove_all(done(id), failed);  // where a damaged row was
  fs::rename(part(id), done(id), failed);
  if (failed) return core::Error{"cannot rename it: " + failed.message(), part(id).string(), "check the folder"};
  return core::Done{};
}

core::Status CellFiles::give_up(const std::string& id, const PaperRow& row) const {
  if (core::Status s = prepare_folder(part(id)); !s) return s;
  return write_paper_rows(part(id) / "row.json", {row});
}

fs::path CellFiles::run_folder(const std::string& id, std::uint32_t repetition) const {
  return part(id) / ("run" + std::to_string(repetition));
}

std::optional<core::Sample> CellFiles::run(const std::string& id, std::uint32_t repetition) const {
  auto rows = core::read_rows(run_folder(id, repetition));
  if (!rows || rows.value().samples.size() != 1) return std::nullopt;
  return std::move(rows).value().samples.front();
}

core::Status CellFiles::keep_run(const std::string& id, const core::Sample& sample) const {
  const fs::path folder = run_folder(id, sample.repetition);
  if (core::Status s = prepare_folder(folder); !s) return s;
  return core::write_samples(folder / "samples.json", {sample});
}

void CellFiles::drop_work(const std::string& turns) const {
  std::error_code ignored;
  fs::remove_all(work(turns), ignored);
}

}  // namespace broadside::bench::paper
