#include "bench/agree/motion/motion_answers.hpp"

#include <utility>

#include "bench/agree/query_seconds.hpp"
#include "bench/cell/engine_text.hpp"
#include "bench/process/shared_array.hpp"
#include "reference/motion/motion_engines.hpp"

namespace broadside::bench {
namespace {

core::Result<core::MotionEngine> make_engine(const MotionEngineSpec& spec, MotionKind kind, const Meshes& meshes) {
  auto engine = spec.row->create(spec.settings);
  if (!engine) return engine;
  const bool answers = is_of_features(kind) ? engine.value().features != nullptr : engine.value().bodies != nullptr;
  if (!answers)
    return core::Error{"it answers no queries of " + std::string(kMotionKinds[static_cast<int>(kind)]), spec.label,
                       "see 'broadside agree --help'", core::Exit::kMissing};
  if (!is_of_features(kind))
    if (core::Status s = engine.value().bodies->load(meshes); !s) return s.error();
  return engine;
}

void ask_one(core::MotionEngine& engine, MotionKind kind, const MotionTest& test, MotionAnswer& answer) {
  if (!is_of_features(kind)) {
    answer.follows = engine.bodies->follows(test.a.motion) && engine.bodies->follows(test.b.motion);
    answer.asked = Asked::kAnswered;
    if (!answer.follows) return;
  }
  core::Result<core::FirstTouch> found = core::FirstTouch{};
  answer.seconds = seconds_of([&] {
    found =
        is_of_features(kind) ? engine.features->first_touch(test.features) : engine.bodies->first_touch(test.a, test.b);
  });
  answer.asked = found.ok() ? Asked::kAnswered : Asked::kThrew;
  if (found.ok()) answer.found = found.value();
  if (!found.ok()) found.error().what.copy(answer.thrown.data(), answer.thrown.size() - 1);
}

}  // namespace

core::Result<MotionEngineSpec> parse_motion_engine(const std::string& text) {
  auto given = parse_engine_text(text);
  if (!given) return given.error();
  std::string known;
  for (const core::MotionEngineRow& row : reference::motion_engine_rows()) {
    known += (known.empty() ? "" : ", ") + std::string(row.id);
    if (row.id != given.value().id) continue;
    auto settings = core::Settings::parse(row.id, row.settings, given.value().settings);
    if (!settings) return settings.error();
    const std::string chosen = settings.value().short_form();
    return MotionEngineSpec{&row, settings.value(),
                            chosen.empty() ? std::string(row.id) : std::string(row.id) + "[" + chosen + "]"};
  }
  return core::Error{"no engine '" + given.value().id + "' answers continuous queries", "--engine",
                     "give one of " + known};
}

core::Result<MotionAnswers> ask_motions(const MotionEngineSpec& spec, MotionKind kind, const Meshes& meshes,
                                        const std::vector<MotionTest>& tests, const AskLimits& limits,
                                        const std::function<void(std::uint64_t)>& progress) {
  const auto build = said_by_child(spec.row->id, limits, [&](ChildReport& report) {
    report.begin(0, false);
    auto engine = make_engine(spec, kind, meshes);
    report.say(engine.ok() ? engine.value().build : engine.error().line());
    return engine.ok() ? kAllAsked : kRefused;
  });
  if (!build) return build.error();
  MotionAnswers out;
  out.build = build.value();
  SharedArray<MotionAnswer> answers(tests.size());
  const LiveChild live = [&](ChildReport& report, std::size_t next, std::size_t last) {
    report.begin(next, false);
    auto engine = make_engine(spec, kind, meshes);
    if (!engine) {
      report.say(engine.error().line());
      return kRefused;
    }
    for (std::size_t k = next; k < last; ++k) {
      report.begin(k, true);
      ask_one(engine.value(), kind, tests[k], answers[k]);
    }
    return kAllAsked;
  };
  const OnDeath on_death = [&](std::size_t at, Asked fate, const std::string& words) {
    ++out.words[words];
    answers[at].asked = fate;
  };
  if (core::Status s = ask_in_children(spec.row->id, tests.size(), limits, live, on_death, progress); !s)
    return s.error();
  out.of_test.assign(answers.all().begin(), answers.all().end());
  for (const MotionAnswer& answer : out.of_test)
    if (answer.asked == Asked::kThrew) ++out.words[answer.thrown.data()];
  return out;
}

}  // namespace broadside::bench
