// What the host owns of a running GPU engine: its stream, and the words that the device writes into the host's memory.
#pragma once

#include <cuda_runtime_api.h>

#include <algorithm>
#include <cstdint>

#include "core/result.hpp"
#include "gpu/cuda_check.hpp"
#include "gpu/frame_view.hpp"

namespace broadside::gpu {

// Below this many bodies the tree start tests all pairs of body boxes: 2,080 tiles of 32 x 32 are one tile a warp on a
// large GPU, and take less than the grid's three passes.
constexpr std::uint32_t kLeastBodiesForGrid = 2048;

// The size of the grid's largest cells: a box may grow by a few units in the last place when it is placed, and a cell
// must be many such units of the coordinates, whatever it holds (see grid_level).
inline float grid_cell_m(float largest_side_m, float coordinate_range_m) {
  constexpr float kSlack = 1.0F + 0x1p-10F;
  constexpr float kLeastShare = 0x1p-17F;
  constexpr float kLeast = 0x1p-100F;  // halved twenty times, it is still a normal number, and so is its inverse
  return std::max({largest_side_m * kSlack, coordinate_range_m * kLeastShare, kLeast});
}

// Memory of the host that the device writes, with an owner.
class OutcomeMemory {
 public:
  OutcomeMemory() = default;
  OutcomeMemory(const OutcomeMemory&) = delete;
  OutcomeMemory& operator=(const OutcomeMemory&) = delete;
  ~OutcomeMemory() {
    if (host_ != nullptr) cudaFreeHost(host_);
  }
  core::Status allocate() {
    if (host_ == nullptr) {
      void* memory = nullptr;
      BROADSIDE_CUDA_TRY(cudaHostAlloc(&memory, sizeof(Outcome), cudaHostAllocMapped));
      host_ = static_cast<Outcome*>(memory);
    }
    *host_ = Outcome{};
    void* device = nullptr;
    BROADSIDE_CUDA_TRY(cudaHostGetDevicePointer(&device, host_, 0));
    device_ = static_cast<Outcome*>(device);
    return core::Done{};
  }
  [[nodiscard]] Outcome* device() const { return device_; }
  [[nodiscard]] const Outcome& operator*() const { return *host_; }

 private:
  Outcome* host_ = nullptr;
  Outcome* device_ = nullptr;
};

class Stream {
 public:
  Stream() = default;
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() {
    if (stream_ != nullptr) cudaStreamDestroy(stream_);
  }
  core::Status create() {
    if (stream_ == nullptr) BROADSIDE_CUDA_TRY(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
    return core::Done{};
  }
  [[nodiscard]] cudaStream_t get() const { return stream_; }

 private:
  cudaStream_t stream_ = nullptr;
};

}  // namespace broadside::gpu
