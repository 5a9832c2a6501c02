#include "reference/scene_octree/size_tree.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "reference/scene_octree/curve_order.hpp"

namespace broadside::reference {
namespace {

using core::Box;

constexpr std::uint32_t kWidth = core::kTreeWidth;
// Nodes of level 1, 64 boxes each, per task: building is some 100 us of work.
constexpr std::uint32_t kBuildGrain = 64;
// Packs searched per task: some 50 us of work where boxes are spread, and few enough that the work in crowded places is
// still divided.
constexpr std::uint32_t kSearchGrain = 64;

static_assert(sizeof(FoundPair) == sizeof(core::Pair) && alignof(FoundPair) == alignof(core::Pair));

JoinKernel kernel_for(Simd simd) {
#if defined(BROADSIDE_HAS_AVX2_KERNEL)
  if (simd == Simd::kFastest && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt")) return join_avx2;
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

// Gives a kernel more room in a worker's blocks.
void take_more(PairSink& sink) {
  auto& writer = *static_cast<PairWriter*>(sink.owner);
  if (sink.next != nullptr) writer.commit(reinterpret_cast<core::Pair*>(sink.next));
  sink.next = reinterpret_cast<FoundPair*>(writer.room(64));
  sink.end = reinterpret_cast<FoundPair*>(writer.end());
}

}  // namespace

SizeTree::SizeTree(Simd simd) : join_(kernel_for(simd)) {}

bool SizeTree::build(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) {
  classes_.clear();
  if (!buckets_.deal(boxes, is_static)) return false;
  body_count_ = static_cast<std::uint32_t>(boxes.size());
  lay_out();
  tbb::parallel_for(std::size_t{0}, buckets_.buckets().size(), [&](std::size_t b) { fill_bucket(b); });
  fill_upper_levels();
  return true;
}

void SizeTree::lay_out() {
  classes_.assign(buckets_.class_count(), TreeClass{});
  first_pack_.clear();
  std::uint32_t packs = 0;
  for (const Bucket& bucket : buckets_.buckets()) {
    TreeClass& tree = classes_[bucket.size_class];
    if (tree.packs == 0) tree.level_begin[0] = packs;
    first_pack_.push_back(packs);
    tree.packs += eighth(bucket.count());
    packs += eighth(bucket.count());
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
  // Sets the free lanes of the last node of level 1; all other lanes are written by the buckets.
  for (const TreeClass& tree : classes_)
    for (std::uint32_t lane = tree.packs; lane % kWidth != 0; ++lane)
      put(packs_[tree.level_begin[1] + lane / kWidth], lane % kWidth, core::empty_box());
}

// Orders a bucket's boxes, packs them by eights, and puts each pack's bounds in its lane of level 1.
void SizeTree::fill_bucket(std::size_t bucket_index) {
  thread_local CurveOrder curve_order;
  const Bucket& bucket = buckets_.buckets()[bucket_index];
  const BoxRecord* records = buckets_.records(bucket);
  const std::span<const KeyedId> order = curve_order.order(records, bucket.count());
  const TreeClass& tree = classes_[bucket.size_class];
  std::uint32_t pack = first_pack_[bucket_index];
  for (std::uint32_t first = 0; first < bucket.count(); first += kWidth, ++pack) {
    const std::uint32_t count = std::min(kWidth, bucket.count() - first);
    BoxPack& filled = packs_[pack];
    std::uint32_t* ids = ids_.data() + std::size_t{kWidth} * pack;
    std::uint32_t static_bits = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      const BoxRecord& record = records[id_of(order[first + k])];
      put(filled, k, record.box);
      ids[k] = record.id;
      static_bits |= record.is_static << k;
    }
    for (std::uint32_t k = count; k < kWidth; ++k) {
      put(filled, k, core::empty_box());
      ids[k] = 0;
      static_bits |= 1U << k;
    }
    static_lanes_[pack] = static_cast<std::uint8_t>(static_bits);
    const std::uint32_t lane = pack - tree.level_begin[0];
    put(packs_[tree.level_begin[1] + lane / kWidth], lane % kWidth, bounds_of(filled));
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

void SizeTree::renumber(std::span<const std::uint32_t> ids) {
  for (std::uint32_t& id : ids_) id = ids[id];
}

void SizeTree::order_of_boxes(std::vector<std::uint32_t>& ids) const {
  ids.clear();
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    const BoxPack& pack = packs_[k / kWidth];
    // A lane without a box has min above max.
    if (pack.min_x[k % kWidth] <= pack.max_x[k % kWidth]) ids.push_back(ids_[k]);
  }
}

void SizeTree::find() {
  found_.clear();
  const TreeView tree = view();
  join(tree, tree);
}

void SizeTree::find_more(const SizeTree& other) {
  join(view(), other.view());
}

void SizeTree::join(const TreeView& tree, const TreeView& other) {
  for (std::uint32_t c = 0; c < tree.class_count; ++c) {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, classes_[c].packs, kSearchGrain), [&](const auto& packs) {
      PairWriter& writer = found_.writer();
      PairSink sink{nullptr, nullptr, &writer, take_more};
      take_more(sink);
      join_(tree, other, c, packs.begin(), packs.end(), sink);
      writer.commit(reinterpret_cast<core::Pair*>(sink.next));
      nodes_visited_.fetch_add(sink.nodes_visited, std::memory_order_relaxed);
      packs_tested_.fetch_add(sink.packs_tested, std::memory_order_relaxed);
    });
  }
}

void SizeTree::read_back(std::vector<core::Pair>& out) {
  pair_order_.order(found_.gather(), body_count_, out);
}

}  // namespace broadside::reference
