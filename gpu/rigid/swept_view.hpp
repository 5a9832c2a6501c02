// The argument, by value, of the kernels that stop fast bodies short. RIGID 8.7; formulas: core/method/rigid/sweep.hpp.
#pragma once

#include <cstdint>

#include "core/math/box.hpp"
#include "core/pair.hpp"
#include "gpu/rigid/contact_view.hpp"

namespace broadside::gpu {

struct SweptCounts {
  std::uint32_t longest = 0;          // way of a body, m, as bits
  std::uint32_t has_changed[3] = {};  // 1: a round shortened a way; by round modulo 3
  std::uint32_t stopped = 0;
};

struct SweptView {
  ContactView bodies;
  core::RigidState* after = nullptr;  // a body that must stop is set back along its way
  float* length_m = nullptr;          // [bodies] of the whole way
  core::Box* boxes = nullptr;         // [bodies] each contains the whole way
  const core::Pair* pairs = nullptr;  // whose boxes overlap
  std::uint64_t pair_count = 0;
  std::uint32_t* parts = nullptr;       // [bodies] how many of the core::kPartsOfWay parts of its way the body may go
  std::uint32_t* next_parts = nullptr;  // [bodies]
  std::uint32_t* is_changed = nullptr;  // [bodies]
  SweptCounts* counts = nullptr;
};

}  // namespace broadside::gpu
