// The agreement study for people, for programs, and for the report.
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
  std::map<std::string, std::uint64_t> words;  // last words of processes, and what was thrown
  std::map<std::string, std::string> notes;    // the equivalence card
  std::vector<core::DefectHits> defects;
  std::string absent;                // why there is nothing; empty when there is
  std::vector<std::string> repeats;  // commands that repeat saved cases
};

// A row for each engine, a column for each separation: shares that agree, disagreements by kind, and median times; then
// degeneracies and errors.
std::string agreement_tables(const std::vector<EngineStudy>& studies);
std::string agreement_json(const std::vector<EngineStudy>& studies, std::string_view kind, std::uint64_t seed);

// Cells for cells.json: notes "agreement: ..." that the report makes a table of. Rows of other scenes and engines in
// the folder stay.
core::Status save_agreement(const std::vector<EngineStudy>& studies, const std::filesystem::path& folder);

}  // namespace broadside::bench
