// A validator whose law has several parts: one verdict, in which each part has its own worst place and counts.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/verdict.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {

struct PartLaw {
  const Tally& tally;
  std::string_view law;      // what holds
  std::string_view nothing;  // why it met nothing, where that is so
};

// whole: the validator's name, things and origin, with nothing counted. Its worst place is that of the worst part; of
// equally bad ones, the earliest, and then that of the first part. A failure says how many times each part was broken.
core::Verdict sum_up(std::span<const PartLaw> parts, Tally whole, std::string_view nothing, const std::string& notes);

}  // namespace broadside::validation
