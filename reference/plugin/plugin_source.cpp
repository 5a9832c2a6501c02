#include "reference/plugin/plugin_source.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "core/plugin/program_protocol.hpp"

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

bool is_text(const char* text) {
  return text != nullptr && core::is_plain_text(text);
}

// Whether all functions of a group are there, or none.
template <typename... Functions>
bool is_whole(Functions... functions) {
  const int there = (0 + ... + (functions != nullptr ? 1 : 0));
  return there == 0 || there == sizeof...(functions);
}

std::string version_fault(std::uint32_t spoken, std::uint32_t known) {
  return "it speaks version " + std::to_string(spoken) + " of the engine interface, and this program version " +
         std::to_string(known);
}

// Checks the fields that both versions have.
template <typename Table>
std::string fault_of_either(const Table& e) {
  if (!is_good_id(e.id)) return "its id is not 1 to 32 of a-z, 0-9 and -";
  if (e.build == nullptr || e.what == nullptr) return "build or what is null";
  if (e.memory != BROADSIDE_HOST && e.memory != BROADSIDE_CUDA) return "memory is neither host nor CUDA";
  if (e.create == nullptr || e.destroy == nullptr || e.last_error == nullptr)
    return "create, destroy or last_error is null";
  if (e.setting_count > 0 && e.settings == nullptr) return "settings is null";
  for (std::uint32_t k = 0; k < e.setting_count; ++k)
    if (!is_good_key(e.settings[k].key) || e.settings[k].what == nullptr)
      return "setting " + std::to_string(k) + " has no key of a-z, 0-9 and _, or no text";
  if (!is_whole(e.load_boxes, e.update_boxes, e.find_pairs, e.read_pairs))
    return "it has only some functions of a broad phase";
  if (!is_whole(e.load_scene, e.measure, e.read_separations)) return "it has only some functions of a narrow phase";
  if (!is_whole(e.begin, e.step, e.read_states)) return "it has only some functions of a dynamics engine";
  if (e.find_pairs == nullptr && e.measure == nullptr && e.step == nullptr) return "it offers nothing";
  return {};
}

// The declared value; empty when nothing is declared.
std::string_view declared(const broadside_engine2& e, std::string_view key) {
  for (std::uint32_t k = 0; k < e.declared_count; ++k)
    if (e.declared[k].key == key) return e.declared[k].value;
  return {};
}

// A declared value, or the value of the setting that it names.
core::Result<std::string> value_of(const broadside_engine2& e, const broadside_declared& one, const std::string& where,
                                   const core::Settings* settings) {
  constexpr std::string_view kSetting = "setting:";
  const std::string value = one.value;
  if (!value.starts_with(kSetting)) return value;
  const std::string key = value.substr(kSetting.size());
  for (std::uint32_t k = 0; k < e.setting_count; ++k)
    if (key == e.settings[k].key)
      return std::to_string(settings != nullptr ? settings->number(key) : e.settings[k].default_value);
  return Error{"it declares '" + std::string(one.key) + "' by the setting '" + key + "', which it does not have", where,
               "name one of its settings"};
}

// Laws decide by the declaration which records they read, so it must agree with the functions that are there.
std::string fault_of_contacts(const broadside_engine2& e) {
  const std::string_view contacts = declared(e, "contacts");
  const bool declares_points = contacts == "totals" || contacts == "geometry";
  if (e.read_points != nullptr && !declares_points)
    return "it has read_points but does not declare contacts = totals, or geometry where it knows no impulses";
  if (e.read_contacts != nullptr && contacts != "applications")
    return "it has read_contacts but does not declare contacts = applications";
  if (declares_points && e.read_points == nullptr)
    return "it declares contacts = " + std::string(contacts) + " but has no read_points";
  if (contacts == "applications" && e.read_contacts == nullptr)
    return "it declares contacts = applications but has no read_contacts";
  return {};
}

}  // namespace

std::string fault_of(const broadside_engine& e) {
  if (e.abi != BROADSIDE_ENGINE_ABI) return version_fault(e.abi, BROADSIDE_ENGINE_ABI);
  if (e.size != sizeof(broadside_engine))
    return "its table has " + std::to_string(e.size) + " bytes, not " + std::to_string(sizeof(broadside_engine)) +
           ": built with another broadside_engine.h";
  return fault_of_either(e);
}

std::string fault_of(const broadside_engine2& e) {
  if (e.abi != BROADSIDE_ENGINE_ABI_2) return version_fault(e.abi, BROADSIDE_ENGINE_ABI_2);
  if (std::string fault = fault_of_either(e); !fault.empty()) return fault;
  if (!is_text(e.build) || !is_text(e.what)) return "build or what is not one line of UTF-8";
  for (std::uint32_t k = 0; k < e.setting_count; ++k)
    if (!is_text(e.settings[k].what)) return "the text of setting " + std::to_string(k) + " is not one line of UTF-8";
  for (std::uint32_t k = 0; k < e.setting_count; ++k)
    if (std::strcmp(e.settings[k].key, kProgramKey.data()) == 0)
      return "a setting has the key 'program', which is the harness's own";
  if (e.declared_count > 0 && e.declared == nullptr) return "declared is null";
  for (std::uint32_t k = 0; k < e.declared_count; ++k)
    if (!is_text(e.declared[k].key) || !is_text(e.declared[k].value))
      return "declared " + std::to_string(k) + " has no key or no value, or one that is not one line of UTF-8";
  if (!std::isfinite(e.margin_m) || e.margin_m < 0.0) return "margin_m is not a finite number of 0 or more";
  const bool has_more = e.read_points != nullptr || e.read_contacts != nullptr || e.read_detection != nullptr ||
                        e.read_step_pairs != nullptr;
  if (has_more && e.step == nullptr) return "it reads points, contacts, detection or pairs of a step but has no step";
  if (e.read_step_pairs != nullptr && e.read_detection == nullptr)
    return "it has read_step_pairs and no read_detection, whose boxes say which pairs are due";
  return fault_of_contacts(e);
}

bool PluginSource::offers_dynamics() const {
  return version1() != nullptr ? version1()->step != nullptr : table().step != nullptr;
}

std::string PluginSource::capabilities() const {
  std::string text;
  const auto add = [&](bool is_there, const char* word) {
    if (is_there) text += text.empty() ? word : std::string(" ") + word;
  };
  add(offers_broad_phase(), "broad");
  add(offers_narrow_phase(), "narrow");
  add(offers_dynamics(), "dynamics");
  return text;
}

core::Result<core::Declaration> PluginSource::declaration(const std::string& where,
                                                          const core::Settings* settings) const {
  if (version1() != nullptr) return offers_dynamics() ? core::method_declaration() : core::Declaration();
  std::map<std::string, std::string> given;
  for (std::uint32_t k = 0; k < table().declared_count; ++k) {
    const broadside_declared& one = table().declared[k];
    auto value = value_of(table(), one, where, settings);
    if (!value) return value.error();
    if (!given.emplace(one.key, std::move(value).value()).second)
      return Error{"it declares '" + std::string(one.key) + "' twice", where, "declare each key once"};
  }
  return core::Declaration::parse(given, where);
}

core::Result<std::shared_ptr<PluginInstance>> PluginInstance::make(std::shared_ptr<const PluginSource> source,
                                                                   const std::vector<std::uint64_t>& values) {
  auto self = source->create(values);
  if (!self) return self.error();
  return std::shared_ptr<PluginInstance>(new PluginInstance(std::move(source), self.value()));
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
  return Error{why != nullptr && *why != '\0' ? core::shown_text(why)
                                              : "failed without a message (" + std::to_string(returned) + ")",
               where(stage), "", Exit::kMissing};
}

}  // namespace broadside::reference
