// A shared library with an engine in it, opened: core/plugin/broadside_engine.h.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/plugin/broadside_engine.h"
#include "core/result.hpp"

namespace broadside::reference {

class PluginLibrary {
 public:
  // Runs the library's own initializers, so call it only in a child process. Errors: no such file, not a shared
  // library, no entry, another version of the interface, half a group of functions, an unusable id (each named).
  static core::Result<std::shared_ptr<const PluginLibrary>> open(const std::filesystem::path& file);

  ~PluginLibrary();
  PluginLibrary(const PluginLibrary&) = delete;
  PluginLibrary& operator=(const PluginLibrary&) = delete;

  [[nodiscard]] const broadside_engine& engine() const { return *engine_; }
  [[nodiscard]] bool offers_broad_phase() const { return engine_->find_pairs != nullptr; }
  [[nodiscard]] bool offers_narrow_phase() const { return engine_->measure != nullptr; }
  [[nodiscard]] bool offers_dynamics() const { return engine_->step != nullptr; }
  // "broad narrow dynamics", for listings.
  [[nodiscard]] std::string capabilities() const;

 private:
  PluginLibrary(void* handle, const broadside_engine* engine) : handle_(handle), engine_(engine) {}

  void* handle_;
  const broadside_engine* engine_;
};

// One engine made by the library; destroyed with its last user.
class PluginInstance {
 public:
  // values[k] belongs to the library's settings[k].
  static core::Result<std::shared_ptr<PluginInstance>> make(std::shared_ptr<const PluginLibrary> library,
                                                            const std::vector<std::uint64_t>& values);
  ~PluginInstance();
  PluginInstance(const PluginInstance&) = delete;
  PluginInstance& operator=(const PluginInstance&) = delete;

  [[nodiscard]] const broadside_engine& table() const { return library_->engine(); }
  [[nodiscard]] void* self() const { return self_; }
  [[nodiscard]] std::string where(std::string_view stage) const;
  // The status that a function of the library returned, with the library's last_error when it failed.
  [[nodiscard]] core::Status checked(int returned, std::string_view stage) const;

 private:
  PluginInstance(std::shared_ptr<const PluginLibrary> library, void* self)
      : library_(std::move(library)), self_(self) {}

  std::shared_ptr<const PluginLibrary> library_;
  void* self_;
};

}  // namespace broadside::reference
