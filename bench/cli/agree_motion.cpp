#include "bench/cli/agree_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>

#include "bench/agree/case.hpp"
#include "bench/agree/draw.hpp"
#include "bench/agree/motion/body_draw.hpp"
#include "bench/agree/motion/feature_draw.hpp"
#include "bench/agree/motion/motion_report.hpp"
#include "bench/agree/motion/query_file.hpp"
#include "bench/cli/commands.hpp"
#include "bench/process/progress.hpp"
#include "bench/process/shared_array.hpp"
#include "bench/record/run_plan.hpp"
#include "core/whole_file.hpp"
#include "reference/motion/motion_engines.hpp"

namespace broadside::bench {
namespace {

// How many cases of one class are kept as files.
constexpr std::uint64_t kMotionCasesPerClass = 3;

MotionKind motion_kind_named(const std::string& name) {
  const auto found = std::find(std::begin(kMotionKinds), std::end(kMotionKinds), name);
  return static_cast<MotionKind>(found - std::begin(kMotionKinds));
}

std::vector<std::string> default_engines(MotionKind kind) {
  if (is_of_features(kind))
    return {"feature-impact", "fcl-features", "fcl-features[root=cubic]", "fcl-features[filter=plane]"};
  if (kind == MotionKind::kMeshes)
    return {"fcl-motion[shape=mesh]", "fcl-motion[motion=translation,shape=mesh]",
            "fcl-motion[motion=translation,shape=mesh,solver=polynomial]", "fcl-motion[shape=mesh,solver=naive]"};
  return {"fcl-motion",
          "fcl-motion[gjk=indep]",
          "fcl-motion[motion=translation]",
          "fcl-motion[motion=screw]",
          "fcl-motion[motion=spline]",
          "fcl-motion[solver=naive]",
          "fcl-motion[samples=1000,solver=naive]",
          "bullet-cast",
          "bullet-cast[method=subsimplex]",
          "bullet-cast[method=gjk]"};
}

// The questions of one study, and the bodies or the file that they were made from.
struct Questions {
  MotionKind kind = MotionKind::kBoxes;
  std::optional<BodySource> bodies;  // for the kinds of bodies
  std::vector<FileQuery> of_file;    // the queries of a csv file, one for each test
  std::vector<MotionTest> tests;
};

core::Result<Questions> questions_of_file(const MotionArguments& a, MotionKind kind) {
  Questions out;
  out.kind = kind;
  if (!is_of_features(kind)) {
    auto saved = read_motion_case(a.case_file);
    if (!saved) return saved.error();
    out.tests.push_back(saved.value().test);
    out.bodies = std::move(saved.value().source);
    return out;
  }
  auto read = read_query_file(a.case_file, kind == MotionKind::kVertexFace ? continuous::FeatureKind::kVertexFace
                                                                           : continuous::FeatureKind::kEdgeEdge);
  if (!read) return read.error();
  out.of_file = std::move(read).value();
  for (std::size_t k = 0; k < out.of_file.size(); ++k) {
    auto test = to_test(out.of_file[k].features, 0);
    if (!test)
      return core::Error{test.error().what, fmt::format("{}, query {}, {}", a.case_file, k, test.error().where),
                         test.error().advice};
    out.tests.push_back(test.value());
  }
  return out;
}

core::Result<Questions> drawn_questions(const MotionArguments& a, MotionKind kind) {
  Questions out;
  out.kind = kind;
  if (!is_of_features(kind)) {
    auto source = BodySource::make(kind, a.seed, a.mesh);
    if (!source) return source.error();
    out.bodies = std::move(source).value();
  }
  SharedArray<MotionTest> tests(a.count);
  Progress progress("motions and the arbiter's answers", a.count);
  const auto draw_one = [&](std::uint64_t k) {
    if (out.bodies) {
      tests[k] = out.bodies->test(k);
      return;
    }
    const DrawnFeatures drawn = draw_features(kind, a.seed, k);
    tests[k] = to_test(drawn.query, drawn.family).value();
  };
  if (core::Status s =
          draw_in_children(a.count, a.limits.processes, draw_one, [&](std::uint64_t done) { progress.at(done); });
      !s)
    return s.error();
  out.tests.assign(tests.all().begin(), tests.all().end());
  return out;
}

bool is_motion_worth_a_file(MotionVerdict verdict) {
  return verdict != MotionVerdict::kAgree && verdict != MotionVerdict::kUndecided &&
         verdict != MotionVerdict::kRounded && verdict != MotionVerdict::kOtherPath;
}

core::Status save_case(const Questions& questions, std::size_t k, std::uint64_t seed,
                       const std::filesystem::path& file) {
  if (questions.bodies) return write_motion_case(*questions.bodies, questions.tests[k], file);
  const exact::RationalFeatures query = draw_features(questions.kind, seed, k).query;
  const auto exact = exact::first_touch(query);
  return write_query_file({{query, exact.ok() && exact.value().touches}}, file);
}

core::Status save_cases(const MotionArguments& a, const Questions& questions, MotionStudy& study) {
  const std::filesystem::path cases = std::filesystem::path(a.folder) / "cases";
  if (core::Status s = prepare_folder(cases); !s) return s;
  std::array<std::uint64_t, kMotionVerdicts.size()> saved{};
  for (std::size_t k = 0; k < questions.tests.size(); ++k) {
    const MotionVerdict verdict = study.table.verdicts[k];
    std::uint64_t& count = saved[static_cast<std::size_t>(verdict)];
    if (!is_motion_worth_a_file(verdict) || count >= kMotionCasesPerClass) continue;
    std::string word(kMotionVerdicts[static_cast<std::size_t>(verdict)]);
    std::replace(word.begin(), word.end(), ' ', '-');
    const std::filesystem::path file =
        cases / fmt::format("{}-{}-{}-{}.{}", a.kind, study.label, word, k, questions.bodies ? "json" : "csv");
    if (core::Status s = save_case(questions, k, a.seed, file); !s) return s;
    if (count == 0)
      study.repeats.push_back(
          fmt::format("broadside agree --motion {} --case '{}' --engine '{}'", a.kind, file.string(), study.label));
    ++count;
  }
  return core::Done{};
}

core::Result<MotionStudy> study_engine(const MotionArguments& a, const Questions& questions,
                                       const MotionEngineSpec& engine) {
  MotionStudy study;
  study.label = engine.label;
  Progress progress(study.label, questions.tests.size());
  auto answers = ask_motions(engine, questions.kind, questions.bodies ? questions.bodies->meshes() : Meshes{},
                             questions.tests, a.limits, [&](std::uint64_t done) { progress.at(done); });
  if (!answers) {
    if (answers.error().what == "interrupted") return answers.error();
    study.absent = answers.error().line();
    return study;
  }
  study.build = answers.value().build;
  study.words = std::move(answers.value().words);
  std::vector<double> reach_m;
  if (questions.bodies)
    for (std::uint32_t k = 0; k < questions.bodies->meshes().size(); ++k)
      reach_m.push_back(questions.bodies->reach_m(k));
  study.table = tabulate(questions.kind, questions.tests, answers.value().of_test, reach_m);
  if (!a.case_file.empty() && questions.tests.size() == 1) {
    const MotionAnswer& answer = answers.value().of_test[0];
    fmt::print("{}: {}{}\n", study.label, kMotionVerdicts[static_cast<std::size_t>(study.table.verdicts[0])],
               answer.asked != Asked::kAnswered ? ""
               : answer.found.touches           ? fmt::format(", touch at {:.17g}", answer.found.time)
                                                : ", no touch");
  }
  return study;
}

void say_truths(const Questions& questions) {
  std::uint64_t touching = 0;
  std::uint64_t rounded = 0;
  std::uint64_t contradicted = 0;
  for (std::size_t k = 0; k < questions.tests.size(); ++k) {
    const MotionTruth& truth = questions.tests[k].truth;
    const bool touches = (truth.kind != MotionTruth::Kind::kApart) != truth.rounding_decides;
    touching += touches ? 1 : 0;
    rounded += truth.rounding_decides ? 1 : 0;
    if (!questions.of_file.empty()) contradicted += touches != questions.of_file[k].touches ? 1 : 0;
  }
  fmt::print("arbiter: {} of {} queries touch", touching, questions.tests.size());
  if (questions.tests.size() == 1 && touching == 1)
    fmt::print(", first in [{:.17g}, {:.17g}] of the step", questions.tests[0].truth.lower,
               questions.tests[0].truth.upper);
  if (rounded > 0) fmt::print("; for {} of them rounding to doubles decides", rounded);
  if (contradicted > 0) fmt::print("; the file disagrees on {}", contradicted);
  fmt::print("\n");
}

bool has_wrong_answers(const MotionTable& table) {
  return std::any_of(table.verdicts.begin(), table.verdicts.end(), is_motion_worth_a_file);
}

}  // namespace

core::Exit agree_motion(const MotionArguments& a) {
  const MotionKind kind = motion_kind_named(a.kind);
  if (!a.mesh.empty() && kind != MotionKind::kMeshes)
    return complain({"it does not apply to " + a.kind, "--mesh", "leave it out, or use --motion meshes"});
  std::vector<MotionEngineSpec> engines;
  for (const std::string& text : a.engines.empty() ? default_engines(kind) : a.engines) {
    auto engine = parse_motion_engine(text);
    if (!engine) return complain(engine.error());
    engines.push_back(std::move(engine).value());
  }
  const bool is_repeated = !a.case_file.empty();
  if (core::Status s = prepare_folder(a.folder); !s && !is_repeated) return complain(s.error());
  auto questions = is_repeated ? questions_of_file(a, kind) : drawn_questions(a, kind);
  if (!questions) return complain(questions.error());
  if (!a.as_json) say_truths(questions.value());
  std::vector<MotionStudy> studies;
  core::Exit exit = core::Exit::kGood;
  for (const MotionEngineSpec& engine : engines) {
    auto study = study_engine(a, questions.value(), engine);
    if (!study) return complain(study.error());
    if (!study.value().absent.empty()) exit = core::Exit::kMissing;
    if (is_repeated && exit == core::Exit::kGood && has_wrong_answers(study.value().table)) exit = core::Exit::kFailed;
    if (!is_repeated && study.value().absent.empty())
      if (core::Status s = save_cases(a, questions.value(), study.value()); !s) return complain(s.error());
    studies.push_back(std::move(study).value());
  }
  const std::string json = motion_json(kind, studies, a.seed);
  if (a.as_json || !is_repeated || questions.value().tests.size() > 1)
    fmt::print("{}\n", a.as_json ? json : motion_tables(kind, studies));
  for (const MotionStudy& study : studies)
    if (is_repeated && !study.absent.empty()) fmt::print("{}: {}\n", study.label, study.absent);
  if (is_repeated) return exit;
  if (core::Status s =
          core::write_whole_file(std::filesystem::path(a.folder) / ("motion-" + a.kind + ".json"), json + "\n");
      !s)
    return complain(s.error());
  return exit;
}

std::string motion_engines_text() {
  std::string text;
  for (const core::MotionEngineRow& row : reference::motion_engine_rows()) {
    text += fmt::format("  {:<16} {}\n", row.id, row.what);
    for (const core::SettingRow& setting : row.settings)
      text += fmt::format("    {:<14} {}\n", setting.key, setting.what);
  }
  return text;
}

}  // namespace broadside::bench
