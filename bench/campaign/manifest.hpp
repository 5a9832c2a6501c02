// The manifest of a campaign: its cells with their ids, in DIR/manifest.json; and where each cell's result lies.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/campaign/campaign_file.hpp"
#include "core/result.hpp"

namespace broadside::bench::campaign {

struct ManifestCell {
  // 16 hexadecimal digits: scene digest, engine, all settings, frames, repetitions and this build, hashed. The same
  // cell has the same id on every machine that has the same build.
  std::string id;
  CellWork work;
  bool needs_gpu = false;
  // Cells beside each other with the same text are done by one process, which times them in turns: a machine that
  // drifts drifts for all. The id itself where a cell is timed alone.
  std::string turns;
};

struct Manifest {
  std::string name;
  std::string build;  // of the program that planned it; only that program may run its cells
  std::vector<ManifestCell> cells;
  // Of the paper's experiments: what was asked for. Its cells are paper_cells() in the same order, so an id may come
  // twice: one measurement that two experiments show.
  std::optional<paper::PaperRequest> paper;
};

// The cells that one process does together, group by group.
std::vector<std::span<const ManifestCell>> groups_of(const Manifest& manifest);

// The cells of a paper's campaign with their ids.
core::Result<std::vector<paper::PaperCell>> paper_cells(const Manifest& manifest);

// Makes every scene once, so a scene, engine or setting that does not exist is found here and not on a node at night.
core::Result<Manifest> make_manifest(const CampaignFile& campaign);

core::Status write_manifest(const std::filesystem::path& folder, const Manifest& manifest);
// Errors: none there, damaged, or a later format.
core::Result<Manifest> read_manifest(const std::filesystem::path& folder);

// DIR/cells/ID: there = finished. Work in progress is DIR/cells/ID.part, with TURNS.lock held by whoever is at it.
std::filesystem::path cell_folder(const std::filesystem::path& folder, const std::string& id);

}  // namespace broadside::bench::campaign
