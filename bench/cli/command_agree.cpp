#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bench/agree/answers.hpp"
#include "bench/agree/case.hpp"
#include "bench/agree/draw.hpp"
#include "bench/agree/motion/motion_test.hpp"
#include "bench/agree/report.hpp"
#include "bench/build_facts.hpp"
#include "bench/cell/more_than_zero.hpp"
#include "bench/cli/agree_motion.hpp"
#include "bench/cli/commands.hpp"
#include "bench/process/progress.hpp"
#include "bench/record/run_plan.hpp"
#include "core/pair.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench {
namespace {

// How many cases of one class are kept as files: thousands of the same abort teach no more than a few.
constexpr std::uint64_t kPairCasesPerClass = 4;

struct AgreeArguments {
  std::string kind = "boxes";
  std::string motion;
  std::uint64_t count = 10000;
  std::uint64_t seed = 1;
  std::string mesh;
  std::vector<std::string> engines;
  std::string folder = "out/agree";
  std::string case_file;
  bool as_json = false;
  AskLimits limits{.processes = std::max(1U, std::thread::hardware_concurrency())};
};

std::vector<std::string> default_engines(PairKind kind) {
  if (kind == PairKind::kMeshes) return {"fcl-mesh[threads=1]"};
  return {"fcl-shapes[threads=1]",
          "fcl-shapes[solver=indep,threads=1]",
          "fcl-shapes[query=collide,threads=1]",
          "ccd[shape=primitive,threads=1]",
          "ccd[algorithm=mpr,shape=primitive,threads=1]",
          "bullet-shapes"};
}

PairKind pair_kind_named(const std::string& name) {
  const auto found = std::find(std::begin(kPairKinds), std::end(kPairKinds), name);
  return static_cast<PairKind>(found - std::begin(kPairKinds));
}

core::Stamp stamp_of_study(const CellSpec& cell, const std::string& scene, const std::string& build) {
  core::Stamp stamp;
  stamp.scene_name = scene;
  // There is no scene to hash, so the digest is that of the words from which the pairs are drawn.
  for (const char c : scene) stamp.scene_digest = core::splitmix64(stamp.scene_digest ^ static_cast<unsigned char>(c));
  stamp.engine = cell.row->id;
  auto settings = core::Settings::parse(cell.row->id, cell.row->settings, cell.settings);
  if (settings) {
    stamp.settings = settings.value().canonical();
    stamp.settings_short = settings.value().short_form();
  }
  stamp.engine_build = build;
  stamp.broadside_build = build_line();
  stamp.machine = machine_line();
  return stamp;
}

// The input is kept for verdicts without an answer, and for those in which the engine is plainly wrong.
bool is_worth_a_file(Agreement verdict) {
  return verdict != Agreement::kAgree && verdict != Agreement::kTouchingBand;
}

core::Status save_cases(const PairSource& source, const std::vector<TestPair>& pairs,
                        const std::vector<Agreement>& verdicts, const std::filesystem::path& folder,
                        const std::string& name, EngineStudy& study) {
  const std::filesystem::path cases = folder / "cases";
  if (core::Status s = prepare_folder(cases); !s) return s;
  std::array<std::uint64_t, kAgreements.size()> saved{};
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    std::uint64_t& count = saved[static_cast<std::size_t>(verdicts[k])];
    if (!is_worth_a_file(verdicts[k]) || count >= kPairCasesPerClass) continue;
    std::string word(kAgreements[static_cast<std::size_t>(verdicts[k])]);
    std::replace(word.begin(), word.end(), ' ', '-');
    const std::filesystem::path file = cases / fmt::format("{}-{}-{}-{}.json", name, study.label, word, k);
    if (core::Status s = write_case(source, pairs[k], file); !s) return s;
    if (count == 0)
      study.repeats.push_back(fmt::format("broadside agree --case '{}' --engine '{}'", file.string(), study.label));
    ++count;
  }
  return core::Done{};
}

core::Result<EngineStudy> study_engine(const CellSpec& cell, const PairSource& source,
                                       const std::vector<TestPair>& pairs, PairKind kind, const std::string& scene,
                                       const AgreeArguments& a) {
  EngineStudy study;
  study.stamp = stamp_of_study(cell, scene, "");
  study.label = study.stamp.label();
  study.absent = cell.row->absent != nullptr ? cell.row->absent() : "";
  if (!study.absent.empty()) return study;
  Progress progress(study.label, pairs.size());
  auto answers = ask(cell, source, pairs, a.limits, [&](std::uint64_t done) { progress.at(done); });
  if (!answers) {
    if (answers.error().what == "interrupted") return answers.error();
    study.absent = answers.error().line();
    return study;
  }
  study.stamp.engine_build = answers.value().build;
  study.notes = std::move(answers.value().notes);
  study.words = std::move(answers.value().words);
  std::vector<Agreement> verdicts;
  study.table = tabulate(source, pairs, answers.value().of_pair, verdicts);
  study.defects = defects_met(study.label, kind, verdicts);
  if (!a.case_file.empty()) return study;
  if (core::Status s =
          save_cases(source, pairs, verdicts, a.folder, std::string(kPairKinds[static_cast<int>(kind)]), study);
      !s)
    return s.error();
  return study;
}

// Prints what one saved pair is, and how each engine answers it.
core::Exit repeat_case(const AgreeArguments& a) {
  auto read = read_case(a.case_file);
  if (!read) return complain(read.error());
  const auto& [source, pair] = read.value();
  fmt::print("arbiter: distance {:.9g} m, normal {:.6g} {:.6g} {:.6g}\n", pair.distance_m, pair.normal.x, pair.normal.y,
             pair.normal.z);
  const PairKind kind = source.has_depth() ? PairKind::kConvex : PairKind::kMeshes;
  core::Exit exit = core::Exit::kGood;
  for (const std::string& text : a.engines.empty() ? default_engines(kind) : a.engines) {
    auto cell = parse_cell_spec(text);
    if (!cell) return complain(cell.error());
    auto answers = ask(cell.value(), source, {pair}, a.limits, [](std::uint64_t) {});
    if (!answers) return complain(answers.error());
    const PairAnswer& answer = answers.value().of_pair.front();
    const Agreement verdict = judge(source, pair, answer);
    const core::Separation& s = answer.separation;
    fmt::print("{}: {}", text, kAgreements[static_cast<std::size_t>(verdict)]);
    if (answer.asked == Asked::kAnswered)
      fmt::print(", {}, distance {:.9g} m, normal {:.6g} {:.6g} {:.6g}", s.is_touching ? "touching" : "apart",
                 s.distance_m, s.normal.x, s.normal.y, s.normal.z);
    for (const auto& [words, count] : answers.value().words) fmt::print(": {}", words);
    fmt::print("\n");
    if (is_worth_a_file(verdict)) exit = core::Exit::kFailed;
  }
  return exit;
}

core::Exit agree(const AgreeArguments& a) {
  if (!a.motion.empty())
    return agree_motion({a.motion, a.count, a.seed, a.mesh, a.engines, a.folder, a.case_file, a.as_json, a.limits});
  if (!a.case_file.empty()) return repeat_case(a);
  const PairKind kind = pair_kind_named(a.kind);
  if (!a.mesh.empty() && kind != PairKind::kMeshes)
    return complain({"it does not apply to " + a.kind, "--mesh", "leave it out, or use --pairs meshes"});
  if (core::Status s = prepare_folder(a.folder); !s) return complain(s.error());
  auto source = PairSource::make(kind, a.seed, a.mesh);
  if (!source) return complain(source.error());
  auto drawn = [&] {
    Progress progress("pairs and the arbiter's answers", a.count);
    return draw_pairs(source.value(), a.count, a.limits.processes, [&](std::uint64_t done) { progress.at(done); });
  }();
  if (!drawn) return complain(drawn.error());
  const std::vector<TestPair>& pairs = drawn.value();
  const std::string scene = fmt::format("agree:{}:{}{}", a.kind, a.count, a.mesh.empty() ? "" : ":" + a.mesh);
  std::vector<EngineStudy> studies;
  core::Exit exit = core::Exit::kGood;
  for (const std::string& text : a.engines.empty() ? default_engines(kind) : a.engines) {
    auto cell = parse_cell_spec(text);
    if (!cell) return complain(cell.error());
    auto study = study_engine(cell.value(), source.value(), pairs, kind, scene, a);
    if (!study) return complain(study.error());
    if (!study.value().absent.empty()) exit = core::Exit::kMissing;
    study.value().notes["command"] = fmt::format("broadside agree --pairs {} --n {} --seed {}{} --engine '{}'", a.kind,
                                                 a.count, a.seed, a.mesh.empty() ? "" : " --mesh " + a.mesh, text);
    studies.push_back(std::move(study).value());
  }
  const std::string json = agreement_json(studies, a.kind, a.seed);
  fmt::print("{}\n", a.as_json ? json : agreement_tables(studies));
  if (core::Status s =
          core::write_whole_file(std::filesystem::path(a.folder) / ("agreement-" + a.kind + ".json"), json + "\n");
      !s)
    return complain(s.error());
  if (core::Status s = save_agreement(studies, a.folder); !s) return complain(s.error());
  return exit;
}

}  // namespace

void add_agree(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<AgreeArguments>();
  CLI::App* command = program.add_subcommand(
      "agree", "Compare narrow phases with the exact answer on random pairs, sorted by separation and degeneracy");
  const std::vector<std::string> kinds(std::begin(kPairKinds), std::end(kPairKinds));
  command->add_option("--pairs", a->kind, "Bodies of the pairs; kissing = boxes that touch")
      ->check(CLI::IsMember(kinds))
      ->capture_default_str();
  const std::vector<std::string> motions(std::begin(kMotionKinds), std::end(kMotionKinds));
  command
      ->add_option("--motion", a->motion,
                   "Test continuous queries instead, against the exact first touch; the value names what moves")
      ->check(CLI::IsMember(motions))
      ->excludes("--pairs");
  command->add_option("--n", a->count, "Number of pairs")->check(CLI::Range(1, 10'000'000))->capture_default_str();
  command
      ->add_option("--engine", a->engines,
                   "Narrow-phase engines, or with --motion those below (default: those that fit); may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--mesh", a->mesh, "With --pairs or --motion meshes: this mesh instead of lumpy bodies");
  command->add_option("--seed", a->seed, "Seed of the random pairs")->capture_default_str();
  command->add_option("--out", a->folder, "Folder for rows, tables and saved inputs")->capture_default_str();
  command->add_option("--time-limit", a->limits.seconds_per_query, "Processor seconds after which a query is stopped")
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command
      ->add_option("--memory-limit", a->limits.memory_mib,
                   "MiB of memory that an engine's process may take; 0 = no limit")
      ->capture_default_str();
  command->add_option("--processes", a->limits.processes, "Processes that run side by side (default: one per core)")
      ->check(CLI::Range(1, 256));
  command->add_option(
      "--case", a->case_file,
      "Repeat one saved case instead (exit 1 when an answer is wrong). With --motion vertex-face or edge-edge: a CSV "
      "file, 8 rows a query (4 points at the start, 4 at the end), each coordinate as numerator,denominator, and then "
      "1 where they touch, else 0");
  command->add_flag("--json", a->as_json, "As JSON");
  command->footer("Engines of --motion, with their settings:\n" + motion_engines_text());
  command->callback([a, &exit] { exit = agree(*a); });
}

}  // namespace broadside::bench
