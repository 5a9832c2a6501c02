// Where an engine from outside this tree comes from: a shared library or a program. Both appear as the function table
// of version 2 of the C interface.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine/declaration.hpp"
#include "core/engine/settings.hpp"
#include "core/plugin/broadside_engine_v2.h"
#include "core/result.hpp"

namespace broadside::reference {

// Settings that the harness adds: the file or the command that an engine came from.
inline constexpr std::string_view kLibraryKey = "library";
inline constexpr std::string_view kProgramKey = "program";

class PluginSource {
 public:
  virtual ~PluginSource() = default;

  // For a library of version 1, the functions that take or give structs of version 2 are missing.
  [[nodiscard]] virtual const broadside_engine2& table() const = 0;
  // The table of a library that speaks version 1 alone; null otherwise.
  [[nodiscard]] virtual const broadside_engine* version1() const { return nullptr; }
  // Does what table()'s create does. values[k] belongs to settings[k].
  [[nodiscard]] virtual core::Result<void*> create(const std::vector<std::uint64_t>& values) const = 0;
  // Seconds of the last step by the engine's own clock; NaN where the engine does not report them.
  [[nodiscard]] virtual double last_step_s(void*) const { return std::numeric_limits<double>::quiet_NaN(); }
  // Whether calls go through a pipe, so that times measured here include it.
  [[nodiscard]] virtual bool is_behind_a_pipe() const { return false; }
  [[nodiscard]] virtual bool tells_step_seconds() const { return false; }

  [[nodiscard]] bool offers_broad_phase() const { return table().find_pairs != nullptr; }
  [[nodiscard]] bool offers_narrow_phase() const { return table().measure != nullptr; }
  [[nodiscard]] bool offers_dynamics() const;
  // "broad narrow dynamics", for listings.
  [[nodiscard]] std::string capabilities() const;
  // The declaration of the dynamics with these settings, null for the defaults: a declared value "setting:KEY" is the
  // value of the setting KEY. A library of version 1 declares nothing, and the laws of METHOD are applied to it, as
  // before there were declarations.
  [[nodiscard]] core::Result<core::Declaration> declaration(const std::string& where,
                                                            const core::Settings* settings = nullptr) const;
};

// The fault of the table; empty when there is none. Checks everything that other functions here rely on.
std::string fault_of(const broadside_engine2& table);
std::string fault_of(const broadside_engine& table);

// One engine made by a source; destroyed with its last user.
class PluginInstance {
 public:
  static core::Result<std::shared_ptr<PluginInstance>> make(std::shared_ptr<const PluginSource> source,
                                                            const std::vector<std::uint64_t>& values);
  ~PluginInstance();
  PluginInstance(const PluginInstance&) = delete;
  PluginInstance& operator=(const PluginInstance&) = delete;

  [[nodiscard]] const PluginSource& source() const { return *source_; }
  [[nodiscard]] const broadside_engine2& table() const { return source_->table(); }
  [[nodiscard]] void* self() const { return self_; }
  [[nodiscard]] std::string where(std::string_view stage) const;
  // The status that a function returned, with last_error's line when it failed.
  [[nodiscard]] core::Status checked(int returned, std::string_view stage) const;

 private:
  PluginInstance(std::shared_ptr<const PluginSource> source, void* self) : source_(std::move(source)), self_(self) {}

  std::shared_ptr<const PluginSource> source_;
  void* self_;
};

}  // namespace broadside::reference
