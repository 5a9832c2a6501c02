#include "reference/scene_octree/size_tree.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

namespace broadside::reference {
namespace {

using core::Box;

constexpr std::uint32_t kWidth = core::kTreeWidth;
// Nodes of level 1, 64 boxes each, per task: building is some 100 us of work.
constexpr std::uint32_t kBuildGrain = 64;
// Packs searched per task: some 50 us of work where boxes are spread, so that crowded places still divide.
constexpr std::uint32_t kSearchGrain = 64;

static_assert(sizeof(FoundPair) == sizeof(core::Pair) && alignof(FoundPair) == alignof(core::Pair));

JoinKernel kernel_for(Simd simd) {
#if defined(BROADSIDE_HAS_AVX2_KERNEL)
  if (simd == Simd::kFastest && __builtin_cpu_supports("avx2")) return join_avx2;
#endif
  static_cast<void>(simd);
  return join_portable;
}

std::uint32_t eighth(std::uint32_t n) {
  return (n + kWidth - 1U) / kWidth;
}

void put(BoxPack& pack, std::uint32_t lane, const Box& box) {
  pack.min_x[lane] = box.min.x;
  pack.min_y[lane] = box.min.y;
  pack.min_z[lane] = box.min.z;
  pack.max_x[lane] = box.max.x;
  pack.max_y[lane] = box.max.y;
  pack.max_z[lane] = box.max.z;
}

float least(const float (&lanes)[8]) {
  return *std::min_element(lanes, lanes + 8);
}
float most(const float (&lanes)[8]) {
  return *std::max_element(lanes, lanes + 8);
}

Box bounds_of(const BoxPack& pack) {
  return {{least(pack.min_x), least(pack.min_y), least(pack.min_z)},
          {most(pack.max_x), most(pack.max_y), most(pack.max_z)}};
}

// Hands a worker's blocks to a kernel.
void take_more(PairSink& sink) {
  auto& writer = *static_cast<PairWriter*>(sink.owner);
  if (sink.next != nullptr) writer.commit(reinterpret_cast<core::Pair*>(sink.next));
  sink.next = reinterpret_cast<FoundPair*>(writer.room(64));
  sink.end = reinterpret_cast<FoundPair*>(writer.end());
}

}  // namespace

SizeTree::SizeTree(Simd simd) : join_(kernel_for(simd)) {}

bool SizeTree::build(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) {
  survey(boxes);
  if (!whole_.is_sound) return false;
  plan_.counts.clear();
  if (!boxes.empty()) sort_boxes(boxes);
  lay_out();
  fill_packs(boxes, is_static);
  fill_upper_levels();
  return true;
}

void SizeTree::lay_out() {
  classes_.resize(plan_.counts.size());
  first_box_.resize(plan_.counts.size());
  std::uint32_t packs = 0;
  std::uint32_t boxes = 0;
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    classes_[c].packs = eighth(plan_.counts[c]);
    classes_[c].level_begin[0] = packs;
    first_box_[c] = boxes;
    packs += classes_[c].packs;
    boxes += plan_.counts[c];
  }
  ids_.resize(std::size_t{kWidth} * packs);
  static_lanes_.resize(packs);
  for (TreeClass& tree : classes_) {
    tree.level_count = 1;
    std::uint32_t count = tree.packs;
    do {
      count = eighth(count);
      tree.level_begin[tree.level_count++] = packs;
      packs += count;
    } while (count > 1U);
  }
  packs_.resize(packs);
}

void SizeTree::fill_packs(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) {
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    const TreeClass& tree = classes_[c];
    const auto fill_node = [&](std::uint32_t node) {
      BoxPack& parent = packs_[tree.level_begin[1] + node];
      for (std::uint32_t lane = 0; lane < kWidth; ++lane) {
        const std::uint32_t pack = node * kWidth + lane;
        Box bounds = core::empty_box();
        if (pack < tree.packs) {
          const std::uint32_t at = tree.level_begin[0] + pack;
          const std::uint32_t first = pack * kWidth;
          const std::uint32_t count = std::min(kWidth, plan_.counts[c] - first);
          std::uint32_t static_bits = 0;
          for (std::uint32_t k = 0; k < kWidth; ++k) {
            if (k >= count) {
              put(packs_[at], k, core::empty_box());
              ids_[std::size_t{kWidth} * at + k] = 0;
              continue;
            }
            const std::uint32_t id = id_of(sorted_[first_box_[c] + first + k]);
            const Box& box = boxes[id];
            put(packs_[at], k, box);
            bounds = core::grown(core::grown(bounds, box.min), box.max);
            ids_[std::size_t{kWidth} * at + k] = id;
            static_bits |= static_cast<std::uint32_t>(is_static[id] != 0) << k;
          }
          static_lanes_[at] = static_cast<std::uint8_t>(static_bits);
        }
        put(parent, lane, bounds);
      }
    };
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, eighth(tree.packs), kBuildGrain), [&](const auto& nodes) {
      for (std::uint32_t node = nodes.begin(); node != nodes.end(); ++node) fill_node(node);
    });
  }
}

void SizeTree::fill_upper_levels() {
  for (const TreeClass& tree : classes_) {
    std::uint32_t below = eighth(tree.packs);
    for (std::uint32_t level = 2; level < tree.level_count; ++level) {
      const std::uint32_t count = eighth(below);
      const auto fill_node = [&](std::uint32_t node) {
        BoxPack& parent = packs_[tree.level_begin[level] + node];
        for (std::uint32_t lane = 0; lane < kWidth; ++lane) {
          const std::uint32_t child = node * kWidth + lane;
          put(parent, lane,
              child < below ? bounds_of(packs_[tree.level_begin[level - 1U] + child]) : core::empty_box());
        }
      };
      tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, kBuildGrain), [&](const auto& nodes) {
        for (std::uint32_t node = nodes.begin(); node != nodes.end(); ++node) fill_node(node);
      });
      below = count;
    }
  }
}

TreeView SizeTree::view() const {
  return {packs_.data(), classes_.data(), ids_.data(), static_lanes_.data(),
          static_cast<std::uint32_t>(classes_.size())};
}

void SizeTree::find() {
  found_.clear();
  const TreeView tree = view();
  for (std::uint32_t c = 0; c < tree.class_count; ++c) {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, classes_[c].packs, kSearchGrain), [&](const auto& packs) {
      PairWriter& writer = found_.writer();
      PairSink sink{nullptr, nullptr, &writer, take_more};
      take_more(sink);
      join_(tree, c, packs.begin(), packs.end(), sink);
      writer.commit(reinterpret_cast<core::Pair*>(sink.next));
    });
  }
}

void SizeTree::read_back(std::vector<core::Pair>& out) {
  std::uint32_t bodies = 0;
  for (const std::uint32_t count : plan_.counts) bodies += count;
  pair_order_.order(found_.gather(), bodies, out);
}

}  // namespace broadside::reference
