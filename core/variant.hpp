// The forms that the paper printed wrong (METHOD section 10), kept as variants that a validator must catch.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace broadside::core {

enum class Variant : int { kSound, kE1, kE2, kE3, kE4, kE5, kE6, kE7, kE8 };

struct VariantRow {
  std::string_view name;
  Variant variant;
  std::string_view what;
};

inline constexpr std::array<VariantRow, 9> kVariants{{
    {"sound", Variant::kSound, "the default: every formula in its sound form"},
    {"printed-E1", Variant::kE1, "P(4): the step-size limit without the damping term"},
    {"printed-E2", Variant::kE2, "P-Alg 2: only bodies stored in the same octree node become candidates"},
    {"printed-E3", Variant::kE3, "P(12): position correction with the two masses swapped"},
    {"printed-E4", Variant::kE4, "P(14): position correction also below the slop, so that it deepens"},
    {"printed-E5", Variant::kE5, "P(18): impulse floor on every approaching contact"},
    {"printed-E6", Variant::kE6, "P(21): sliding friction with the wrong sign"},
    {"printed-E7", Variant::kE7, "P-Alg 1: level offsets read before they are set, so nothing below level 1 is built"},
    {"printed-E8", Variant::kE8, "contacts written from parallel threads without an order"},
}};

constexpr std::optional<Variant> variant_named(std::string_view name) {
  for (const VariantRow& row : kVariants)
    if (row.name == name) return row.variant;
  return std::nullopt;
}

}  // namespace broadside::core
