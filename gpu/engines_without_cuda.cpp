#include "gpu/engines_on_cuda.hpp"

namespace broadside::gpu {

std::string gpu_absent() {
  return "no device: built without CUDA";
}

core::Result<core::Engine> create_octree_gpu(const core::Settings& /*settings*/) {
  return core::Error{gpu_absent(), "octree-gpu", "configure where nvcc is installed", core::Exit::kMissing};
}

core::Result<core::Engine> create_hash_gpu(const core::Settings& /*settings*/) {
  return core::Error{gpu_absent(), "hash-gpu", "configure where nvcc is installed", core::Exit::kMissing};
}

std::string device_name() {
  return "no device";
}

}  // namespace broadside::gpu
