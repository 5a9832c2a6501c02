#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/cli/commands.hpp"
#include "bench/mutants/mutation_score.hpp"
#include "bench/process/progress.hpp"
#include "core/whole_file.hpp"
#include "validation/judge.hpp"

namespace broadside::bench {
namespace {

// How many sound random scenes a reduced run has: as many as a few seconds allow.
constexpr std::uint32_t kReducedScenes = 8;

struct MutantArguments {
  std::string only;
  std::string json;
  std::uint32_t scenes = 200;
  bool is_reduced = false;
  bool shows_matrix = false;
};

std::string others(const MutationRow& row) {
  std::string text;
  for (const std::string& validator : row.caught_by)
    if (validator != row.validator) text += (text.empty() ? "" : ", ") + validator;
  return text;
}

void print(const MutationScore& score) {
  std::size_t width = 0;
  for (const MutationRow& row : score.rows) width = std::max(width, row.name.size());
  for (const MutationRow& row : score.rows) {
    const std::string also = others(row);
    fmt::print("{:<{}}  {:<17}  {}{}\n", row.name, width, row.validator, row.is_caught ? "caught" : "SURVIVED",
               !row.why_not_run.empty() ? ": " + row.why_not_run : (also.empty() ? "" : "; also by " + also));
  }
  for (const FalseAlarm& alarm : score.false_alarms)
    fmt::print("FALSE ALARM on {}: {}: {}\n", alarm.scene, alarm.validator, alarm.explanation);
}

// Prints which validator rejected which mutation: a line for each mutation, a column for each validator.
void print_matrix(const MutationScore& score) {
  const auto validators = validation::validators();
  std::size_t width = 0;
  for (const MutationRow& row : score.rows) width = std::max(width, row.name.size());
  for (std::size_t k = 0; k < validators.size(); ++k)
    fmt::print("{:<{}}  {}{}\n", "", width, std::string(k, '|'), validators[k].name);
  for (const MutationRow& row : score.rows) {
    std::string marks;
    for (const validation::ValidatorRow& v : validators) {
      const bool is_by = std::find(row.caught_by.begin(), row.caught_by.end(), v.name) != row.caught_by.end();
      const bool is_meant = row.validator == v.name;
      marks += is_meant ? (is_by ? '#' : '!') : (is_by ? '+' : '.');
    }
    fmt::print("{:<{}}  {}\n", row.name, width, marks);
  }
  fmt::print("# caught by the validator meant for it, ! missed by it, + caught by another one\n");
}

std::uint64_t caught(const MutationScore& score) {
  return static_cast<std::uint64_t>(
      std::count_if(score.rows.begin(), score.rows.end(), [](const MutationRow& row) { return row.is_caught; }));
}

core::Status write_json(const MutationScore& score, const std::string& path) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const MutationRow& row : score.rows)
    rows.push_back({{"name", row.name},
                    {"what", row.what},
                    {"validator", row.validator},
                    {"caught", row.is_caught},
                    {"caught by", row.caught_by},
                    {"verdict", row.verdict},
                    {"why not run", row.why_not_run}});
  nlohmann::ordered_json alarms = nlohmann::ordered_json::array();
  for (const FalseAlarm& a : score.false_alarms)
    alarms.push_back({{"scene", a.scene}, {"validator", a.validator}, {"explanation", a.explanation}});
  const nlohmann::ordered_json all{{"format", "broadside-mutants"},
                                   {"version", 1},
                                   {"mutations", score.rows.size()},
                                   {"caught", caught(score)},
                                   {"random scenes", score.random_scenes},
                                   {"sound runs judged", score.sound_runs},
                                   {"false alarms", alarms},
                                   {"rows", rows}};
  return core::write_whole_file(path, all.dump(2) + "\n");
}

core::Exit mutants(const MutantArguments& a) {
  MutationOptions options;
  options.only = a.only;
  options.random_scenes = a.is_reduced ? std::min(a.scenes, kReducedScenes) : a.scenes;
  core::Result<MutationScore> scored = core::Error{};
  {
    std::unique_ptr<Progress> progress;
    options.progress = [&progress](std::uint64_t done, std::uint64_t total) {
      if (!progress) progress = std::make_unique<Progress>("mutants", total);
      progress->at(done);
    };
    scored = score_mutations(options);
  }
  if (!scored) return complain(scored.error());
  const MutationScore& score = scored.value();
  if (a.shows_matrix)
    print_matrix(score);
  else
    print(score);
  fmt::print("{} of {} mutations caught by the validator meant for them", caught(score), score.rows.size());
  if (score.sound_runs > 0)
    fmt::print("; {} false alarms in {} judgements of the sound engine, {} random scenes among them",
               score.false_alarms.size(), score.sound_runs, score.random_scenes);
  fmt::print("\n");
  if (!a.json.empty())
    if (core::Status s = write_json(score, a.json); !s) return complain(s.error());
  const bool is_good = caught(score) == score.rows.size() && score.false_alarms.empty();
  return is_good ? core::Exit::kGood : core::Exit::kFailed;
}

}  // namespace

void add_mutants(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<MutantArguments>();
  CLI::App* command = program.add_subcommand(
      "mutants", "Run wrong engines and spoiled traces through the validators, and show which validator catches which");
  command->add_option("--only", a->only, "Run only this mutation, and no sound scene");
  command->add_option("--scenes", a->scenes, "Random scenes on which no validator may reject the sound engine")
      ->capture_default_str();
  command->add_flag("--reduced", a->is_reduced, "All mutations, but a few sound scenes only: for every build");
  command->add_flag("--matrix", a->shows_matrix, "Print which validator caught which, as a matrix");
  command->add_option("--json", a->json, "Write the rows here");
  command->callback([a, &exit] { exit = mutants(*a); });
}

}  // namespace broadside::bench
