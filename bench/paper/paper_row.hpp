// The result of one cell of the paper's experiments; tables, plots and files are made from these rows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/stamp.hpp"
#include "core/trace/statistics.hpp"

namespace broadside::bench::paper {

// One timed run. Seconds are wall time of the steps, recording off.
struct PaperRun {
  std::vector<double> window_s;           // of each window of `window_frames` frames; the last may be shorter
  std::map<std::string, double> stage_s;  // mean per frame; "frame" is the whole step

  [[nodiscard]] double seconds() const;
};

struct PaperRow {
  std::vector<std::string> experiments;  // that contain this cell: "table5", "table6"
  std::string model;                     // "bunny"
  std::uint32_t count = 0;               // bodies
  std::string method;                    // as the tables call it: "A", "flat", "hash", "octree"
  double beta = 0.0;                     // of Figure A2; 0 elsewhere
  double delta_m = 0.0;
  core::Stamp stamp;
  std::string mesh;  // which file, with its sum
  bool is_stand_in = false;

  std::string absence;       // why there is no result: "not measured: no device"; empty when there is one
  std::uint64_t frames = 0;  // of each run
  std::uint64_t judged = 0;  // of these, recorded and judged
  std::uint64_t passed = 0;  // verdicts on the recording
  std::uint64_t failed = 0;
  bool is_admitted = false;  // of the times; without times, whether no verdict failed and one passed
  std::string refusal;       // why it is not admitted
  std::string caveat;        // inconclusive verdicts, by name
  std::uint64_t final_digest = 0;

  std::uint64_t window_frames = 100;
  std::vector<PaperRun> runs;
  std::vector<core::PenetrationStatistics> penetration;  // of the judged frames
  std::map<std::string, double> pairs;                   // mean per judged frame: "candidates", "confirmed", "contacts"
  std::vector<double> memory_bytes;                      // of each run: the mean over its windows
  std::string memory_kind;                               // which memory was counted
  double spent_s = 0.0;  // wall time for recording and timing it, loading included; 0 = not known

  [[nodiscard]] bool has_times() const { return absence.empty() && !runs.empty(); }
  // One value per run, in frames per second: of all frames; likewise below of one window, of a part of the run.
  [[nodiscard]] std::vector<double> fps() const;
  [[nodiscard]] std::vector<double> window_fps(std::size_t window) const;
  // Windows that end in the first half of the run (early) or in the second: 1500 and 1500 of 3000 frames.
  [[nodiscard]] std::vector<double> half_fps(bool is_early) const;
  [[nodiscard]] std::vector<double> stage_seconds(const std::string& stage) const;
  [[nodiscard]] std::size_t window_count() const;
  [[nodiscard]] std::uint64_t frames_in(std::size_t window) const;
};

// The mean penetration over all contacts of all windows, m; NaN without contacts.
struct Penetration {
  double mean_m = 0.0;
  double largest_m = 0.0;
  double share_above_slop = 0.0;
  std::uint64_t contacts = 0;
};
Penetration pooled(const std::vector<core::PenetrationStatistics>& windows);

// JSON: {"format": "broadside-paper", "version": 1, "facts": [...], "rows": [...]}. Machine and builds are in "facts",
// by number, because most rows share them. Written whole or not at all.
core::Status write_paper_rows(const std::filesystem::path& file, const std::vector<PaperRow>& rows);
// A file that is missing, malformed or of a later version is an error that says which row.
core::Result<std::vector<PaperRow>> read_paper_rows(const std::filesystem::path& file);

}  // namespace broadside::bench::paper
