// Which bodies touch in the frames of two traces, and where these sets first differ.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/result.hpp"

namespace broadside::bench::bisect {

struct ContactSetDifference {
  std::uint64_t step = 0;
  std::uint64_t was = 0;  // pairs that touch in this frame, a face of the domain counted as a body
  std::uint64_t is = 0;
  std::string only_before;  // the lowest pair that touches in the first trace alone, "3 and 17"; empty = none
  std::string only_after;   // likewise of the second
};

// Nothing where the sets are equal at all common steps, or where neither trace records which bodies touch. A pair
// touches when it has a contact, a point of contact, or a measured separation that says so. Forces, depths and the
// order of contacts do not count.
core::Result<std::optional<ContactSetDifference>> compare_contact_sets(const std::filesystem::path& was,
                                                                       const std::filesystem::path& is);

}  // namespace broadside::bench::bisect
