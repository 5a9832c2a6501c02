// The search kernel for AVX2: one register is a pack's eight boxes on one axis.
#include <immintrin.h>

#include "reference/scene_octree/tree_join.hpp"

namespace broadside::reference {
namespace {

// Row m: the numbers of the bits that are set in m, one byte each, lowest first.
struct SetBits {
  std::uint64_t rows[256];

  constexpr SetBits() : rows{} {
    for (std::uint32_t m = 0; m < 256; ++m) {
      unsigned at = 0;
      for (std::uint64_t bit = 0; bit < 8; ++bit)
        if ((m >> bit & 1U) != 0) rows[m] |= bit << (8U * at++);
    }
  }
};
constexpr SetBits kSetBits;

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
  static __m256i set_bits(unsigned hits) {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(kSetBits.rows + hits)));
  }
  static std::uint32_t* append(std::uint32_t* to, std::uint32_t base, unsigned hits) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                        _mm256_add_epi32(set_bits(hits), _mm256_set1_epi32(static_cast<int>(base))));
    return to + _mm_popcnt_u32(hits);
  }
  static FoundPair* emit(FoundPair* to, const std::uint32_t* ids, std::uint32_t id, unsigned hits) {
    const __m256i others =
        _mm256_permutevar8x32_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids)), set_bits(hits));
    const __m256i own = _mm256_set1_epi32(static_cast<int>(id));
    const __m256i low = _mm256_min_epu32(others, own);
    const __m256i high = _mm256_max_epu32(others, own);
    // Pairs 0, 1, 4, 5 and 2, 3, 6, 7.
    const __m256i even = _mm256_unpacklo_epi32(low, high);
    const __m256i odd = _mm256_unpackhi_epi32(low, high);
    auto* out = reinterpret_cast<__m256i*>(to);
    _mm256_storeu_si256(out, _mm256_permute2x128_si256(even, odd, 0x20));
    _mm256_storeu_si256(out + 1, _mm256_permute2x128_si256(even, odd, 0x31));
    return to + _mm_popcnt_u32(hits);
  }
};

}  // namespace

void join_avx2(const TreeView& tree, const TreeView& other, std::uint32_t pack_class, std::uint32_t first,
               std::uint32_t last, PairSink& sink) {
  Join<Avx2> join(tree, other, sink);
  for (std::uint32_t pack = first; pack < last; ++pack) join.search(pack_class, pack);
}

}  // namespace broadside::reference
