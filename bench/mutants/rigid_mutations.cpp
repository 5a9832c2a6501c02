#include "bench/mutants/rigid_mutations.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "bench/mutants/rigid_scenes.hpp"
#include "bench/mutants/rigid_tamperings.hpp"
#include "bench/mutants/specimen.hpp"
#include "bench/process/interrupt.hpp"
#include "reference/plain_rigid/plain_world.hpp"
#include "reference/rigid_mutants/rigid_mutants.hpp"

namespace broadside::bench {
namespace {

using reference::RigidMutant;

// The step and length of a random scene: a step that games take, one that engineers take, and one between; long enough
// for bodies to land.
struct Pace {
  float dt_s;
  std::uint32_t frames;
};
constexpr std::array kPaces{Pace{1.0F / 60.0F, 90}, Pace{1.0F / 240.0F, 150}, Pace{1.0F / 1000.0F, 250}};

std::array<std::span<const RigidMutant>, 6> mutants() {
  return {reference::flight_mutants(),  reference::touch_mutants(),    reference::impulse_mutants(),
          reference::telling_mutants(), reference::pipeline_mutants(), reference::rest_mutants()};
}
std::array<std::span<const RigidTampering>, 3> tamperings() {
  return {rigid_state_tamperings(), rigid_point_tamperings(), rigid_declaration_tamperings()};
}

std::string name_of(const RigidTampering& t) {
  return "trace: " + std::string(t.law) + ": " + std::string(t.what);
}

core::Result<Specimen> record_sound(const core::Scene& scene) {
  reference::plain::PlainWorld engine{reference::plain::WorldOptions{}};
  return record_rigid_specimen(scene, engine);
}

core::Result<Specimen> record_sound_twin(const core::Scene& scene) {
  reference::StagedPipeline engine({});
  return record_turning_specimen(scene, engine);
}

core::Result<Specimen> record_mutant(const RigidMutant& mutant, const core::Scene& scene, std::uint64_t run) {
  const auto engine = reference::make_rigid_mutant(mutant, run);
  return mutant.is_of_pipeline ? record_turning_specimen(scene, *engine) : record_rigid_specimen(scene, *engine);
}

// Notes which laws rejected the subject, and what the law that is meant for it said.
void judge_into(MutationRow& row, const Specimen& subject, const Specimen* baseline) {
  auto verdicts = judge_specimen(subject, baseline);
  if (!verdicts) {
    row.why_not_run = verdicts.error().line();
    return;
  }
  for (const core::Verdict& v : verdicts.value()) {
    if (v.outcome == core::Outcome::kFail) row.caught_by.push_back(v.validator);
    if (v.validator == row.validator) row.verdict = v.explanation;
  }
}

MutationRow run(const RigidMutant& m) {
  MutationRow row{std::string(m.name), std::string(m.what), std::string(m.law)};
  const auto scene = rigid_scene(m.scene);
  if (!scene) {
    row.why_not_run = scene.error().line();
    return row;
  }
  const auto subject = record_mutant(m, scene.value(), 0);
  if (!subject) {
    row.why_not_run = subject.error().line();
    return row;
  }
  if (!m.differs_from_run_to_run) {
    judge_into(row, subject.value(), nullptr);
    return row;
  }
  const auto again = record_mutant(m, scene.value(), 1);
  if (again)
    judge_into(row, subject.value(), &again.value());
  else
    row.why_not_run = again.error().line();
  return row;
}

MutationRow run(const RigidTampering& t, const Specimen& sound) {
  MutationRow row{name_of(t), std::string(t.what), std::string(t.law)};
  Specimen spoiled = sound;
  t.apply(spoiled);
  if (spoiled.is_spoilable)
    judge_into(row, spoiled, t.against_the_sound_one ? &sound : nullptr);
  else
    row.why_not_run = "the recording has nothing that this mutation could spoil";
  return row;
}

std::set<std::string_view> scenes_of_mutations() {
  std::set<std::string_view> names;
  for (const auto table : mutants())
    for (const RigidMutant& m : table) names.insert(m.scene);
  for (const auto table : tamperings())
    for (const RigidTampering& t : table) names.insert(t.scene);
  return names;
}

using Record = core::Result<Specimen> (*)(const core::Scene&);

core::Status judge_sound_run(Record record, const core::Scene& scene, MutationScore& score) {
  auto subject = record(scene);
  if (!subject) return subject.error();
  auto again = record(scene);
  if (!again) return again.error();
  auto verdicts = judge_specimen(subject.value(), &again.value());
  if (!verdicts) return verdicts.error();
  ++score.sound_runs;
  for (const core::Verdict& v : verdicts.value()) {
    if (v.outcome == core::Outcome::kPass) ++score.verdicts_passed;
    if (v.outcome == core::Outcome::kFail)
      score.false_alarms.push_back(
          {subject.value().header.stamp.engine + ": " + scene.name, v.validator, v.explanation});
  }
  return core::Done{};
}

core::Status judge_sound(const core::Scene& scene, MutationScore& score) {
  if (core::Status s = judge_sound_run(record_sound, scene, score); !s) return s;
  return judge_sound_run(record_sound_twin, scene, score);
}

}  // namespace

std::vector<std::string> rigid_mutation_names() {
  std::vector<std::string> names;
  for (const auto table : mutants())
    for (const RigidMutant& m : table) names.emplace_back(m.name);
  for (const auto table : tamperings())
    for (const RigidTampering& t : table) names.push_back(name_of(t));
  return names;
}

core::Status run_rigid_mutations(const std::function<bool(const std::string& name)>& is_wanted,
                                 const std::function<void(MutationRow)>& finish) {
  for (const auto table : mutants())
    for (const RigidMutant& m : table)
      if (is_wanted(std::string(m.name))) finish(run(m));
  std::map<std::string_view, Specimen> sound;
  for (const auto table : tamperings())
    for (const RigidTampering& t : table) {
      if (!is_wanted(name_of(t))) continue;
      if (!sound.contains(t.scene)) {
        auto scene = rigid_scene(t.scene);
        if (!scene) return scene.error();
        auto recorded = record_sound(scene.value());
        if (!recorded) return recorded.error();
        sound.emplace(t.scene, std::move(recorded).value());
      }
      finish(run(t, sound.at(t.scene)));
    }
  return core::Done{};
}

core::Status judge_sound_rigid(std::uint32_t random_scenes, MutationScore& score, const std::function<void()>& tick) {
  for (const std::string_view name : scenes_of_mutations()) {
    if (is_interrupted()) return core::Done{};
    auto scene = rigid_scene(name);
    if (!scene) return scene.error();
    if (core::Status s = judge_sound(scene.value(), score); !s) return s;
    tick();
  }
  for (std::uint32_t k = 0; k < random_scenes && !is_interrupted(); ++k) {
    for (const Pace& pace : kPaces)
      if (core::Status s = judge_sound(random_rigid_scene(k, pace.dt_s, pace.frames), score); !s) return s;
    tick();
  }
  return core::Done{};
}

std::uint64_t sound_rigid_ticks(std::uint32_t random_scenes) {
  return scenes_of_mutations().size() + random_scenes;
}

}  // namespace broadside::bench
