// The manifest of a campaign: its cells with their ids, in DIR/manifest.json; and where each cell's result lies.
#pragma once

#include <cstdint>
#include <filesystem>
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
};

struct Manifest {
  std::string name;
  std::string build;  // of the program that planned it; only that program may run its cells
  std::vector<ManifestCell> cells;
};

// Makes every scene once, so a scene, engine or setting that does not exist is found here and not on a node at night.
core::Result<Manifest> make_manifest(const CampaignFile& campaign);

core::Status write_manifest(const std::filesystem::path& folder, const Manifest& manifest);
// Errors: none there, damaged, or a later format.
core::Result<Manifest> read_manifest(const std::filesystem::path& folder);

// DIR/cells/ID: there = finished. Work in progress is DIR/cells/ID.part, with ID.lock held by whoever is at it.
std::filesystem::path cell_folder(const std::filesystem::path& folder, const std::string& id);

}  // namespace broadside::bench::campaign
