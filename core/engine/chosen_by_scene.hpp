// What an engine offers besides Dynamics when its method depends on the scene: one method where bodies translate,
// another where they turn.
#pragma once

#include <cstdint>
#include <string>

#include "core/engine/engine.hpp"
#include "core/scene/scene.hpp"

namespace broadside::core {

// A class derived from Dynamics may also derive from this.
class ChosenByScene {
 public:
  virtual ~ChosenByScene() = default;

  [[nodiscard]] virtual Declaration declaration_for(const Scene& scene) const = 0;
  // Like Dynamics::groups, which is correct only after a scene was loaded.
  [[nodiscard]] virtual std::uint32_t groups_for(const Scene& scene) const = 0;
  // What its digests cover, for /provenance/notes@digest; empty = what SCHEMA.md says.
  [[nodiscard]] virtual std::string digest_note_for(const Scene& scene) const = 0;
};

inline Declaration declaration_of(const Engine& engine, const Scene& scene) {
  const auto* chosen = dynamic_cast<const ChosenByScene*>(engine.dynamics.get());
  return chosen != nullptr ? chosen->declaration_for(scene) : engine.declaration;
}

inline std::uint32_t groups_of(const Dynamics& dynamics, const Scene& scene) {
  const auto* chosen = dynamic_cast<const ChosenByScene*>(&dynamics);
  return chosen != nullptr ? chosen->groups_for(scene) : dynamics.groups();
}

inline std::string digest_note_of(const Dynamics& dynamics, const Scene& scene) {
  const auto* chosen = dynamic_cast<const ChosenByScene*>(&dynamics);
  return chosen != nullptr ? chosen->digest_note_for(scene) : std::string();
}

}  // namespace broadside::core
