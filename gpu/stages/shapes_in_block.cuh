// What stages for few bodies ask of shapes again and again, in a block's shared memory.
#pragma once

#include "core/method/levels.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/fetched.cuh"
#include "gpu/stages/shape_headers.cuh"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// Beside what every kernel has there; of more shapes nothing is copied.
struct alignas(16) BlockShapes {
  static constexpr std::uint32_t kMost = 4;

  PackedBox octree[kMost * core::kBodyOctreeNodes];
  TreeHeader trees[kMost];
  NearCells cells[kMost];
};

// Asked for while bodies are integrated, octrees only where levels come first: waited for where a pair goes down them.
class ShapesInBlock {
 public:
  __device__ ShapesInBlock(const FrameView& f, unsigned char* shared, BlockCopy& copy)
      : room_(reinterpret_cast<BlockShapes*>(shared + f.block_bytes)),
        copy_(copy),
        are_there_(f.shapes.count <= BlockShapes::kMost),
        has_octrees_(are_there_ && f.levels != core::Levels::kFlat) {}

  __device__ bool has_octrees() const { return has_octrees_; }
  // By all threads of the block; one warp does it. Before the block meets and after it.
  __device__ void begin(const FrameView& f) const {
    if (!is_ours()) return;
    if (has_octrees_ && lane() == 0) copy_.init();
    __syncwarp();
    if (f.are_levels_first) begin_octrees(f);
    if (!are_there_ || !f.has_vertex_stage) return;
    copy(room_->trees, f.shapes.trees, f.shapes.count);
    copy(room_->cells, f.shapes.near_cells, f.shapes.count);
  }
  __device__ void end(const FrameView& f) const {
    if (f.are_levels_first && is_ours()) end_octrees();
  }
  // The same of octrees alone, once a launch, by one warp: before anybody waits for them, and before it leaves.
  __device__ void begin_octrees(const FrameView& f) const {
    if (has_octrees_)
      copy_.begin(room_->octree, f.shapes.octree, f.shapes.count * core::kBodyOctreeNodes * sizeof(PackedBox));
  }
  __device__ void end_octrees() const {
    if (has_octrees_) copy_.wait();
  }

  __device__ void wait() const { copy_.wait(); }
  __device__ core::Box at(std::uint32_t k) const { return fetched(room_->octree + k); }
  __device__ ShapeHeaders headers(const FrameView& f) const {
    return are_there_ ? ShapeHeaders{room_->trees, room_->cells} : ShapeHeaders{f.shapes.trees, f.shapes.near_cells};
  }

 private:
  // Neither the first warp, which meets for the block, nor the last, which has bodies.
  __device__ static bool is_ours() { return threadIdx.x / 32 == blockDim.x / 64; }

  // By the warp, word by word: headers are no multiple of anything larger.
  template <typename Header>
  __device__ static void copy(Header* to, const Header* from, std::uint32_t count) {
    static_assert(sizeof(Header) % sizeof(std::uint32_t) == 0);
    for (std::uint32_t w = lane(); w < count * sizeof(Header) / sizeof(std::uint32_t); w += 32)
      reinterpret_cast<std::uint32_t*>(to)[w] = reinterpret_cast<const std::uint32_t*>(from)[w];
  }

  BlockShapes* room_;
  BlockCopy& copy_;
  bool are_there_;
  bool has_octrees_;
};

}  // namespace broadside::gpu
