// The options by which commands name a scene and engines.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/cell/cell_spec.hpp"
#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace CLI {
class App;
}

namespace broadside::bench {

struct SceneArguments {
  std::string spec;
  std::uint32_t frames = 0;     // 0 = the scene's own
  bool allow_stand_in = false;  // use a procedural body where a mesh is not on this machine

  void add_to(CLI::App& command);
  // The scene with its frames replaced where given. Errors name the scene, file, line and key.
  [[nodiscard]] core::Result<core::Scene> make() const;
};

struct EngineArguments {
  std::vector<std::string> engines;
  std::string file;  // a file with more engines, one on each line
  std::vector<std::string> settings;

  void add_to(CLI::App& command);
  // Whether no engine was named.
  [[nodiscard]] bool is_empty() const { return engines.empty() && file.empty(); }
  // The engines given by --engine, then the lines of the file, without blank lines and lines that begin with #.
  [[nodiscard]] core::Result<std::vector<std::string>> all() const;
  // A setting goes to every engine of the list that has its key; a key that no engine has is an error.
  [[nodiscard]] core::Result<std::vector<CellSpec>> make() const;
};

}  // namespace broadside::bench
