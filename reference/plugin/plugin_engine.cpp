#include "reference/plugin/plugin_engine.hpp"

#include "reference/plugin/plugin_broad_phase.hpp"
#include "reference/plugin/plugin_dynamics.hpp"
#include "reference/plugin/plugin_library.hpp"
#include "reference/plugin/plugin_narrow_phase.hpp"

namespace broadside::reference {

core::Result<PluginDescription> describe_plugin(const std::filesystem::path& file) {
  auto library = PluginLibrary::open(file);
  if (!library) return library.error();
  const broadside_engine& table = library.value()->engine();
  PluginDescription description{.id = table.id,
                                .capabilities = library.value()->capabilities(),
                                .build = table.build,
                                .what = table.what,
                                .on_device = table.memory == BROADSIDE_CUDA,
                                .settings = {}};
  for (std::uint32_t k = 0; k < table.setting_count; ++k)
    description.settings.push_back({table.settings[k].key, table.settings[k].default_value, table.settings[k].what});
  return description;
}

core::Result<core::Engine> create_plugin_engine(const std::filesystem::path& file, const core::Settings& settings,
                                                std::shared_ptr<core::MemorySpace> space) {
  auto library = PluginLibrary::open(file);
  if (!library) return library.error();
  const broadside_engine& table = library.value()->engine();
  std::vector<std::uint64_t> values;
  for (std::uint32_t k = 0; k < table.setting_count; ++k) values.push_back(settings.number(table.settings[k].key));

  core::Engine engine;
  engine.id = table.id;
  engine.build = table.build;
  engine.settings = settings;
  // Each capability has its own instance, so that state left by one cannot help another.
  const auto instance = [&]() { return PluginInstance::make(library.value(), values); };
  if (library.value()->offers_broad_phase()) {
    auto made = instance();
    if (!made) return made.error();
    engine.broad_phase = make_plugin_broad_phase(std::move(made).value(), space);
  }
  if (library.value()->offers_narrow_phase()) {
    auto made = instance();
    if (!made) return made.error();
    engine.narrow_phase = make_plugin_narrow_phase(std::move(made).value(), space);
  }
  if (library.value()->offers_dynamics()) {
    auto made = instance();
    if (!made) return made.error();
    engine.dynamics = make_plugin_dynamics(std::move(made).value(), space);
  }
  return engine;
}

}  // namespace broadside::reference
