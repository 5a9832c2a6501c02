// The agreement study as tables for people, as JSON for programs, and as cells for the report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/agree/answers.hpp"
#include "bench/agree/verdicts.hpp"
#include "core/result.hpp"
#include "core/rows.hpp"

namespace broadside::bench {

struct EngineStudy {
  std::string label;
  core::Stamp stamp;
  AgreementTable table;
  std::map<std::string, std::uint64_t> words;  // last lines of processes that died, and texts of exceptions
  std::map<std::string, std::string> notes;    // the equivalence card
  std::vector<core::DefectHits> defects;
  std::string absent;                // why the engine gave no answers; empty when it did
  std::vector<std::string> repeats;  // commands that repeat saved cases
};

// For each engine a row, and for each separation a column: the share of pairs that agree, disagreements by kind, and
// median times; then the degeneracies and the errors.
std::string agreement_tables(const std::vector<EngineStudy>& studies);
std::string agreement_json(const std::vector<EngineStudy>& studies, std::string_view kind, std::uint64_t seed);

// Writes cells to cells.json with notes "agreement: ...", of which the report makes a table. Rows of other scenes and
// engines in the folder stay.
core::Status save_agreement(const std::vector<EngineStudy>& studies, const std::filesystem::path& folder);

}  // namespace broadside::bench
