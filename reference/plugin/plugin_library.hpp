// A shared library with an engine in it, opened: core/plugin/broadside_engine.h and broadside_engine_v2.h.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "reference/plugin/plugin_source.hpp"

namespace broadside::reference {

class PluginLibrary final : public PluginSource {
 public:
  // Version 2 where the library exports it, else version 1. Runs the library's own initializers, so call it only in a
  // child process. Errors: no such file, not a shared library, no entry, another version of the interface, half a group
  // of functions, an unusable id (each named).
  static core::Result<std::shared_ptr<const PluginSource>> open(const std::filesystem::path& file);

  ~PluginLibrary() override;
  PluginLibrary(const PluginLibrary&) = delete;
  PluginLibrary& operator=(const PluginLibrary&) = delete;

  [[nodiscard]] const broadside_engine2& table() const override { return table_; }
  [[nodiscard]] const broadside_engine* version1() const override { return version1_; }
  [[nodiscard]] core::Result<void*> create(const std::vector<std::uint64_t>& values) const override;

 private:
  explicit PluginLibrary(void* handle) : handle_(handle) {}
  // The fault of the tables that the entries returned; empty when there is none.
  std::string take(const broadside_engine& table);
  std::string take(const broadside_engine2& table);

  void* handle_;
  broadside_engine2 table_{};
  const broadside_engine* version1_ = nullptr;
};

}  // namespace broadside::reference
