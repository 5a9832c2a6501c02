// Copies what the stages of a small frame often read of shapes into a block's shared memory.
#pragma once

#include "core/method/levels.hpp"
#include "gpu/frame/small_frame_view.hpp"
#include "gpu/stages/grid/fetched.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/levels/shape_headers.cuh"

namespace broadside::gpu {

// It lies after what every kernel has there. If a scene has more shapes than kMost, nothing is copied.
struct alignas(16) BlockShapes {
  static constexpr std::uint32_t kMost = 4;
  static constexpr std::uint32_t kMostUpper = 256;

  PackedBox octree[kMost * core::kBodyOctreeNodes];
  TreeHeader trees[kMost];
  NearCells cells[kMost];
  PackedBox upper[kMostUpper];
};

// Copies begin while bodies are integrated; that of octrees begins then only if levels come first. A warp that tests
// levels waits for the octrees.
class ShapesInBlock {
 public:
  __device__ ShapesInBlock(const SmallFrameView& f, unsigned char* shared, BlockCopy& octree_copy,
                           BlockCopy& upper_copy)
      : room_(reinterpret_cast<BlockShapes*>(shared + f.block_bytes)),
        octree_copy_(octree_copy),
        upper_copy_(upper_copy),
        are_there_(f.shapes.count <= BlockShapes::kMost),
        has_octrees_(are_there_ && f.levels != core::Levels::kFlat),
        has_upper_(are_there_ && f.has_vertex_stage && f.shapes.tree_upper_count != 0 &&
                   f.shapes.tree_upper_count <= BlockShapes::kMostUpper) {}

  __device__ bool has_octrees() const { return has_octrees_; }
  // Called by all threads of the block, but one warp does the work: begin() before a barrier of the block, end() after
  // it.
  __device__ void begin(const SmallFrameView& f) const {
    if (!is_ours()) return;
    if (has_octrees_ && lane() == 0) octree_copy_.init();
    if (has_upper_ && lane() == 0) upper_copy_.init();
    __syncwarp();
    if (f.are_levels_first) begin_octrees(f);
    if (!are_there_ || !f.has_vertex_stage) return;
    copy(room_->trees, f.shapes.trees, f.shapes.count);
    copy(room_->cells, f.shapes.near_cells, f.shapes.count);
  }
  __device__ void end(const SmallFrameView& f) const {
    if (f.are_levels_first && is_ours()) end_octrees();
  }
  // Copies upper nodes. Called by all threads of the block: begin_upper() after bodies are loaded, end_upper() before
  // any thread ends.
  __device__ void begin_upper(const SmallFrameView& f) const {
    if (has_upper_ && is_ours())
      upper_copy_.begin(room_->upper, f.shapes.tree_upper, f.shapes.tree_upper_count * sizeof(PackedBox));
  }
  __device__ void end_upper() const {
    if (has_upper_ && is_ours()) upper_copy_.wait();
  }
  // The same for octrees, once a launch. Called by one warp: begin_octrees() before any thread waits for them,
  // end_octrees() before the warp ends.
  __device__ void begin_octrees(const SmallFrameView& f) const {
    if (has_octrees_)
      octree_copy_.begin(room_->octree, f.shapes.octree, f.shapes.count * core::kBodyOctreeNodes * sizeof(PackedBox));
  }
  __device__ void end_octrees() const {
    if (has_octrees_) octree_copy_.wait();
  }

  __device__ void wait() const { octree_copy_.wait(); }
  __device__ core::Box at(std::uint32_t k) const { return fetched(room_->octree + k); }
  __device__ ShapeHeaders headers(const SmallFrameView& f) const {
    if (!are_there_) return {f.shapes.trees, f.shapes.near_cells, f.shapes.tree_upper, nullptr};
    if (!has_upper_) return {room_->trees, room_->cells, f.shapes.tree_upper, nullptr};
    return {room_->trees, room_->cells, room_->upper, &upper_copy_};
  }

 private:
  // The warp that copies: not the first, which waits at the grid's barrier, nor the last, which has bodies.
  __device__ static bool is_ours() { return threadIdx.x / 32 == blockDim.x / 64; }

  // The warp copies word by word, since the size of a header is not a multiple of anything larger.
  template <typename Header>
  __device__ static void copy(Header* to, const Header* from, std::uint32_t count) {
    static_assert(sizeof(Header) % sizeof(std::uint32_t) == 0);
    for (std::uint32_t w = lane(); w < count * sizeof(Header) / sizeof(std::uint32_t); w += 32)
      reinterpret_cast<std::uint32_t*>(to)[w] = reinterpret_cast<const std::uint32_t*>(from)[w];
  }

  BlockShapes* room_;
  BlockCopy& octree_copy_;
  BlockCopy& upper_copy_;
  bool are_there_;
  bool has_octrees_;
  bool has_upper_;
};

}  // namespace broadside::gpu
