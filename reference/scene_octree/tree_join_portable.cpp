// The search kernel in plain C++: compilers can turn the loop over lanes into comparisons of whole registers (SSE2,
// NEON).
#include "reference/scene_octree/tree_join.hpp"

namespace broadside::reference {
namespace {

struct Portable {
  struct Box {
    float min_x, min_y, min_z, max_x, max_y, max_z;
  };
  static Box spread(const BoxPack& pack, std::uint32_t lane) {
    return {pack.min_x[lane], pack.min_y[lane], pack.min_z[lane], pack.max_x[lane], pack.max_y[lane], pack.max_z[lane]};
  }
  static unsigned overlapping(const BoxPack& pack, const Box& box) {
    // Each lane has its own bit of the answer, so the sum at the end adds distinct bits.
    constexpr std::uint32_t kBit[8] = {1, 2, 4, 8, 16, 32, 64, 128};
    std::uint32_t hit[8];
    for (int k = 0; k < 8; ++k) {
      const bool meets = (pack.min_x[k] <= box.max_x) & (box.min_x <= pack.max_x[k]) & (pack.min_y[k] <= box.max_y) &
                         (box.min_y <= pack.max_y[k]) & (pack.min_z[k] <= box.max_z) & (box.min_z <= pack.max_z[k]);
      hit[k] = meets ? kBit[k] : 0U;
    }
    return hit[0] + hit[1] + hit[2] + hit[3] + hit[4] + hit[5] + hit[6] + hit[7];
  }
  static std::uint32_t* append(std::uint32_t* to, std::uint32_t base, unsigned hits) {
    for (; hits != 0; hits &= hits - 1U) *to++ = base + static_cast<std::uint32_t>(__builtin_ctz(hits));
    return to;
  }
  static FoundPair* emit(FoundPair* to, const std::uint32_t* ids, std::uint32_t id, unsigned hits) {
    for (; hits != 0; hits &= hits - 1U) {
      const std::uint32_t other = ids[__builtin_ctz(hits)];
      *to++ = {id < other ? id : other, id < other ? other : id};
    }
    return to;
  }
};

}  // namespace

void join_portable(const TreeView& tree, const TreeView& other, std::uint32_t pack_class, std::uint32_t first,
                   std::uint32_t last, PairSink& sink) {
  Join<Portable> join(tree, other, sink);
  for (std::uint32_t pack = first; pack < last; ++pack) join.search(pack_class, pack);
}

}  // namespace broadside::reference
