// Traces spoiled by hand: each tampering takes a sound recording of the mixed scene and breaks one law in it.
#pragma once

#include <span>
#include <string_view>

#include "bench/mutants/specimen.hpp"

namespace broadside::bench {

// Validators beside the intended one may reject it too, because a broken state breaks several laws.
struct Tampering {
  std::string_view validator;
  std::string_view what;
  // Sets is_spoilable to false when the recording has nothing of the kind that it changes.
  void (*apply)(Specimen&);
  bool against_the_sound_one = false;  // judged with the sound recording as its baseline
};

// Four tables, by what is spoiled.
std::span<const Tampering> pair_tamperings();
std::span<const Tampering> contact_tamperings();   // normals and positions
std::span<const Tampering> velocity_tamperings();  // impulses, friction, cap
std::span<const Tampering> state_tamperings();

}  // namespace broadside::bench
