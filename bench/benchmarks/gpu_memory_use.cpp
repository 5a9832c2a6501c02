// Measures the device memory of the pipeline after some frames of 50 instances of a mesh, with recording off. Prints
// one JSON line for each mesh.
//   broadside_gpu_memory FRAMES MESH...
#include <cuda_runtime_api.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "datasets/scenes.hpp"
#include "gpu/engines_on_cuda.hpp"
#include "gpu/frame/pipeline.hpp"

namespace broadside::bench {
namespace {

bool complain(const core::Error& error) {
  std::fprintf(stderr, "%s\n", error.line().c_str());
  return false;
}

double free_mb() {
  std::size_t free = 0;
  std::size_t total = 0;
  (void)cudaMemGetInfo(&free, &total);
  return static_cast<double>(free) / 1e6;
}

bool tell(const std::string& mesh, int frames) {
  const std::string name = "freefall:" + mesh + ":50";
  auto scene = datasets::make_scene(name);
  if (!scene) return complain(scene.error());
  const double before_mb = free_mb();
  gpu::Pipeline pipeline(gpu::PipelineOptions{});
  if (core::Status s = pipeline.load(scene.value()); !s) return complain(s.error());
  for (int k = 0; k < frames; ++k)
    if (core::Status s = pipeline.step(scene.value().dt_s); !s) return complain(s.error());
  const gpu::MemoryUse use = pipeline.memory_use();
  const double after_mb = free_mb();
  const auto mb = [](std::uint64_t bytes) { return static_cast<double>(bytes) / 1e6; };
  std::printf(
      "{\"scene\": \"%s\", \"frames\": %d, \"shapes_mb\": %.3f, \"bodies_mb\": %.3f, \"appended_mb\": %.3f, "
      "\"buffers_mb\": %.3f, \"device_took_mb\": %.1f}\n",
      name.c_str(), frames, mb(use.shapes), mb(use.bodies), mb(use.appended),
      mb(use.shapes + use.bodies + use.appended), before_mb - after_mb);
  std::fflush(stdout);
  return true;
}

}  // namespace
}  // namespace broadside::bench

int main(int count, char** given) {
  if (const std::string why = broadside::gpu::gpu_absent(); !why.empty())
    return std::fprintf(stderr, "%s\n", why.c_str()), 3;
  if (count < 3) return std::fprintf(stderr, "usage: broadside_gpu_memory FRAMES MESH...\n"), 2;
  (void)cudaFree(nullptr);  // makes the CUDA context before anything is measured
  bool is_good = true;
  for (int k = 2; k < count; ++k) is_good = broadside::bench::tell(given[k], std::atoi(given[1])) && is_good;
  return is_good ? 0 : 1;
}
