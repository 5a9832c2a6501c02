// Contacts are solved eight patches at a time, one in each lane of a vector register. The patches of a tile share no
// moved body, and every lane does what core/method/rigid/soft_contact.hpp does to a float. So the bits are those of one
// patch at a time, with any instruction set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "core/method/rigid/solver_body.hpp"

namespace broadside::reference {

inline constexpr std::uint32_t kTileLanes = 8;

// Tiles [first, last) of those that begin at `tiles`, and the bodies that they name.
struct TileRange {
  std::byte* tiles = nullptr;
  std::size_t first = 0;
  std::size_t last = 0;
  core::SolverBody* bodies = nullptr;
};

// What a sweep along conjugate directions reads and writes.
struct SweepWay {
  bool is_one_of_many = true;  // one of several sweeps; otherwise there are no directions
  bool is_first = true;        // of its substep: there is no direction yet
  float share = 0.0F;          // of the last direction, which the impulses follow before the sweep
  float* speeds = nullptr;     // [tiles] the largest change of a point's speed, m/s
  float* changes = nullptr;    // [tiles][kTileLanes] core::squared_change
};

// What a sweep over the patches of stirred bodies reads and writes.
struct StirredSweep {
  std::uint32_t number = 0;           // of this sweep: it visits patches of bodies with stirred >= number
  float done_m_s = 0.0F;              // a larger change stirs a patch's bodies for the next sweep
  float share = 0.0F;                 // of the last direction
  std::uint32_t* stirred = nullptr;   // [bodies] the last sweep that has to visit the body's patches
  std::uint8_t* followers = nullptr;  // [tiles] a bit for each lane that has a direction
  float* largest = nullptr;           // [tiles] the largest change of a point's speed, m/s
  float* changes = nullptr;           // [tiles][kTileLanes] core::squared_change
};

// The functions over tiles for one instruction set. No other code knows the layout of a tile in memory.
struct PatchKernels {
  const char* name;
  std::size_t tile_bytes;
  // Makes a tile without patches, whose lanes touch only the body `still`, which never moves.
  void (*clear)(std::byte* tiles, std::size_t tile, std::uint32_t still);
  void (*put)(std::byte* tiles, std::size_t tile, std::uint32_t lane, const core::PatchConstraint& c);
  core::PatchConstraint (*get)(const std::byte* tiles, std::size_t tile, std::uint32_t lane);

  // The stages of soft_contact.hpp.
  // Stores the gaps in the tiles, and writes the speed of the fastest point by tile, core::fastest_push by place.
  void (*begin_sweeps)(const TileRange& range, const core::SoftStep& step, float* speeds, float* pushes);
  void (*warm_start)(const TileRange& range);
  void (*sweep)(const TileRange& range, const core::SoftStep& step, const SweepWay& way);
  void (*push_along)(const TileRange& range, float share);
  // Writes by place the largest change of a point's speed, m/s.
  void (*relax)(const TileRange& range, const core::SoftStep& step, float* changes);
  // The same, only of patches that have a stirred body and, with directions, of those that had one since these sweeps
  // began.
  void (*relax_stirred)(const TileRange& range, const core::SoftStep& step, const StirredSweep& sweep);
  // Applies to the bodies the next step along the directions of relax_stirred.
  void (*push_stirred)(const TileRange& range, const StirredSweep& sweep);
  void (*end_substep)(const TileRange& range);
};

// The instruction sets that this machine has; the first is the fastest.
std::span<const PatchKernels* const> all_patch_kernels();
inline const PatchKernels& patch_kernels() {
  return *all_patch_kernels().front();
}

#ifdef BROADSIDE_HAS_AVX2_KERNEL
extern const PatchKernels kAvx2PatchKernels;
#endif

}  // namespace broadside::reference
