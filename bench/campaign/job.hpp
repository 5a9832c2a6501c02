// A job: a campaign whose cells do not come from scenes and engines in its file but from a plan of its own, which also
// says how groups of them are done. The campaign knows this interface and no job; bench/job_kinds.cpp lists the kinds.
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

// A job in a campaign's folder: its plan with the manifest's ids. Groups are named by the manifest's places
// first ... first + count - 1.
class OpenJob {
 public:
  OpenJob() = default;
  OpenJob(const OpenJob&) = delete;
  OpenJob& operator=(const OpenJob&) = delete;
  virtual ~OpenJob() = default;

  // Groups with smaller ranks are done first.
  [[nodiscard]] virtual double rank_of(std::size_t first, std::size_t count) const = 0;
  // Does the missing cells of a group; each leaves its folder (cell_folder), whole or not at all. An error ends the
  // run; an engine that fails is a result, not an error.
  [[nodiscard]] virtual core::Status do_group(std::size_t first, std::size_t count) const = 0;
  // What merge writes into `out` beside the rows that every campaign has.
  [[nodiscard]] virtual core::Status add_to_merge(const std::filesystem::path& out) const = 0;
};

// What was asked for. Immutable.
class Job {
 public:
  Job() = default;
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;
  virtual ~Job() = default;

  // Its kind's key in campaign files and manifests.
  [[nodiscard]] virtual std::string_view key() const = 0;
  // As JSON, for the manifest.
  [[nodiscard]] virtual std::string text() const = 0;
  // All cells, in the same order every time; those that are done together are neighbors with one `turns`. An id may
  // come twice: one measurement that is shown in two places.
  [[nodiscard]] virtual core::Result<std::vector<ManifestCell>> plan() const = 0;
  // Error: the manifest's cells are not those of this job's plan.
  [[nodiscard]] virtual core::Result<std::unique_ptr<OpenJob>> open(std::span<const ManifestCell> cells,
                                                                    const std::filesystem::path& folder) const = 0;
};

using JobPointer = std::shared_ptr<const Job>;

// A row of the table of kinds.
struct JobKind {
  std::string_view key;  // a campaign file that has this key is of this kind
  // The keys of such a file but for `name`. Wrong ones are added to the errors; an error that is returned is not of the
  // file.
  core::Result<JobPointer> (*read)(datasets::TableReader& table, datasets::FileErrors& errors);
  // The inverse of Job::text. Damaged text is an error that says what is missing.
  core::Result<JobPointer> (*from_text)(std::string_view text);
};

}  // namespace broadside::bench::campaign
