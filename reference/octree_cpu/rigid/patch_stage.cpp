#include "reference/octree_cpu/rigid/patch_stage.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "core/method/rigid/end_patches.hpp"
#include "core/method/rigid/kept_patch.hpp"
#include "core/method/rigid/known_gaps.hpp"
#include "core/method/rigid/make_manifolds.hpp"
#include "core/method/rigid/sweep.hpp"

namespace broadside::reference {

using core::ContactPatch;

namespace {

// Some tens of microseconds a task: handing one to a thread takes about ten.
constexpr std::size_t kPairsOfBlock = 64;
constexpr std::size_t kBodiesOfBlock = 256;

// Calls make(k, block) for each k below count, and returns how many blocks were filled. Their items, joined block by
// block, are in the order of k.
template <typename Block, typename Make>
std::size_t fill_in_order(std::size_t count, std::size_t of_block, std::vector<Block>& blocks, const Make& make) {
  const std::size_t block_count = (count + of_block - 1) / of_block;
  if (blocks.size() < block_count) blocks.resize(block_count);
  tbb::parallel_for(std::size_t{0}, block_count, [&](std::size_t n) {
    blocks[n].clear();
    for (std::size_t k = n * of_block; k < std::min(count, (n + 1) * of_block); ++k) make(k, blocks[n]);
  });
  return block_count;
}

template <typename Block, typename Item>
void join(const std::vector<Block>& blocks, std::size_t block_count, std::vector<Item> Block::*items,
          std::vector<Item>& joined) {
  joined.clear();
  for (std::size_t n = 0; n < block_count; ++n)
    joined.insert(joined.end(), (blocks[n].*items).begin(), (blocks[n].*items).end());
}

bool is_before(const ContactPatch& p, const ContactPatch& q) {
  return p.a != q.a ? p.a < q.a : p.b < q.b;
}

core::NearReach near_reach(const core::RigidBodies& bodies, core::Pair pair) {
  const auto [i, j] = pair;
  return {bodies.fall_m[i] + bodies.fall_m[j], bodies.pushed[i], bodies.pushed[j]};
}

core::PairAhead ahead_of(const core::RigidBodies& bodies, core::Pair pair) {
  const auto [i, j] = pair;
  return {bodies.reach_m[i] + bodies.reach_m[j], near_reach(bodies, pair), bodies.swing_m[i] + bodies.swing_m[j],
          !bodies.are_followed(pair)};
}

}  // namespace

void PatchStage::load(const core::Scene& scene, bool keeps_patches) {
  domain_ = scene.domain;
  keeps_patches_ = keeps_patches;
  kept_.clear();
  last_kept_.clear();
  for (int k = 0; k < core::kFaceCount; ++k) {
    face_shapes_[static_cast<std::size_t>(k)] = core::domain_face_shape(k);
    face_poses_[static_cast<std::size_t>(k)] = core::domain_face_pose(scene.domain, k);
  }
  of_pairs_.clear();
  of_faces_.clear();
  patches_made_ = patches_carried_ = 0;
}

// Whether a patch leads to no contact in this step.
bool PatchStage::is_passing(const core::RigidBodies& bodies, core::Pair pair, const core::Manifold& found) const {
  const auto [i, j] = pair;
  const core::RigidShape& a = bodies.shapes[bodies.shape[i]];
  const core::RigidShape& b = bodies.shapes[bodies.shape[j]];
  const core::ContactPath path_a = bodies.path(i);
  const core::ContactPath path_b = bodies.path(j);
  if (bodies.are_followed(pair)) {
    const core::SweptWay way_a = core::free_way(path_a, a.balls.outer_m);
    const core::SweptWay way_b = core::free_way(path_b, b.balls.outer_m);
    const float thinner_m = bodies.thinner_m(pair);
    if (core::moves_far(core::length_of(way_a), core::length_of(way_b), thinner_m))
      return core::misses_patch(found, a.contact, way_a, b.contact, way_b, bodies.fall_m[i] + bodies.fall_m[j],
                                thinner_m);
  }
  const float near_m = core::near_m(found.normal, near_reach(bodies, pair));
  return core::passes_by(found, a.contact, path_a, b.contact, path_b, bodies.reach_m[i] + bodies.reach_m[j], near_m);
}

// Returns what was kept of the pair's patch if it can be carried along with its bodies, otherwise null. Sets `out` to
// that patch at their present poses.
const core::KeptPatch* PatchStage::carry(const core::RigidBodies& bodies, core::Pair pair, const core::PairAhead& ahead,
                                         core::Manifold& out) const {
  const auto [i, j] = pair;
  const core::ContactShape& a = bodies.shapes[bodies.shape[i]].contact;
  const core::RigidShape& b = bodies.shapes[bodies.shape[j]];
  if (!core::may_be_carried(a, b.contact, ahead)) return nullptr;
  const auto last =
      std::lower_bound(last_kept_.begin(), last_kept_.end(), core::pair_key(pair),
                       [](const KeptOfPair& k, std::uint64_t key) { return core::pair_key(k.pair) < key; });
  if (last == last_kept_.end() || last->pair != pair) return nullptr;
  const bool is_carried =
      core::carried(last->kept, a, bodies.pose(i), b.contact, bodies.pose(j), b.balls.outer_m, ahead.near.falls_m, out);
  return is_carried ? &last->kept : nullptr;
}

void PatchStage::touch_pair(const core::RigidBodies& bodies, core::Pair pair, Block& block) const {
  const auto [i, j] = pair;
  const core::PairAhead ahead = ahead_of(bodies, pair);
  core::Manifold found[core::kPatchesOfPair];
  if (const core::KeptPatch* last = carry(bodies, pair, ahead, found[0])) {
    block.patches.push_back({i, j, found[0]});
    block.kept.push_back({pair, *last});
    ++block.carried;
    return;
  }
  const core::ContactShape& a = bodies.shapes[bodies.shape[i]].contact;
  const core::ContactShape& b = bodies.shapes[bodies.shape[j]].contact;
  core::KnownGaps gaps;
  if (core::surely_passes(a, bodies.path(i), b, bodies.path(j), ahead, gaps)) return;
  const core::KnownGaps* const known = gaps.are_known ? &gaps : nullptr;
  const int count = core::make_manifolds(a, bodies.pose(i), b, bodies.pose(j), ahead.reach_m, found,
                                         known != nullptr ? &known->start : nullptr);
  int kept = 0;
  for (int n = 0; n < count; ++n) {
    if (is_passing(bodies, pair, found[n])) continue;
    if (!bodies.are_followed(pair))
      core::let_pass(found[n], a, bodies.path(i), b, bodies.path(j), ahead.reach_m, ahead.near.falls_m);
    found[kept++] = found[n];
  }
  kept = core::add_end_patches(a, bodies.path(i), b, bodies.path(j), ahead.swing_m, found, kept, known);
  for (int n = 0; n < kept; ++n) block.patches.push_back({i, j, found[n]});
  // Only a single patch is kept: where there are more, some are of the end of the step.
  if (keeps_patches_ && kept == 1 && core::has_quick_answers(a, b))
    block.kept.push_back({pair, core::kept_patch(found[0], bodies.pose(i), bodies.pose(j))});
}

void PatchStage::touch_bodies(const core::RigidBodies& bodies, std::span<const core::Pair> confirmed,
                              std::span<const std::uint8_t> asleep) {
  const auto is_idle = [&](std::uint32_t i) { return asleep[i] != 0 || bodies.is_static[i] != 0; };
  last_kept_.swap(kept_);
  const std::size_t blocks =
      fill_in_order(confirmed.size(), kPairsOfBlock, pair_blocks_, [&](std::size_t k, Block& block) {
        if (!is_idle(confirmed[k].i) || !is_idle(confirmed[k].j)) touch_pair(bodies, confirmed[k], block);
      });
  join(pair_blocks_, blocks, &Block::patches, of_pairs_);
  join(pair_blocks_, blocks, &Block::kept, kept_);
  for (std::size_t n = 0; n < blocks; ++n) patches_carried_ += pair_blocks_[n].carried;
}

// The distance up to which a face is tested: a body at rest may be driven into a face as fast as its fastest neighbor
// approaches. A face has no end that a body could pass by, so a distance that is too large costs time and nothing else.
void PatchStage::find_pushed_reach(const core::RigidBodies& bodies, std::span<const core::Pair> confirmed) {
  pushed_reach_m_.assign(bodies.count(), 0.0F);
  for (const auto [i, j] : confirmed) {
    pushed_reach_m_[i] = std::max(pushed_reach_m_[i], bodies.reach_m[j]);
    pushed_reach_m_[j] = std::max(pushed_reach_m_[j], bodies.reach_m[i]);
  }
  for (std::uint32_t i = 0; i < bodies.count(); ++i) pushed_reach_m_[i] += bodies.reach_m[i];
}

void PatchStage::touch_faces(const core::RigidBodies& bodies, std::span<const core::Pair> confirmed,
                             std::span<const std::uint8_t> asleep, std::vector<ContactPatch>& patches) {
  find_pushed_reach(bodies, confirmed);
  const auto touch = [&](std::size_t k, Block& block) {
    const auto i = static_cast<std::uint32_t>(k);
    if (bodies.is_static[i] != 0 || asleep[i] != 0) return;
    const core::Box& box = bodies.shape_boxes[i];
    const float reach_m = pushed_reach_m_[i];
    for (std::uint32_t face = 0; face < core::kFaceCount; ++face) {
      if (!core::may_reach_face(box, reach_m, domain_, face)) continue;
      core::Manifold found[core::kPatchesOfPair];
      const core::ContactShape& shape = bodies.shapes[bodies.shape[i]].contact;
      const core::ContactPose& pose = face_poses_[face];
      int count = core::make_manifolds(shape, bodies.pose(i), face_shapes_[face], pose, reach_m, found);
      count = core::add_end_patches(shape, bodies.path(i), face_shapes_[face], {pose, pose}, bodies.swing_m[i], found,
                                    count);
      for (int n = 0; n < count; ++n) block.patches.push_back({i, core::kFirstFace + face, found[n]});
    }
  };
  const std::size_t blocks = fill_in_order(bodies.count(), kBodiesOfBlock, face_blocks_, touch);
  join(face_blocks_, blocks, &Block::patches, of_faces_);
  patches.clear();
  std::merge(of_pairs_.begin(), of_pairs_.end(), of_faces_.begin(), of_faces_.end(), std::back_inserter(patches),
             is_before);
  patches_made_ += patches.size();
}

}  // namespace broadside::reference
