// The paper's printed forms are real, wrong engines (METHOD 10): each must be rejected by its own validator and by no
// other. No validator rejects the sound engine on the same scene.
#include "tests/validation/engine_recording.hpp"

namespace broadside::tests {
namespace {

struct Erratum {
  const char* scene;
  const char* variant;
  const char* validator;
};

// E2 is a fault of the scene octree, so it is shown where the pipeline uses that.
Recording recording_of(const char* scene, const char* variant) {
  if (std::string(scene) == "errata:E2")
    return record_scene_octree(named_scene(scene), *core::variant_named(variant), variant);
  return record(named_scene(scene), {{"variant", variant}});
}

class PrintedVariants : public testing::TestWithParam<Erratum> {};

TEST_P(PrintedVariants, IsCaughtByItsOwnValidatorAndNoOther) {
  const Erratum& e = GetParam();
  const Recording printed = recording_of(e.scene, e.variant);
  for (const core::Verdict& v : judged(printed)) {
    const bool is_own = v.validator == e.validator;
    EXPECT_EQ(is_own, v.outcome == core::Outcome::kFail) << line(v);
    EXPECT_NE(v.outcome, core::Outcome::kInconclusive) << line(v);
  }
}

TEST_P(PrintedVariants, TheSoundEngineOnItsSceneIsNotBlamed) {
  const Erratum& e = GetParam();
  const Recording sound_engine = recording_of(e.scene, "sound");
  for (const core::Verdict& v : judged(sound_engine)) {
    EXPECT_TRUE(v.outcome == core::Outcome::kPass || v.outcome == core::Outcome::kNotApplicable) << line(v);
    EXPECT_TRUE(v.validator != e.validator || v.outcome == core::Outcome::kPass) << line(v);
  }
}

INSTANTIATE_TEST_SUITE_P(Errata, PrintedVariants,
                         testing::Values(Erratum{"errata:E2", "printed-E2", "candidate-set"},
                                         Erratum{"errata:E3", "printed-E3", "center-of-mass"},
                                         Erratum{"errata:E4", "printed-E4", "contraction"},
                                         Erratum{"errata:E5", "printed-E5", "normal-energy"},
                                         Erratum{"errata:E6", "printed-E6", "friction-energy"}),
                         [](const auto& test) { return std::string(test.param.variant + 8); });

// Settings that change how the pipeline works, none of which is an error.
class SoundSettings : public testing::TestWithParam<EngineSettings> {};

TEST_P(SoundSettings, AreNotBlamed) {
  for (const char* name : {"two-body:head-on", "two-body:unequal", "two-body:glancing", "two-body:resting",
                           "two-body:apart", "errata:E3", "errata:E6"}) {
    const Recording recording = record(named_scene(name), GetParam());
    for (const core::Verdict& v : judged(recording))
      EXPECT_TRUE(v.outcome == core::Outcome::kPass || v.outcome == core::Outcome::kNotApplicable)
          << name << ": " << line(v);
  }
}

INSTANTIATE_TEST_SUITE_P(Engine, SoundSettings,
                         testing::Values(EngineSettings{}, EngineSettings{{"levels", "flat"}},
                                         EngineSettings{{"levels", "level1"}}, EngineSettings{{"levels", "A"}},
                                         EngineSettings{{"levels", "B"}}, EngineSettings{{"broad", "brute"}},
                                         EngineSettings{{"solver", "jacobi"}}, EngineSettings{{"vertex_stage", "off"}}),
                         [](const auto& test) {
                           std::string name;
                           for (const auto& [key, value] : test.param) name += key + "_" + value;
                           return name.empty() ? std::string("defaults") : name;
                         });

}  // namespace
}  // namespace broadside::tests
