// The rows that a run leaves for reports: cells, verdicts, samples; and their JSON files in the run's folder.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/sample.hpp"
#include "core/stamp.hpp"
#include "core/verdict.hpp"

namespace broadside::core {

// The outcome of one (scene, engine, settings). Absence is a word, never a blank.
enum class CellState { kRecorded, kNotMeasured, kUnsupported, kCrashed, kTimedOut, kInterrupted, kFailed };

std::string_view cell_state_word(CellState state);

struct Cell {
  Stamp stamp;
  CellState state = CellState::kNotMeasured;
  std::string reason;      // "no device"; "signal 6 (abort) after frame 12"; empty when recorded
  std::string trace_file;  // file name within the folder; empty when there is none
  std::uint64_t frames = 0;
  double wall_s = 0.0;  // of the recording run; never a benchmark
  // Step -> digest of that recorded frame: the last frame, and any other at which a timed run may end. A sample is
  // admitted only when its final digest is found here.
  std::map<std::uint64_t, std::uint64_t> digests;
  // Work counted in the recording run ("box tests" -> 41203): equal on every machine for one program and one stamp.
  std::map<std::string, std::uint64_t> counters;
  std::map<std::string, std::string> notes;  // "frames measured" -> "every 100th"; "mesh" -> file and sum
};

struct CellVerdicts {
  std::string trace_file;
  Stamp stamp;
  std::vector<Verdict> verdicts;
  // Whether the engine moved the bodies itself, so that its motion can be judged; false where it was given recorded
  // boxes or poses, and in rows of builds that did not record this.
  bool is_simulation = false;
  std::map<std::string, std::string> declaration;  // what the engine declared, by key
};

struct RunRows {
  std::vector<Cell> cells;
  std::vector<CellVerdicts> verdicts;
  std::vector<Sample> samples;
};

// Files: cells.json, verdicts.json, samples.json: {"format": "broadside-cells", "version": 1, "rows": [...]}. Written
// to a temporary name, synced and renamed. Doubles round-trip; NaN and infinity are written as the strings "nan",
// "inf", "-inf"; digests are strings "0x" + 16 hexadecimal digits, which survive readers that hold numbers as doubles.
// Text that is not UTF-8 is written with replacement characters. An absent file reads as no rows; a malformed one is an
// error that names the file, the row and the field.
Status write_cells(const std::filesystem::path& file, const std::vector<Cell>& cells);
Status write_verdicts(const std::filesystem::path& file, const std::vector<CellVerdicts>& verdicts);
Status write_samples(const std::filesystem::path& file, const std::vector<Sample>& samples);
// Reads one file of samples; here an absent file is an error.
Result<std::vector<Sample>> read_samples(const std::filesystem::path& file);
Result<RunRows> read_rows(const std::filesystem::path& folder);

}  // namespace broadside::core
