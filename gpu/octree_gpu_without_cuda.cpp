#include "gpu/octree_gpu.hpp"

namespace broadside::gpu {

std::string octree_gpu_absent() {
  return "no device: built without CUDA";
}

core::Result<core::Engine> create_octree_gpu(const core::Settings& /*settings*/) {
  return core::Error{octree_gpu_absent(), "octree-gpu", "configure where nvcc is installed", core::Exit::kMissing};
}

std::string device_name() {
  return "no device";
}

}  // namespace broadside::gpu
