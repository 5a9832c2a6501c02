#include "reference/plugin/plugin_engine.hpp"

#include <elf.h>

#include <array>
#include <cstring>
#include <fstream>
#include <utility>

#include "core/plugin/program_protocol.hpp"
#include "reference/plugin/plugin_broad_phase.hpp"
#include "reference/plugin/plugin_dynamics.hpp"
#include "reference/plugin/plugin_dynamics2.hpp"
#include "reference/plugin/plugin_library.hpp"
#include "reference/plugin/plugin_narrow_phase.hpp"
#include "reference/plugin/program_engine.hpp"

namespace broadside::reference {
namespace {

core::Result<std::shared_ptr<const PluginSource>> open_source(const std::string& given) {
  return is_program(given) ? open_program(given) : PluginLibrary::open(given);
}

// Executables name the program that loads them (PT_INTERP); libraries do not.
bool is_executable(std::ifstream& file) {
  Elf64_Ehdr head{};
  file.seekg(0);
  if (!file.read(reinterpret_cast<char*>(&head), sizeof head)) return false;
  if (std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_ident[EI_CLASS] != ELFCLASS64) return false;
  if (head.e_type == ET_EXEC) return true;
  for (int k = 0; k < head.e_phnum; ++k) {
    Elf64_Phdr part{};
    file.seekg(static_cast<std::streamoff>(head.e_phoff) + k * static_cast<std::streamoff>(sizeof part));
    if (!file.read(reinterpret_cast<char*>(&part), sizeof part)) return false;
    if (part.p_type == PT_INTERP) return true;
  }
  return false;
}

std::string build_of(const PluginSource& source) {
  std::string build = core::shown_text(source.table().build);
  if (!source.is_behind_a_pipe()) return build;
  return build + (source.tells_step_seconds() ? ", times by its own clock" : ", times include its pipe");
}

core::EquivalenceCard card_of(const std::string& build, bool tells_step_seconds) {
  return {{"library loaded", build, ""},
          {"time of a step",
           tells_step_seconds ? "by the program's own clock; the pipe is the stage 'pipe'"
                              : "of the call here: it includes the pipe to the program",
           ""}};
}

}  // namespace

bool is_program(std::string_view given) {
  if (given.find_first_of(" \t") != std::string_view::npos) return true;
  std::ifstream file(std::string(given), std::ios::binary);
  std::array<char, 2> first{};
  if (!file.read(first.data(), first.size())) return false;
  return (first[0] == '#' && first[1] == '!') || is_executable(file);
}

core::Result<PluginDescription> describe_plugin(const std::string& given) {
  auto source = open_source(given);
  if (!source) return source.error();
  const auto declared = source.value()->declaration(given);
  if (!declared) return declared.error();
  const broadside_engine2& table = source.value()->table();
  PluginDescription description{.id = table.id,
                                .capabilities = source.value()->capabilities(),
                                .build = build_of(*source.value()),
                                .what = core::shown_text(table.what),
                                .on_device = table.memory == BROADSIDE_CUDA,
                                .settings = {}};
  for (std::uint32_t k = 0; k < table.setting_count; ++k)
    description.settings.push_back(
        {table.settings[k].key, table.settings[k].default_value, core::shown_text(table.settings[k].what)});
  return description;
}

core::Result<core::Engine> create_plugin_engine(const std::string& given, const core::Settings& settings,
                                                const std::shared_ptr<core::MemorySpace>& space) {
  auto opened = open_source(given);
  if (!opened) return opened.error();
  const std::shared_ptr<const PluginSource> source = opened.value();
  const broadside_engine2& table = source->table();
  auto declaration = source->declaration(given, &settings);
  if (!declaration) return declaration.error();
  std::vector<std::uint64_t> values;
  for (std::uint32_t k = 0; k < table.setting_count; ++k) values.push_back(settings.number(table.settings[k].key));

  core::Engine engine;
  engine.id = table.id;
  engine.build = build_of(*source);
  engine.settings = settings;
  engine.declaration = std::move(declaration).value();
  if (source->is_behind_a_pipe())
    engine.equivalence = [build = engine.build, tells = source->tells_step_seconds()](const core::Scene&) {
      return card_of(build, tells);
    };
  // Each capability has its own instance, so that state left by one cannot help another.
  const auto instance = [&]() { return PluginInstance::make(source, values); };
  if (source->offers_broad_phase()) {
    auto made = instance();
    if (!made) return made.error();
    engine.broad_phase = make_plugin_broad_phase(std::move(made).value(), space);
  }
  if (source->offers_narrow_phase()) {
    auto made = instance();
    if (!made) return made.error();
    engine.narrow_phase = make_plugin_narrow_phase(std::move(made).value(), space);
  }
  if (source->offers_dynamics()) {
    auto made = instance();
    if (!made) return made.error();
    engine.dynamics = source->version1() != nullptr ? make_plugin_dynamics(std::move(made).value(), space)
                                                    : make_plugin_dynamics2(std::move(made).value());
  }
  return engine;
}

}  // namespace broadside::reference
