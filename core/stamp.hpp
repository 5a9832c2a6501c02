// Scene, engine, settings, build and machine: what must be equal for two results to be comparable bit by bit.
#pragma once

#include <cstdint>
#include <string>

namespace broadside::core {

struct Stamp {
  std::string scene_name;
  std::uint64_t scene_digest = 0;
  std::string engine;           // "octree-cpu"
  std::string settings;         // canonical form
  std::string settings_short;   // settings that differ from the defaults
  std::string engine_build;     // library and version
  std::string broadside_build;  // version, commit, compiler, flags
  std::string machine;          // CPU model, cores, memory, OS, GPU or "no device"

  // "octree-cpu" or "octree-cpu[levels=A]": how reports name a column.
  [[nodiscard]] std::string label() const {
    return settings_short.empty() ? engine : engine + "[" + settings_short + "]";
  }
};

}  // namespace broadside::core
