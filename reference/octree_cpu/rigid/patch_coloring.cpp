#include "reference/octree_cpu/rigid/patch_coloring.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "core/contact.hpp"
#include "core/method/coloring.hpp"

namespace broadside::reference {
namespace {

constexpr std::uint32_t kFewColors = 64;  // the bits of a word; further patches of a body get ascending colors

}  // namespace

void PatchColoring::color(std::span<const core::ContactPatch> patches, std::span<const core::RigidMass> masses) {
  by_priority_.resize(patches.size());
  for (std::uint32_t k = 0; k < patches.size(); ++k)
    by_priority_[k] = {core::color_priority({patches[k].a, patches[k].b}), k};
  // The patches of a pair have the same priority; among them the index decides.
  std::sort(by_priority_.begin(), by_priority_.end(), [](const Ranked& p, const Ranked& q) {
    return p.priority != q.priority ? p.priority < q.priority : p.patch < q.patch;
  });

  used_.assign(masses.size(), 0);
  next_.assign(masses.size(), kFewColors);
  color_.resize(patches.size());
  std::uint32_t colors = 0;
  for (const Ranked& ranked : by_priority_) {
    const core::ContactPatch& patch = patches[ranked.patch];
    const bool moves_a = masses[patch.a].inverse_mass > 0.0F;
    const bool moves_b = !core::is_face(patch.b) && masses[patch.b].inverse_mass > 0.0F;
    const std::uint64_t used = (moves_a ? used_[patch.a] : 0) | (moves_b ? used_[patch.b] : 0);
    auto color = static_cast<std::uint32_t>(std::countr_one(used));
    if (color < kFewColors) {
      if (moves_a) used_[patch.a] |= std::uint64_t{1} << color;
      if (moves_b) used_[patch.b] |= std::uint64_t{1} << color;
    } else {
      color = std::max(moves_a ? next_[patch.a] : 0, moves_b ? next_[patch.b] : 0);
      if (moves_a) next_[patch.a] = color + 1;
      if (moves_b) next_[patch.b] = color + 1;
    }
    color_[ranked.patch] = color;
    colors = std::max(colors, color + 1);
  }

  begin_.assign(colors + 1, 0);
  for (const std::uint32_t c : color_) ++begin_[c + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  order_.resize(patches.size());
  std::vector<std::uint32_t> place(begin_.begin(), begin_.end());
  for (std::uint32_t k = 0; k < patches.size(); ++k) order_[place[color_[k]]++] = k;
}

}  // namespace broadside::reference
