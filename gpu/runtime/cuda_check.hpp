// Turns a CUDA call's return code into an Error. All calls are checked this way.
#pragma once

#include <cuda_runtime_api.h>

#include <string>

#include "core/result.hpp"

namespace broadside::gpu {

inline core::Status cuda_status(cudaError_t code, const char* what) {
  if (code == cudaSuccess) return core::Done{};
  return core::Error{std::string(what) + " failed: " + cudaGetErrorString(code), "CUDA",
                     "look at the GPU's state and driver (nvidia-smi)", core::Exit::kInternal};
}

}  // namespace broadside::gpu

// Returns the Error from the enclosing function when the call fails.
#define BROADSIDE_CUDA_TRY(call)                                                                      \
  do {                                                                                                \
    if (auto broadside_status = ::broadside::gpu::cuda_status((call), #call); !broadside_status.ok()) \
      return broadside_status.error();                                                                \
  } while (false)
