// Makes a frame's record, in the record's order, from the arrays that the device made.
#pragma once

#include <cstdint>
#include <span>

#include "core/contact.hpp"
#include "core/method/proximity.hpp"
#include "core/pair.hpp"
#include "core/trace/frame.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

// How much of each buffer the frame filled.
struct FrameCounts {
  std::uint64_t bodies = 0;
  std::uint64_t pairs = 0;
  std::uint64_t confirmed = 0;
  std::uint64_t proximity = 0;
  std::uint64_t contacts = 0;
  std::uint64_t face_contacts = 0;
};

// In the host's memory.
struct FrameArrays {
  std::span<const PackedVec3> position;
  std::span<const PackedVec3> velocity;
  std::span<const PackedVec3> detected_position;
  std::span<const PackedVec3> detected_velocity;
  std::span<const PackedBox> boxes;
  std::span<const core::Pair> pairs;
  std::span<const core::Pair> confirmed;
  std::span<const core::Proximity> proximity;  // one per confirmed pair, or none
  std::span<const core::Contact> contacts;
  std::span<const core::Contact> face_contacts;
};

// The device appends in any order. Here pairs and confirmed pairs are sorted, and contacts are put in the order in
// which they were applied: those of pairs by color and pair, then those with faces by body and face. Fills all but
// step, time, digest and what a scene fixes.
void fill_record(const FrameArrays& arrays, core::FrameRecord& frame);

}  // namespace broadside::gpu
