// A broad phase on the GPU: every box against every other one, from shared memory, block by block. Boxes and pairs are
// device pointers.
#include <cstdint>
#include <cstdio>

#include "broadside_engine.h"

namespace {

constexpr unsigned kTile = 128;

struct Tiles {
  std::uint32_t count = 0;
  broadside_box* boxes = nullptr;
  std::uint8_t* is_static = nullptr;
  broadside_pair* pairs = nullptr;
  std::uint64_t room = 0;
  unsigned long long* found = nullptr;  // on the device
  std::uint64_t demanded = 0;
  char error[128] = "";
};

__device__ bool overlap(const broadside_box& a, const broadside_box& b) {
  for (int k = 0; k < 3; ++k)
    if (a.min[k] > b.max[k] || b.min[k] > a.max[k]) return false;
  return true;
}

__global__ void test_tiles(const broadside_box* boxes, const std::uint8_t* is_static, std::uint32_t n,
                           broadside_pair* pairs, std::uint64_t room, unsigned long long* found) {
  if (blockIdx.y < blockIdx.x) return;
  __shared__ broadside_box others[kTile];
  const std::uint32_t i = blockIdx.x * kTile + threadIdx.x;
  const std::uint32_t first = blockIdx.y * kTile;
  if (first + threadIdx.x < n) others[threadIdx.x] = boxes[first + threadIdx.x];
  __syncthreads();
  if (i >= n) return;
  const broadside_box mine = boxes[i];
  for (std::uint32_t t = 0; t < kTile && first + t < n; ++t) {
    const std::uint32_t j = first + t;
    if (j <= i || !overlap(mine, others[t]) || (is_static[i] && is_static[j])) continue;
    const unsigned long long at = atomicAdd(found, 1ull);
    if (at < room) pairs[at] = {i, j};
  }
}

int failed(Tiles& t, cudaError_t error) {
  if (error == cudaSuccess) return BROADSIDE_OK;
  std::snprintf(t.error, sizeof t.error, "CUDA: %s", cudaGetErrorString(error));
  return BROADSIDE_FAILED;
}

int launch(Tiles& t) {
  if (const int bad = failed(t, cudaMemset(t.found, 0, sizeof *t.found))) return bad;
  const unsigned blocks = (t.count + kTile - 1) / kTile;
  if (blocks > 0) test_tiles<<<dim3(blocks, blocks), kTile>>>(t.boxes, t.is_static, t.count, t.pairs, t.room, t.found);
  if (const int bad = failed(t, cudaGetLastError())) return bad;
  unsigned long long found = 0;
  if (const int bad = failed(t, cudaMemcpy(&found, t.found, sizeof found, cudaMemcpyDeviceToHost))) return bad;
  t.demanded = found;
  return BROADSIDE_OK;
}

void* create(const std::uint64_t*) {
  auto* t = new Tiles;
  if (cudaMalloc(&t->found, sizeof *t->found) == cudaSuccess) return t;
  delete t;
  return nullptr;
}

void destroy(void* self) {
  auto* t = static_cast<Tiles*>(self);
  cudaFree(t->boxes);
  cudaFree(t->is_static);
  cudaFree(t->pairs);
  cudaFree(t->found);
  delete t;
}

const char* last_error(void* self) {
  return self == nullptr ? "no CUDA device" : static_cast<Tiles*>(self)->error;
}

int update_boxes(void* self, const broadside_box* boxes, std::uint32_t count) {
  auto& t = *static_cast<Tiles*>(self);
  return failed(t, cudaMemcpy(t.boxes, boxes, count * sizeof *boxes, cudaMemcpyDeviceToDevice));
}

int load_boxes(void* self, const broadside_box* boxes, const std::uint8_t* is_static, std::uint32_t count) {
  auto& t = *static_cast<Tiles*>(self);
  cudaFree(t.boxes);
  cudaFree(t.is_static);
  t.boxes = nullptr;
  t.is_static = nullptr;
  t.count = count;
  if (const int bad = failed(t, cudaMalloc(&t.boxes, (count + 1) * sizeof *boxes))) return bad;
  if (const int bad = failed(t, cudaMalloc(&t.is_static, count + 1))) return bad;
  if (const int bad = failed(t, cudaMemcpy(t.is_static, is_static, count, cudaMemcpyDeviceToDevice))) return bad;
  return update_boxes(self, boxes, count);
}

// Counts the pairs; when the buffers were too small, they grow and it runs again.
int find_pairs(void* self) {
  auto& t = *static_cast<Tiles*>(self);
  if (const int bad = launch(t)) return bad;
  if (t.demanded <= t.room) return BROADSIDE_OK;
  cudaFree(t.pairs);
  t.pairs = nullptr;
  t.room = t.demanded + t.demanded / 4;
  if (const int bad = failed(t, cudaMalloc(&t.pairs, t.room * sizeof *t.pairs))) return bad;
  return launch(t);
}

int read_pairs(void* self, broadside_pair* pairs, std::uint64_t capacity, std::uint64_t* demanded) {
  auto& t = *static_cast<Tiles*>(self);
  *demanded = t.demanded;
  const std::uint64_t count = t.demanded < capacity ? t.demanded : capacity;
  return failed(t, cudaMemcpy(pairs, t.pairs, count * sizeof *pairs, cudaMemcpyDeviceToDevice));
}

broadside_engine table() {
  broadside_engine engine{};
  engine.abi = BROADSIDE_ENGINE_ABI;
  engine.size = sizeof(broadside_engine);
  engine.id = "example-tiles";
  engine.build = "example 1.0, CUDA, float";
  engine.what = "an example in CUDA: all pairs from shared memory";
  engine.memory = BROADSIDE_CUDA;
  engine.is_exact = 1;
  engine.create = create;
  engine.destroy = destroy;
  engine.last_error = last_error;
  engine.load_boxes = load_boxes;
  engine.update_boxes = update_boxes;
  engine.find_pairs = find_pairs;
  engine.read_pairs = read_pairs;
  return engine;
}

}  // namespace

extern "C" const broadside_engine* broadside_engine_v1(void) {
  static const broadside_engine engine = table();
  return &engine;
}
