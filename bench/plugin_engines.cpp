#include "bench/plugin_engines.hpp"

#include <cctype>
#include <charconv>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/process/child.hpp"
#include "bench/process/kept_hello.hpp"
#include "gpu/runtime/device_space.hpp"
#include "reference/plugin/plugin_engine.hpp"
#include "reference/plugin/plugin_source.hpp"
#include "reference/plugin/program_process.hpp"

namespace broadside::bench {
namespace {

// How long an engine may take to describe itself, which needs no work. Ten seconds are enough for an interpreter to
// start; a machine under load may need more, which BROADSIDE_HELLO_LIMIT_S sets.
constexpr double kHelloLimit_s = 10.0;
constexpr const char* kHelloVariable = "BROADSIDE_HELLO_LIMIT_S";

// Plug-ins are named and described before any thread begins, so no other thread writes the environment meanwhile.
std::optional<std::string> variable(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

core::Result<double> hello_limit_s() {
  const std::optional<std::string> given = variable(kHelloVariable);
  if (!given) return kHelloLimit_s;
  const std::string_view text = *given;
  double seconds = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (fault != std::errc() || end != text.data() + text.size() || !(seconds > 0.0) || seconds > 86400.0)
    return core::Error{"'" + std::string(text) + "' is no number of seconds up to a day", kHelloVariable,
                       "it limits how long an engine may take to describe itself; the default is 10"};
  return seconds;
}

// Owns the strings that a row's views point to.
struct Plugin {
  std::string path;  // or the command of a program
  bool is_program = false;
  std::string name;  // "libmine.so", "node-jolt.mjs": what stamps and settings say
  reference::PluginDescription description;
  std::vector<std::string> defaults;
  std::vector<core::SettingRow> settings;
  core::EngineRow row;
};

// A deque, because its elements keep their addresses, and others hold pointers to rows.
std::deque<Plugin>& plugins() {
  static std::deque<Plugin> all;
  return all;
}

const Plugin* plugin_named(std::string_view library) {
  for (const Plugin& plugin : plugins())
    if (plugin.name == library) return &plugin;
  return nullptr;
}

// The files of a plug-in; of a command, those words that are files.
std::vector<std::filesystem::path> files_of(const Plugin& plugin) {
  if (!plugin.is_program) return {plugin.path};
  std::vector<std::filesystem::path> files;
  const auto words = reference::words_of(plugin.path);
  std::error_code ignored;
  for (const std::string& word : words ? words.value() : std::vector<std::string>())
    if (std::filesystem::is_regular_file(word, ignored)) files.emplace_back(word);
  return files;
}

// Computed from the content and not only from the name: a library that was built again is another engine.
std::string content_digest(const std::vector<std::filesystem::path>& files) {
  std::uint64_t digest = 0;
  std::uint64_t at = 0;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    for (char byte = 0; in.get(byte);) digest += core::splitmix64((at++ << 8) | static_cast<unsigned char>(byte));
  }
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(digest));
  return text;
}

// "node-jolt.mjs" of "node ../engines/jolt.mjs": without characters that have a meaning in settings.
std::string name_of_command(const std::string& command) {
  const auto words = reference::words_of(command);
  std::string name;
  for (const std::string& word : words ? words.value() : std::vector<std::string>{command}) {
    const std::string last = std::filesystem::path(word).filename().string();
    name += (name.empty() ? "" : "-") + (last.empty() ? word : last);
  }
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '_') c = '-';
  return name;
}

// `key`: the setting that holds the plug-in's name, because create() is a plain function and has no other input.
core::Result<core::Engine> create_by(std::string_view key, const core::Settings& settings) {
  const Plugin* plugin = plugin_named(settings.text(key));
  if (plugin == nullptr) return core::Error{"no such plug-in was named", settings.text(key), "", core::Exit::kInternal};
  std::shared_ptr<core::MemorySpace> space = core::make_host_space();
  if (plugin->description.on_device) {
    auto on_device = gpu::make_device_space();
    if (!on_device) return on_device.error();
    space = std::move(on_device).value();
  }
  auto engine = reference::create_plugin_engine(plugin->path, settings, space);
  if (engine.ok()) engine.value().build += " (" + plugin->name + ", " + plugin_content(plugin->row) + ")";
  return engine;
}

core::Result<core::Engine> create_of_library(const core::Settings& settings) {
  return create_by(reference::kLibraryKey, settings);
}

core::Result<core::Engine> create_of_program(const core::Settings& settings) {
  return create_by(reference::kProgramKey, settings);
}

core::Result<reference::PluginDescription> description_from(const std::string& json, const std::string& path) {
  try {
    const auto parsed = nlohmann::json::parse(json);
    reference::PluginDescription description{.id = parsed.at("id"),
                                             .capabilities = parsed.at("capabilities"),
                                             .build = parsed.at("build"),
                                             .what = parsed.at("what"),
                                             .on_device = parsed.at("on_device"),
                                             .settings = {}};
    for (const auto& setting : parsed.at("settings"))
      description.settings.push_back({setting.at("key"), setting.at("default"), setting.at("what")});
    return description;
  } catch (const nlohmann::json::exception& e) {
    return core::Error{std::string("it could not be described: ") + e.what(), path,
                       "a plug-in must not print to standard output"};
  }
}

// The environment variable in which a process passes descriptions to its children, as JSON: what each plug-in answered,
// by command and content of its files. A cell of a campaign takes half a dozen processes, and an interpreter takes
// longer to start than most cells take to run.
constexpr const char* kToldVariable = "BROADSIDE_DESCRIBED";

nlohmann::json told_by_ancestors() {
  nlohmann::json told = nlohmann::json::parse(variable(kToldVariable).value_or("{}"), nullptr, false);
  return told.is_object() ? told : nlohmann::json::object();
}

core::Result<reference::PluginDescription> described(const std::string& path, bool is_program,
                                                     const std::filesystem::path& fetched_folder) {
  const std::string key = path + " " + content_digest(files_of({.path = path, .is_program = is_program}));
  nlohmann::json told = told_by_ancestors();
  if (told.contains(key) && told[key].is_string())
    if (auto description = description_from(told[key].get<std::string>(), path); description.ok()) return description;
  std::optional<KeptHello> kept;
  if (!fetched_folder.empty()) kept.emplace(fetched_folder);
  if (const auto answer = kept ? kept->answer() : std::nullopt)
    if (auto description = description_from(*answer, path); description.ok()) return description;
  const auto limit_s = hello_limit_s();
  if (!limit_s) return limit_s.error();
  auto ended = run_self({"describe-plugin", path}, {limit_s.value()}, Keeps::kOutputAndErrors);
  if (!ended) return ended.error();
  const ChildEnding& ending = ended.value();
  const std::string more = std::string("; more time: ") + kHelloVariable + "=60";
  if (ending.exit_code < 0)
    return core::Error{
        (is_program ? "asking it to describe itself: " : "loading it in a child process: ") + ending.words, path,
        (is_program ? "a program must answer hello before any other work: core/plugin/PROGRAMS.md"
                    : "it must load and describe itself without other work") +
            (ending.timed_out ? more : std::string())};
  if (!ending.is_good) {
    // The child's one clear line: "broadside: FILE: what; advice".
    const std::string prefix = "broadside: " + path + ": ";
    std::string line = ending.last_line;
    if (line.starts_with(prefix)) line = line.substr(prefix.size());
    return core::Error{line.empty() ? "it could not be described" : line, path};
  }
  auto description = description_from(ending.output, path);
  if (!description) return description;
  if (kept) kept->keep(ending.output);
  told[key] = ending.output;
  const std::string all = told.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  setenv(kToldVariable, all.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
  return description;
}

void fill_row(Plugin& plugin) {
  const reference::PluginDescription& d = plugin.description;
  if (plugin.is_program)
    plugin.settings.push_back({reference::kProgramKey, plugin.name, {plugin.name}, "the command that starts it"});
  else
    plugin.settings.push_back({reference::kLibraryKey, plugin.name, {plugin.name}, "the file that it came from"});
  for (const auto& setting : d.settings) plugin.defaults.push_back(std::to_string(setting.default_value));
  for (std::size_t k = 0; k < d.settings.size(); ++k)
    plugin.settings.push_back({d.settings[k].key, plugin.defaults[k], {}, d.settings[k].what});
  plugin.row.id = d.id;
  plugin.row.capabilities = d.capabilities;
  plugin.row.what = d.what;
  plugin.row.settings = plugin.settings;
  plugin.row.runs_in_child = true;  // like every engine made of other people's code
  plugin.row.create = plugin.is_program ? create_of_program : create_of_library;
  plugin.row.absent = d.on_device ? gpu::device_absent : nullptr;
}

}  // namespace

bool is_plugin_path(std::string_view text) {
  return text.find_first_of("/ \t") != std::string_view::npos || text.ends_with(".so");
}

core::Result<const core::EngineRow*> plugin_row(std::string_view given, const std::filesystem::path& fetched_folder) {
  const std::string path(given);
  for (const Plugin& plugin : plugins())
    if (plugin.path == path) return &plugin.row;
  const bool is_program = reference::is_program(path);
  std::error_code failed;
  if (!is_program && !std::filesystem::is_regular_file(path, failed))
    return core::Error{"there is no such file", path,
                       "name a shared library that exports broadside_engine_v1 or _v2, or a program's command"};
  const std::string name = is_program ? name_of_command(path) : std::filesystem::path(path).filename().string();
  if (plugin_named(name) != nullptr)
    return core::Error{"another plug-in of this run has the file name " + name, path, "rename one of them"};
  auto description = described(path, is_program, fetched_folder);
  if (!description) return description.error();
  Plugin& plugin = plugins().emplace_back();
  plugin.path = path;
  plugin.is_program = is_program;
  plugin.name = name;
  plugin.description = std::move(description).value();
  fill_row(plugin);
  return &plugin.row;
}

std::string plugin_content(const core::EngineRow& row) {
  for (const Plugin& plugin : plugins())
    if (&plugin.row == &row) return "content " + content_digest(files_of(plugin));
  return {};
}

std::string engine_argument(const core::EngineRow& row) {
  for (const Plugin& plugin : plugins())
    if (&plugin.row == &row) return plugin.path;
  return std::string(row.id);
}

}  // namespace broadside::bench
