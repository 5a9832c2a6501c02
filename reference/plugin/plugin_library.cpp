#include "reference/plugin/plugin_library.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstring>

namespace broadside::reference {
namespace {

using core::Error;
using core::Exit;

bool is_good_id(const char* id) {
  if (id == nullptr || *id == '\0' || std::strlen(id) > 32) return false;
  return std::all_of(id, id + std::strlen(id),
                     [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; });
}

bool is_good_key(const char* key) {
  if (key == nullptr || *key == '\0' || std::strcmp(key, "library") == 0) return false;  // the harness's own key
  return std::all_of(key, key + std::strlen(key),
                     [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; });
}

// All functions of a group are there, or none.
template <typename... Functions>
bool is_whole(Functions... functions) {
  const int there = (0 + ... + (functions != nullptr ? 1 : 0));
  return there == 0 || there == sizeof...(functions);
}

// What is wrong with the function table; empty when nothing is.
std::string fault_of(const broadside_engine& e) {
  if (e.abi != BROADSIDE_ENGINE_ABI)
    return "it speaks version " + std::to_string(e.abi) + " of the engine interface, and this program version " +
           std::to_string(BROADSIDE_ENGINE_ABI);
  if (e.size != sizeof(broadside_engine))
    return "its table has " + std::to_string(e.size) + " bytes, not " + std::to_string(sizeof(broadside_engine)) +
           ": built with another broadside_engine.h";
  if (!is_good_id(e.id)) return "its id is not 1 to 32 of a-z, 0-9 and -";
  if (e.build == nullptr || e.what == nullptr) return "build or what is null";
  if (e.memory != BROADSIDE_HOST && e.memory != BROADSIDE_CUDA) return "memory is neither host nor CUDA";
  if (e.create == nullptr || e.destroy == nullptr || e.last_error == nullptr)
    return "create, destroy or last_error is null";
  if (e.setting_count > 0 && e.settings == nullptr) return "settings is null";
  for (std::uint32_t k = 0; k < e.setting_count; ++k)
    if (!is_good_key(e.settings[k].key) || e.settings[k].what == nullptr)
      return "setting " + std::to_string(k) + " has no key of a-z, 0-9 and _, or no text";
  if (!is_whole(e.load_boxes, e.update_boxes, e.find_pairs, e.read_pairs)) return "half a broad phase";
  if (!is_whole(e.load_scene, e.measure, e.read_separations)) return "half a narrow phase";
  if (!is_whole(e.begin, e.step, e.read_states)) return "half a dynamics engine";
  if (e.find_pairs == nullptr && e.measure == nullptr && e.step == nullptr) return "it offers nothing";
  return {};
}

}  // namespace

core::Result<std::shared_ptr<const PluginLibrary>> PluginLibrary::open(const std::filesystem::path& file) {
  const std::string advice = "core/plugin/README.md shows how to build one";
  // A path without a slash would be searched in the system's folders; this loads only the file that was named.
  std::error_code failed;
  const std::filesystem::path absolute = std::filesystem::absolute(file, failed);
  void* handle = dlopen(absolute.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) return Error{std::string("cannot load it: ") + dlerror(), file.string(), advice};
  using Entry = const broadside_engine* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(handle, "broadside_engine_v1"));
  if (entry == nullptr) {
    dlclose(handle);
    return Error{"it exports no broadside_engine_v1", file.string(), advice};
  }
  const broadside_engine* engine = entry();
  const std::string fault = engine == nullptr ? "broadside_engine_v1 returned null" : fault_of(*engine);
  if (!fault.empty()) {
    dlclose(handle);
    return Error{fault, file.string(), advice};
  }
  return std::shared_ptr<const PluginLibrary>(new PluginLibrary(handle, engine));
}

PluginLibrary::~PluginLibrary() {
  dlclose(handle_);
}

std::string PluginLibrary::capabilities() const {
  std::string text;
  const auto add = [&](bool is_there, const char* word) {
    if (is_there) text += text.empty() ? word : std::string(" ") + word;
  };
  add(offers_broad_phase(), "broad");
  add(offers_narrow_phase(), "narrow");
  add(offers_dynamics(), "dynamics");
  return text;
}

core::Result<std::shared_ptr<PluginInstance>> PluginInstance::make(std::shared_ptr<const PluginLibrary> library,
                                                                   const std::vector<std::uint64_t>& values) {
  const broadside_engine& table = library->engine();
  void* self = table.create(values.data());
  if (self == nullptr) {
    const char* why = table.last_error(nullptr);
    return Error{why != nullptr ? why : "create returned null", std::string(table.id) + ": create", "", Exit::kMissing};
  }
  return std::shared_ptr<PluginInstance>(new PluginInstance(std::move(library), self));
}

PluginInstance::~PluginInstance() {
  table().destroy(self_);
}

std::string PluginInstance::where(std::string_view stage) const {
  return std::string(table().id) + ": " + std::string(stage);
}

core::Status PluginInstance::checked(int returned, std::string_view stage) const {
  if (returned == BROADSIDE_OK) return core::Done{};
  const char* why = table().last_error(self_);
  return Error{why != nullptr && *why != '\0' ? why : "failed without a word (" + std::to_string(returned) + ")",
               where(stage), "", Exit::kMissing};
}

}  // namespace broadside::reference
