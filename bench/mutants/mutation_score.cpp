#include "bench/mutants/mutation_score.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "bench/cell/cell_spec.hpp"
#include "bench/mutants/rigid_mutations.hpp"
#include "bench/mutants/specimen.hpp"
#include "bench/mutants/specimen_scenes.hpp"
#include "bench/mutants/tamperings.hpp"
#include "bench/process/interrupt.hpp"
#include "core/nearest_name.hpp"
#include "core/scene/transformed_scene.hpp"
#include "reference/engines.hpp"
#include "reference/mutants/mutants.hpp"
#include "reference/mutants/serial_pipeline.hpp"

namespace broadside::bench {
namespace {

using reference::Mutant;
using reference::Showing;

// The paper's printed forms, each on the scene that shows it.
struct Erratum {
  std::string_view variant;
  std::string_view what;
  std::string_view validator;
  std::string_view scene;
};
constexpr Erratum kErrata[] = {
    {"printed-E1", "P(4): a step limit without the damping term", "stability", "errata:E1"},
    {"printed-E2", "P-Alg 2: bodies of one octree node alone are tested", "candidate-set", "errata:E2"},
    {"printed-E3", "P(12): the correction's masses swapped", "center-of-mass", "errata:E3"},
    {"printed-E4", "P(14): corrected below the slop, so deepened", "contraction", "errata:E4"},
    {"printed-E5", "P(18): the impulse floor on every contact", "normal-energy", "errata:E5"},
    {"printed-E6", "P(21): sliding friction with the wrong sign", "friction-energy", "errata:E6"},
    {"printed-E7", "P-Alg 1: no octree level below 1", "octree-invariants", "errata:E7"},
    {"printed-E8", "contacts resolved in the order of threads", "determinism", "errata:E8"},
};
// A race may not show in one run, because two orders may give the same bits. With some hundred contacts a frame that is
// rare.
constexpr int kRacingRuns = 5;

core::Scene reversed(const core::Scene& scene) {
  std::vector<std::uint32_t> order(scene.bodies.size());
  std::iota(order.rbegin(), order.rend(), 0U);
  return core::renumbered_scene(scene, order);
}

core::Scene transformed(const core::Scene& scene, Showing showing) {
  if (showing == Showing::kMirrored) return core::mirrored_scene(scene, 0);
  if (showing == Showing::kScaled) return core::scaled_scene(scene, 2.0F);
  return reversed(scene);
}

core::Result<Specimen> record_engine(const core::Scene& scene, const GivenSettings& given) {
  const core::EngineRow row = reference::octree_cpu_row();
  auto settings = core::Settings::parse(row.id, row.settings, given);
  if (!settings) return settings.error();
  auto engine = row.create(settings.value());
  if (!engine) return engine.error();
  return record_specimen(scene, *engine.value().dynamics, settings.value().canonical());
}

class Scorer {
 public:
  explicit Scorer(const MutationOptions& options) : options_(options) {}

  core::Result<MutationScore> run() {
    const std::vector<std::string> names = all_names();
    const auto known = [&](const std::string& name) { return std::find(names.begin(), names.end(), name); };
    if (!options_.only.empty() && known(options_.only) == names.end()) {
      const std::vector<std::string_view> views(names.begin(), names.end());
      return core::Error{"unknown mutation '" + options_.only + "'", "--only",
                         core::advise_name(options_.only, views, "broadside mutants --matrix")};
    }
    total_ = options_.only.empty() ? names.size() + scenes_of_mutants().size() + options_.random_scenes +
                                         sound_rigid_ticks(options_.random_scenes)
                                   : 1;
    for (const Erratum& erratum : kErrata)
      if (is_wanted(std::string(erratum.variant))) add(erratum);
    for (const auto table : mutants())
      for (const Mutant& mutant : table)
        if (is_wanted(std::string(mutant.name))) add(mutant);
    if (core::Status s = add_tamperings(); !s) return s.error();
    if (core::Status s = run_rigid_mutations([this](const std::string& name) { return is_wanted(name); },
                                             [this](MutationRow row) { finish(std::move(row)); });
        !s)
      return s.error();
    if (options_.only.empty()) {
      for (const std::string& scene : scenes_of_mutants())
        if (core::Status s = judge_sound_on(scene); !s) return s.error();
      for (std::uint32_t k = 0; k < options_.random_scenes; ++k)
        if (core::Status s = judge_sound(random_of(k), settings_of(k), k); !s) return s.error();
      if (core::Status s = judge_sound_rigid(options_.random_scenes, score_, [this] { tick(); }); !s) return s.error();
      score_.random_scenes = std::uint64_t{2} * options_.random_scenes;
    }
    if (is_interrupted()) return core::Error{"interrupted", "mutants", "run it again", core::Exit::kMissing};
    return std::move(score_);
  }

 private:
  static std::vector<std::span<const Mutant>> mutants() {
    return {reference::pair_mutants(), reference::octree_mutants(), reference::contact_mutants(),
            reference::velocity_mutants(), reference::state_mutants()};
  }
  static std::vector<std::span<const Tampering>> tamperings() {
    return {pair_tamperings(), contact_tamperings(), velocity_tamperings(), state_tamperings()};
  }
  static std::string name_of(const Tampering& t) {
    return "trace: " + std::string(t.validator) + ": " + std::string(t.what);
  }

  static std::vector<std::string> all_names() {
    std::vector<std::string> names;
    for (const Erratum& e : kErrata) names.emplace_back(e.variant);
    for (const auto table : mutants())
      for (const Mutant& m : table) names.emplace_back(m.name);
    for (const auto table : tamperings())
      for (const Tampering& t : table) names.push_back(name_of(t));
    for (std::string& name : rigid_mutation_names()) names.push_back(std::move(name));
    return names;
  }

  static std::vector<std::string> scenes_of_mutants() {
    std::set<std::string> scenes;
    for (const auto table : mutants())
      for (const Mutant& m : table) scenes.emplace(m.scene);
    return {scenes.begin(), scenes.end()};
  }

  [[nodiscard]] bool is_wanted(const std::string& name) const {
    return (options_.only.empty() || options_.only == name) && !is_interrupted();
  }

  void finish(MutationRow row) {
    row.is_caught = std::find(row.caught_by.begin(), row.caught_by.end(), row.validator) != row.caught_by.end();
    score_.rows.push_back(std::move(row));
    tick();
  }

  void tick() {
    ++done_;
    if (options_.progress) options_.progress(done_, total_);
  }

  // Which validators failed; an error says why it could not be judged.
  static void judge_into(MutationRow& row, const core::Result<Specimen>& subject,
                         const core::Result<Specimen>* baseline) {
    if (!subject || (baseline != nullptr && !*baseline)) {
      row.why_not_run = (!subject ? subject.error() : baseline->error()).line();
      return;
    }
    auto verdicts = judge_specimen(subject.value(), baseline != nullptr ? &baseline->value() : nullptr);
    if (!verdicts) {
      row.why_not_run = verdicts.error().line();
      return;
    }
    row.caught_by.clear();
    for (const core::Verdict& v : verdicts.value())
      if (v.outcome == core::Outcome::kFail) row.caught_by.push_back(v.validator);
  }

  void add(const Erratum& e) {
    MutationRow row{std::string(e.variant), std::string(e.what), std::string(e.validator)};
    const auto scene = specimen_scene(e.scene);
    if (!scene) {
      row.why_not_run = scene.error().line();
      return finish(std::move(row));
    }
    const bool is_race = e.variant == "printed-E8";
    const GivenSettings settings{{"variant", row.name}, {"threads", is_race ? "4" : "1"}};
    const auto subject = record_engine(scene.value(), settings);
    if (!is_race) {
      judge_into(row, subject, nullptr);
      return finish(std::move(row));
    }
    const auto is_caught = [&row] {
      return std::find(row.caught_by.begin(), row.caught_by.end(), row.validator) != row.caught_by.end();
    };
    for (int k = 0; k < kRacingRuns && !is_caught() && row.why_not_run.empty(); ++k) {
      const auto again = record_engine(scene.value(), settings);
      judge_into(row, subject, &again);
    }
    finish(std::move(row));
  }

  static core::Result<Specimen> record_mutant(const Mutant& mutant, const core::Scene& scene, std::uint64_t run) {
    return record_specimen(scene, *reference::make_mutant(mutant, run), reference::SerialPipeline::settings());
  }

  void add(const Mutant& m) {
    MutationRow row{std::string(m.name), std::string(m.what), std::string(m.validator)};
    const auto scene = specimen_scene(m.scene);
    if (!scene) {
      row.why_not_run = scene.error().line();
      return finish(std::move(row));
    }
    const auto subject = record_mutant(m, scene.value(), 0);
    if (m.showing == Showing::kAlone) {
      judge_into(row, subject, nullptr);
    } else {
      const bool is_second = m.showing == Showing::kSecondRun;
      const auto baseline =
          record_mutant(m, is_second ? scene.value() : transformed(scene.value(), m.showing), is_second ? 1 : 0);
      judge_into(row, subject, &baseline);
    }
    finish(std::move(row));
  }

  core::Status add_tamperings() {
    std::optional<Specimen> sound;
    for (const auto table : tamperings()) {
      for (const Tampering& t : table) {
        if (!is_wanted(name_of(t))) continue;
        if (!sound) {
          auto scene = specimen_scene("mixed");
          if (!scene) return scene.error();
          // Flat confirms every candidate, so a tampering that spoils one of the two lists spoils both.
          auto recorded = record_engine(scene.value(), {{"levels", "flat"}, {"threads", "1"}});
          if (!recorded) return recorded.error();
          sound = std::move(recorded).value();
        }
        MutationRow row{name_of(t), std::string(t.what), std::string(t.validator)};
        Specimen spoiled = *sound;
        t.apply(spoiled);
        if (!spoiled.is_spoilable) {
          row.why_not_run = "the recording has nothing that this mutation could spoil";
        } else {
          const core::Result<Specimen> subject = std::move(spoiled);
          const core::Result<Specimen> baseline = *sound;
          judge_into(row, subject, t.against_the_sound_one ? &baseline : nullptr);
        }
        finish(std::move(row));
      }
    }
    return core::Done{};
  }

  // Every fifth far from the origin, every fifth with masses a million times apart.
  static core::Scene random_of(std::uint32_t k) {
    return random_scene(k, k % 5 == 3 ? 1000.0F : -2.0F, k % 5 == 4 ? 1e6F : 10.0F);
  }
  static GivenSettings settings_of(std::uint32_t k) {
    static const GivenSettings kSettings[] = {
        {}, {{"broad", "octree"}}, {{"levels", "flat"}}, {{"levels", "A"}, {"broad", "brute"}}, {{"solver", "jacobi"}}};
    return kSettings[(k / 5) % std::size(kSettings)];
  }

  core::Status judge_sound_on(const std::string& name) {
    auto scene = specimen_scene(name);
    if (!scene) return scene.error();
    for (std::uint32_t k = 0; k < 3; ++k)
      if (core::Status s = judge_sound(scene.value(), {{"broad", "octree"}}, k); !s) return s;
    tick();
    return core::Done{};
  }

  // Alone, beside a second run on two threads, and beside a run on a transformed scene: mirrored, scaled, renumbered
  // or grown, by k.
  core::Status judge_sound(const core::Scene& scene, const GivenSettings& settings, std::uint32_t k) {
    if (is_interrupted()) return core::Done{};
    GivenSettings one = settings;
    one["threads"] = "1";
    GivenSettings two = settings;
    two["threads"] = "2";
    const core::Scene other = k % 4 == 0   ? core::mirrored_scene(scene, static_cast<int>(k / 4 % 3))
                              : k % 4 == 1 ? core::scaled_scene(scene, 4.0F)
                              : k % 4 == 2 ? reversed(scene)
                                           : core::grown_scene(scene, 1.25F);
    auto subject = record_engine(scene, one);
    if (!subject) return subject.error();
    auto again = record_engine(scene, two);
    if (!again) return again.error();
    auto elsewhere = record_engine(other, one);
    if (!elsewhere) return elsewhere.error();
    for (const Specimen* baseline : {&again.value(), &elsewhere.value()}) {
      auto verdicts = judge_specimen(subject.value(), baseline);
      if (!verdicts) return verdicts.error();
      ++score_.sound_runs;
      for (const core::Verdict& v : verdicts.value()) {
        if (v.outcome == core::Outcome::kPass) ++score_.verdicts_passed;
        if (v.outcome == core::Outcome::kFail) score_.false_alarms.push_back({scene.name, v.validator, v.explanation});
      }
    }
    if (scene.name.starts_with("random:")) tick();
    return core::Done{};
  }

  const MutationOptions& options_;
  MutationScore score_;
  std::uint64_t done_ = 0;
  std::uint64_t total_ = 0;
};

}  // namespace

core::Result<MutationScore> score_mutations(const MutationOptions& options) {
  return Scorer(options).run();
}

}  // namespace broadside::bench
