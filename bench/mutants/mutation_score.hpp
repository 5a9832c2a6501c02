// Runs wrong engines and tampered traces past the validators, and counts which of them were rejected.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace broadside::bench {

struct MutationRow {
  std::string name;  // "printed-E3", "skips-first-child", "trace: a dropped pair"
  std::string what;
  std::string validator;  // meant for
  std::vector<std::string> caught_by = {};
  std::string why_not_run = {};  // empty when it ran
  bool is_caught = false;        // by the validator that it is meant for
  std::string verdict = {};      // what that validator said; empty where it was not kept
};

// A sound run that a validator rejected.
struct FalseAlarm {
  std::string scene;
  std::string validator;
  std::string explanation;
};

struct MutationScore {
  std::vector<MutationRow> rows;
  std::vector<FalseAlarm> false_alarms;
  std::uint64_t sound_runs = 0;       // recordings of the sound engine that were judged
  std::uint64_t random_scenes = 0;    // among their scenes
  std::uint64_t verdicts_passed = 0;  // of the sound runs
};

struct MutationOptions {
  std::string only;  // a mutation's name; empty = all
  std::uint32_t random_scenes = 200;
  std::function<void(std::uint64_t done, std::uint64_t total)> progress;
};

// An unknown name is an error that names the nearest known one. With `only`, sound runs are left out.
core::Result<MutationScore> score_mutations(const MutationOptions& options);

}  // namespace broadside::bench
