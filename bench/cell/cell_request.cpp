#include "bench/cell/cell_request.hpp"

#include <algorithm>

#include "bench/build_facts.hpp"

namespace broadside::bench {

core::Stamp stamp_of(const core::Scene& scene, const core::Engine& engine) {
  core::Stamp stamp;
  stamp.scene_name = scene.name;
  stamp.scene_digest = core::scene_digest(scene);
  stamp.engine = engine.id;
  stamp.settings = engine.settings.canonical();
  stamp.settings_short = engine.settings.short_form();
  stamp.engine_build = engine.build;
  stamp.broadside_build = build_line();
  stamp.machine = machine_line();
  return stamp;
}

std::string trace_file_name(const core::Stamp& stamp) {
  std::string name = stamp.engine;
  if (!stamp.settings_short.empty()) name += "+" + stamp.settings_short;
  std::replace(name.begin(), name.end(), ',', '+');
  return name + ".h5";
}

std::uint32_t default_narrow_every(std::uint64_t frames) {
  return static_cast<std::uint32_t>(std::max<std::uint64_t>(1, frames / 30));
}

}  // namespace broadside::bench
