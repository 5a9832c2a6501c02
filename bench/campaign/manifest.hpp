// The manifest of a campaign: its cells with their ids, in DIR/manifest.json; and where each cell's result lies.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
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
  // Neighboring cells with the same text are done by one process, which times them in turns, so that a drift of the
  // machine affects all of them alike. A cell that is timed alone has its own id here.
  std::string turns;
};

struct Manifest {
  std::string name;
  std::string build;  // of the program that planned it; only that program may run its cells
  std::vector<ManifestCell> cells;
  // Null = cells of scenes and engines. Otherwise the cells are those of the job's plan, in the same order.
  std::shared_ptr<const Job> job;
};

// The cells that one process does together, group by group.
std::vector<std::span<const ManifestCell>> groups_of(const Manifest& manifest);

// Makes every scene once, so that a scene, engine or setting that does not exist is found here and not on a node at
// night.
core::Result<Manifest> make_manifest(const CampaignFile& campaign);

core::Status write_manifest(const std::filesystem::path& folder, const Manifest& manifest);
// Errors: none there, damaged, or a later format.
core::Result<Manifest> read_manifest(const std::filesystem::path& folder);

// A finished cell has the folder DIR/cells/ID. Unfinished work is in DIR/cells/ID.part; the process that does it holds
// TURNS.lock.
std::filesystem::path cell_folder(const std::filesystem::path& folder, const std::string& id);

}  // namespace broadside::bench::campaign
