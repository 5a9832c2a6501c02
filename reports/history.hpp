// Runs over days: the file to which they are appended, and the series that it contains.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/rows.hpp"
#include "reports/change_points.hpp"

namespace broadside::reports {

struct HistoryPoint {
  std::uint64_t run = 0;  // number within the file, from 1
  std::string at;         // "2026-11-21T02:00:00Z"
  std::string build;
  double value = 0.0;
};

// One figure of one cell on one machine, run by run: values of other cells or machines cannot be compared with it.
struct HistorySeries {
  std::string machine, scene, label;
  std::string metric;  // "median frame", "counter box tests", "verdicts failed"
  std::string unit;
  std::vector<HistoryPoint> points;  // in order of run
  std::vector<ChangePoint> changes;  // index into points
};

struct Appended {
  bool is_new = false;  // false: exactly these rows are in the file already
  std::uint64_t run = 0;
  std::uint64_t values = 0;
};

// Appends the measurements in the rows: the counters and failed verdicts of each recorded cell, and the median frame
// and the stages of each admitted time. The file is SQLite 3, created when absent; a run is appended whole or not at
// all, even when the program dies. at: when the run was made, UTC, ISO 8601. A file that is no history is an error.
core::Result<Appended> append_to_history(const std::filesystem::path& file, const core::RunRows& rows,
                                         const std::string& at);

// Every series with its change points, by machine, scene, label and metric. A missing file is an error.
core::Result<std::vector<HistorySeries>> read_history(const std::filesystem::path& file);

// Plain text within 100 columns where names allow: one line per series, one more per change point.
std::string history_text(const std::vector<HistorySeries>& series);
// {"format": "broadside-history", "version": 1, "series": [...]}.
std::string history_json(const std::vector<HistorySeries>& series);

}  // namespace broadside::reports
