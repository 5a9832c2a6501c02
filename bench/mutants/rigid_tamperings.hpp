// Traces of bodies that turn, spoiled by hand: each tampering takes a recording of plain-rigid and breaks one law of
// mechanics in it.
#pragma once

#include <span>
#include <string_view>

#include "bench/mutants/specimen.hpp"

namespace broadside::bench {

// Laws beside the intended one may reject it too.
struct RigidTampering {
  std::string_view law;
  std::string_view what;
  std::string_view scene;  // of rigid_scenes
  // Sets is_spoilable to false when the recording has nothing of the kind that it changes.
  void (*apply)(Specimen&);
  bool against_the_sound_one = false;  // judged with the sound recording as its baseline
};

// Three tables, by what is spoiled.
std::span<const RigidTampering> rigid_state_tamperings();
std::span<const RigidTampering> rigid_point_tamperings();
std::span<const RigidTampering> rigid_declaration_tamperings();

}  // namespace broadside::bench
