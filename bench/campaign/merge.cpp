#include "bench/campaign/merge.hpp"

#include <fmt/format.h>

#include <set>
#include <system_error>
#include <tuple>

#include "bench/campaign/job.hpp"
#include "bench/campaign/manifest.hpp"
#include "core/rows.hpp"

namespace broadside::bench::campaign {
namespace {

namespace fs = std::filesystem;
using core::Error;

// What must be equal for two rows to be one cell.
using Key = std::tuple<std::uint64_t, std::string, std::string, std::string, std::string>;

Key key_of(const core::Stamp& s) {
  return {s.scene_digest, s.engine, s.settings, s.engine_build, s.machine};
}

class Merger {
 public:
  Merger(const Manifest& manifest, fs::path folder, fs::path out)
      : manifest_(manifest), folder_(std::move(folder)), out_(std::move(out)) {}

  core::Result<MergeSummary> merge() {
    summary_.cells = static_cast<std::uint32_t>(manifest_.cells.size());
    std::set<std::string> taken;  // a job may show a cell more than once
    for (const ManifestCell& cell : manifest_.cells)
      if (taken.insert(cell.id).second)
        if (core::Status s = take(cell); !s) return s.error();
    for (const core::Cell& cell : rows_.cells) ++summary_.by_state[std::string(core::cell_state_word(cell.state))];
    if (core::Status s = core::write_cells(out_ / "cells.json", rows_.cells); !s) return s.error();
    if (core::Status s = core::write_verdicts(out_ / "verdicts.json", rows_.verdicts); !s) return s.error();
    if (core::Status s = core::write_samples(out_ / "samples.json", rows_.samples); !s) return s.error();
    if (manifest_.job) {
      auto job = manifest_.job->open(manifest_.cells, folder_);
      if (!job) return job.error();
      if (core::Status s = job.value()->add_to_merge(out_); !s) return s.error();
    }
    return summary_;
  }

 private:
  core::Status take(const ManifestCell& planned) {
    const fs::path folder = cell_folder(folder_, planned.id);
    std::error_code failed;
    if (!fs::exists(folder / "cells.json", failed)) {
      take_missing(planned, fs::exists(folder.string() + ".part", failed));
      return core::Done{};
    }
    auto rows = core::read_rows(folder);
    if (!rows) return rows.error();
    std::map<std::string, bool> is_kept;
    for (core::Cell& cell : rows.value().cells) {
      const std::string trace = cell.trace_file;
      auto kept = take_cell(std::move(cell), planned, folder);
      if (!kept) return kept.error();
      is_kept[trace] = kept.value();
    }
    // Engines that do not simulate record their driver too; equal rows of a driver are kept once.
    for (core::CellVerdicts& verdicts : rows.value().verdicts) {
      if (!is_kept[fs::path(verdicts.trace_file).filename().string()]) continue;
      for (const core::Verdict& verdict : verdicts.verdicts)
        summary_.failed += verdict.outcome == core::Outcome::kFail ? 1U : 0U;
      verdicts.trace_file = relative(folder / fs::path(verdicts.trace_file).filename());
      rows_.verdicts.push_back(std::move(verdicts));
    }
    for (core::Sample& sample : rows.value().samples) rows_.samples.push_back(std::move(sample));
    return core::Done{};
  }

  void take_missing(const ManifestCell& planned, bool was_begun) {
    core::Cell cell;
    cell.stamp.scene_name = planned.work.scene;
    cell.stamp.engine = planned.work.engine;
    cell.stamp.broadside_build = manifest_.build;
    cell.state = core::CellState::kNotMeasured;
    cell.reason = was_begun ? "begun and not finished" : "not begun";
    ++summary_.missing;
    note(planned, cell.reason);
    rows_.cells.push_back(std::move(cell));
  }

  // Returns false when an equal cell is there already.
  core::Result<bool> take_cell(core::Cell cell, const ManifestCell& planned, const fs::path& folder) {
    if (cell.stamp.broadside_build != manifest_.build)
      return Error{"cell " + planned.id + " is of another build: " + cell.stamp.broadside_build, folder_.string(),
                   "run it again with the program that planned the campaign"};
    if (cell.state != core::CellState::kRecorded)
      note(planned, std::string(core::cell_state_word(cell.state)) + ": " + cell.reason);
    // Only recorded cells have a digest to compare.
    if (cell.state == core::CellState::kRecorded) {
      const auto [at, is_new] = first_.try_emplace(key_of(cell.stamp), rows_.cells.size());
      if (core::Status s = same_digests(rows_.cells, is_new ? rows_.cells.size() : at->second, cell, planned, folder);
          !s)
        return s.error();
      if (!is_new) return false;
    }
    if (!cell.trace_file.empty()) cell.trace_file = relative(folder / cell.trace_file);
    rows_.cells.push_back(std::move(cell));
    return true;
  }

  static core::Status same_digests(const std::vector<core::Cell>& cells, std::size_t at, const core::Cell& cell,
                                   const ManifestCell& planned, const fs::path& folder) {
    if (at == cells.size()) return core::Done{};
    for (const auto& [step, digest] : cell.digests)
      if (const auto same = cells[at].digests.find(step); same != cells[at].digests.end() && same->second != digest)
        return Error{fmt::format("cell {} of {} on {} ended step {} in another digest than an equal cell", planned.id,
                                 cell.stamp.label(), cell.stamp.scene_name, step),
                     folder.string(), "compare the traces: broadside diff A B", core::Exit::kFailed};
    return core::Done{};
  }

  void note(const ManifestCell& planned, const std::string& what) {
    summary_.notable.push_back(
        fmt::format("{} {} on {}: {}", planned.id, planned.work.engine, planned.work.scene, what));
  }

  [[nodiscard]] std::string relative(const fs::path& file) const {
    std::error_code failed;
    const fs::path path = fs::relative(file, out_, failed);
    return failed ? file.string() : path.string();
  }

  const Manifest& manifest_;
  fs::path folder_;
  fs::path out_;
  core::RunRows rows_;
  std::map<Key, std::size_t> first_;
  MergeSummary summary_;
};

}  // namespace

core::Result<MergeSummary> merge_cells(const fs::path& folder, const fs::path& out) {
  auto manifest = read_manifest(folder);
  if (!manifest) return manifest.error();
  std::error_code failed;
  fs::create_directories(out, failed);
  if (failed) return Error{"cannot write there: " + failed.message(), out.string(), "choose another --out"};
  return Merger(manifest.value(), folder, out).merge();
}

}  // namespace broadside::bench::campaign
