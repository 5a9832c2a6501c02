// What the kernels that stop fast bodies short are given, by value. RIGID 8.7; formulas: core/method/rigid/sweep.hpp.
#pragma once

#include <cstdint>

#include "core/math/box.hpp"
#include "core/pair.hpp"
#include "gpu/rigid/contact_view.hpp"

namespace broadside::gpu {

struct SweptCounts {
  std::uint32_t longest = 0;          // way of a body, m, as a word
  std::uint32_t has_changed[3] = {};  // in this round, or in the two beside it
  std::uint32_t stopped = 0;
};

struct SweptView {
  ContactView bodies;
  core::RigidState* after = nullptr;  // drawn back where it must
  float* length_m = nullptr;          // [bodies] of the whole way
  core::Box* boxes = nullptr;         // [bodies] that contain the whole way
  const core::Pair* pairs = nullptr;  // whose boxes meet
  std::uint64_t pair_count = 0;
  std::uint32_t* parts = nullptr;       // [bodies] of its way, that the body may go
  std::uint32_t* next_parts = nullptr;  // [bodies]
  std::uint32_t* is_changed = nullptr;  // [bodies]
  SweptCounts* counts = nullptr;
};

}  // namespace broadside::gpu
