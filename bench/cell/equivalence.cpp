#include "bench/cell/equivalence.hpp"

#include <string>

#include "bench/build_facts.hpp"
#include "core/engine/settings.hpp"
#include "reference/worker_count.hpp"

namespace broadside::bench {
namespace {

bool is_pipeline(const core::Engine& engine) {
  return engine.id.starts_with("octree-") || engine.id.starts_with("hash-");
}

std::string threads_of(const core::Engine& engine) {
  if (engine.id.ends_with("-gpu")) return "those of the device";
  return std::to_string(reference::worker_count(engine.settings.number("threads")));
}

// A scene describes the pipeline, so the pipeline differs from it only where settings were changed.
core::EquivalenceCard pipeline_card(const core::Engine& engine) {
  const bool is_on_gpu = engine.id.ends_with("-gpu");
  core::EquivalenceCard card{
      {"library loaded", engine.build, ""},
      {"library build", build_line(), ""},
      {"precision", "float32 without contraction", ""},
      {"SIMD",
       is_on_gpu ? "none: one thread a body, pair or vertex"
                 : "as the compiler made it; octree joins use AVX2 where it is",
       ""},
      {"threads", threads_of(engine), ""},
      {"shape margin", "none", ""},
      {"contact margin", "none", ""},
      {"broad-phase margin", "none", ""},
      {"friction rule", "geometric mean", ""},
      {"restitution rule", "the larger", ""},
      {"warm starting", "off", ""},
      {"sleeping", "off", ""},
  };
  const std::string settings = "," + engine.settings.canonical() + ",";
  const auto has = [&](const char* text) { return settings.find(text) != std::string::npos; };
  const bool is_colored = !has(",solver=") || has(",solver=colored,");
  card.push_back({"contact solver",
                  is_colored ? "one application a contact, color by color" : "as the setting solver says",
                  is_colored ? "" : "one application a contact"});
  card.push_back({"solver iterations", "one pass", ""});
  const bool is_sound = !has(",variant=") || has(",variant=sound,");
  card.push_back({"formulas", is_sound ? "the method's" : "a printed, wrong form", is_sound ? "" : "the method's"});
  return card;
}

}  // namespace

core::EquivalenceCard equivalence_of(const core::Engine& engine, const core::Scene& scene) {
  // Empty where the engine reports no difference for this scene.
  core::EquivalenceCard card = engine.equivalence ? engine.equivalence(scene) : core::EquivalenceCard{};
  if (!card.empty()) return card;
  if (is_pipeline(engine)) return pipeline_card(engine);
  return {{"library loaded", engine.build, ""}};
}

}  // namespace broadside::bench
