// The search kernel for AVX2: one register is a pack's eight boxes on one axis.
#include <immintrin.h>

#include "reference/scene_octree/tree_join.hpp"

namespace broadside::reference {
namespace {

struct Avx2 {
  struct Box {
    __m256 min_x, min_y, min_z, max_x, max_y, max_z;
  };
  static Box spread(const BoxPack& pack, std::uint32_t lane) {
    return {_mm256_broadcast_ss(pack.min_x + lane), _mm256_broadcast_ss(pack.min_y + lane),
            _mm256_broadcast_ss(pack.min_z + lane), _mm256_broadcast_ss(pack.max_x + lane),
            _mm256_broadcast_ss(pack.max_y + lane), _mm256_broadcast_ss(pack.max_z + lane)};
  }
  static unsigned overlapping(const BoxPack& pack, const Box& box) {
    const __m256 x = _mm256_and_ps(_mm256_cmp_ps(_mm256_load_ps(pack.min_x), box.max_x, _CMP_LE_OQ),
                                   _mm256_cmp_ps(box.min_x, _mm256_load_ps(pack.max_x), _CMP_LE_OQ));
    const __m256 y = _mm256_and_ps(_mm256_cmp_ps(_mm256_load_ps(pack.min_y), box.max_y, _CMP_LE_OQ),
                                   _mm256_cmp_ps(box.min_y, _mm256_load_ps(pack.max_y), _CMP_LE_OQ));
    const __m256 z = _mm256_and_ps(_mm256_cmp_ps(_mm256_load_ps(pack.min_z), box.max_z, _CMP_LE_OQ),
                                   _mm256_cmp_ps(box.min_z, _mm256_load_ps(pack.max_z), _CMP_LE_OQ));
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_and_ps(_mm256_and_ps(x, y), z)));
  }
};

}  // namespace

void join_avx2(const TreeView& tree, std::uint32_t pack_class, std::uint32_t first, std::uint32_t last,
               PairSink& sink) {
  Join<Avx2> join(tree, sink);
  for (std::uint32_t pack = first; pack < last; ++pack) join.search(pack_class, pack);
}

}  // namespace broadside::reference
