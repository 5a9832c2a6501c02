// What the stages of a small frame read of shapes again and again, copied into a block's shared memory.
#pragma once

#include "core/method/levels.hpp"
#include "gpu/frame/small_frame_view.hpp"
#include "gpu/stages/grid/fetched.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/levels/shape_headers.cuh"

namespace broadside::gpu {

// Behind what every kernel has there. Of scenes with more shapes nothing is copied.
struct alignas(16) BlockShapes {
  static constexpr std::uint32_t kMost = 4;
  static constexpr std::uint32_t kMostUpper = 256;

  PackedBox octree[kMost * core::kBodyOctreeNodes];
  TreeHeader trees[kMost];
  NearCells cells[kMost];
  PackedBox upper[kMostUpper];
};

// Copies begin while bodies are integrated; octrees then only if levels come first. A warp that tests levels waits for
// the octrees.
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
  // By all threads of the block; one warp does it. begin() before a barrier of the block, end() after it.
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
  // Copies upper nodes, begun after bodies are loaded, ended before a thread leaves the block. By all its threads.
  __device__ void begin_upper(const SmallFrameView& f) const {
    if (has_upper_ && is_ours())
      upper_copy_.begin(room_->upper, f.shapes.tree_upper, f.shapes.tree_upper_count * sizeof(PackedBox));
  }
  __device__ void end_upper() const {
    if (has_upper_ && is_ours()) upper_copy_.wait();
  }
  // The same for octrees, once a launch, by one warp: begun before any thread waits for them, ended before the warp
  // leaves.
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
  // Neither the first warp, which waits at the grid's barrier, nor the last, which has bodies.
  __device__ static bool is_ours() { return threadIdx.x / 32 == blockDim.x / 64; }

  // By the warp, word by word: headers are no multiple of anything larger.
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
