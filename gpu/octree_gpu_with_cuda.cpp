#include <cuda_runtime_api.h>

#include <string>

#include "gpu/cuda_check.hpp"
#include "gpu/octree_gpu.hpp"
#include "gpu/pair_finder.hpp"
#include "gpu/pipeline.hpp"

namespace broadside::gpu {
namespace {

std::string version_text(int version) {
  return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
}

}  // namespace

std::string octree_gpu_absent() {
  int count = 0;
  const cudaError_t code = cudaGetDeviceCount(&count);
  if (code == cudaSuccess && count > 0) return {};
  (void)cudaGetLastError();  // so that the answer is the same when asked again
  if (code == cudaErrorInsufficientDriver) return "no device: the CUDA driver is absent or older than this build needs";
  return "no device";
}

core::Result<core::Engine> create_octree_gpu(const core::Settings& settings) {
  if (const std::string why = octree_gpu_absent(); !why.empty())
    return core::Error{why, "octree-gpu", "run on a machine with an NVIDIA GPU", core::Exit::kMissing};
  PipelineOptions options;
  options.has_broad_phase = settings.text("broad") == "tree";
  options.levels = *core::levels_named(settings.text("levels"));
  options.variant = *core::variant_named(settings.text("variant"));
  const std::string& solver = settings.text("solver");
  if (solver == "jacobi") options.solver = Solver::kJacobi;
  if (solver == "printed-E8" || options.variant == core::Variant::kE8) options.solver = Solver::kRacing;
  options.has_vertex_stage = settings.text("vertex_stage") == "on";

  core::Engine engine;
  engine.id = "octree-gpu";
  engine.build = "Broadside, float32, CUDA " + version_text(CUDART_VERSION) + ", " + device_name();
  engine.settings = settings;
  engine.broad_phase = std::make_unique<PairFinder>(options.has_broad_phase);
  engine.dynamics = std::make_unique<Pipeline>(options);
  return engine;
}

std::string device_name() {
  int device = 0;
  cudaDeviceProp properties;
  int driver = 0;
  if (!octree_gpu_absent().empty() || cudaGetDevice(&device) != cudaSuccess ||
      cudaGetDeviceProperties(&properties, device) != cudaSuccess || cudaDriverGetVersion(&driver) != cudaSuccess)
    return "no device";
  return std::string(properties.name) + ", driver for CUDA " + version_text(driver);
}

}  // namespace broadside::gpu
