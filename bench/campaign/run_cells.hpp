// Runs the cells of a campaign: one cell, a share of them, or all that are missing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "bench/campaign/manifest.hpp"
#include "core/result.hpp"

namespace broadside::bench::campaign {

// Which groups of cells: the group of an id, or those whose place in the manifest is `shard` modulo `shards`.
struct Selection {
  std::string id;  // empty = by shard
  std::uint32_t shard = 0;
  std::uint32_t shards = 1;

  // "3/8": the third of eight.
  static core::Result<Selection> of_shard(const std::string& text);
  [[nodiscard]] bool includes(std::size_t place, std::span<const ManifestCell> group) const;
};

struct Tally {
  std::uint32_t done = 0;        // finished by this call
  std::uint32_t there = 0;       // finished earlier
  std::uint32_t busy = 0;        // another process works on them
  std::uint32_t unfinished = 0;  // interrupted or failed: they will be done again
};

// Why a group is not finished.
struct GroupEnd {
  std::span<const ManifestCell> cells;
  const char* word;   // "done", "busy", "unfinished"
  double seconds;     // time that it took
  std::size_t first;  // its first cell's place in the manifest
};
using TellGroup = std::function<void(const GroupEnd&)>;

// Records and judges each cell, and times it where its work says so. This program does so in child processes, each with
// the cell's time limit. The folder of a cell appears whole or not at all. When an engine crashes or hangs, that is a
// result and finishes its cell; when the harness is killed or the disk is full, the cell is not finished. Groups of a
// job are done as the job says, in the order of their ranks. `at_once` cells are in work at a time, those of a job one
// by one; `tell` is called by one thread at a time. Errors: no manifest, another build, an unknown id.
core::Result<Tally> run_cells(const std::filesystem::path& folder, const Selection& selection, const TellGroup& tell,
                              std::uint32_t at_once = 1);

}  // namespace broadside::bench::campaign
