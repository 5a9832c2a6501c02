// A job: a campaign whose cells come from a plan of its own instead of scenes and engines in its file. It also says how
// groups of cells are done. The campaign knows only this interface; bench/job_kinds.cpp lists the kinds.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/campaign/manifest.hpp"
#include "core/result.hpp"
#include "datasets/scene_file/table_reader.hpp"

namespace broadside::bench::campaign {

// A job that is open in a campaign's folder: its plan with the ids of the manifest. A group is named by the places of
// its cells in the manifest, first ... first + count - 1.
class OpenJob {
 public:
  OpenJob() = default;
  OpenJob(const OpenJob&) = delete;
  OpenJob& operator=(const OpenJob&) = delete;
  virtual ~OpenJob() = default;

  // Groups with smaller ranks are done first.
  [[nodiscard]] virtual double rank_of(std::size_t first, std::size_t count) const = 0;
  // Does the missing cells of a group. Each cell's folder (cell_folder) appears whole or not at all. An error ends the
  // run; an engine that fails is a result, not an error.
  [[nodiscard]] virtual core::Status do_group(std::size_t first, std::size_t count) const = 0;
  // Writes to `out` what merge adds to the rows that every campaign has.
  [[nodiscard]] virtual core::Status add_to_merge(const std::filesystem::path& out) const = 0;
};

// What was asked for. Immutable.
class Job {
 public:
  Job() = default;
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;
  virtual ~Job() = default;

  // The key of its kind in campaign files and manifests.
  [[nodiscard]] virtual std::string_view key() const = 0;
  // As JSON, for the manifest.
  [[nodiscard]] virtual std::string text() const = 0;
  // All cells, in the same order every time. Cells that are done together are neighbors and have the same `turns`. An
  // id may occur twice: it is one measurement that is shown in two places.
  [[nodiscard]] virtual core::Result<std::vector<ManifestCell>> plan() const = 0;
  // Error: the manifest's cells are not those of this job's plan.
  [[nodiscard]] virtual core::Result<std::unique_ptr<OpenJob>> open(std::span<const ManifestCell> cells,
                                                                    const std::filesystem::path& folder) const = 0;
};

using JobPointer = std::shared_ptr<const Job>;

// A row of the table of kinds.
struct JobKind {
  std::string_view key;  // a campaign file that has this key is of this kind
  // Reads the keys of such a file except `name`. Wrong keys are added to the errors; an error that is returned has
  // another cause than the file.
  core::Result<JobPointer> (*read)(datasets::TableReader& table, datasets::FileErrors& errors);
  // The inverse of Job::text. Damaged text is an error that says what is missing.
  core::Result<JobPointer> (*from_text)(std::string_view text);
};

}  // namespace broadside::bench::campaign
