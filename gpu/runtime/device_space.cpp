#include "gpu/runtime/device_space.hpp"

#include "gpu/engines_on_cuda.hpp"

#ifdef BROADSIDE_HAS_CUDA
#include <cuda_runtime_api.h>
#endif

namespace broadside::gpu {

std::string device_absent() {
  return gpu_absent();
}

#ifdef BROADSIDE_HAS_CUDA
namespace {

core::Status checked(cudaError_t error, const char* what) {
  if (error == cudaSuccess) return core::Done{};
  return core::Error{std::string("CUDA: ") + cudaGetErrorString(error), what, "", core::Exit::kMissing};
}

// The device protects whole pages only, so a plug-in that writes just past the end of a block is not noticed here;
// compute-sanitizer finds it.
class DeviceBlock final : public core::MemoryBlock {
 public:
  DeviceBlock(void* data, std::size_t bytes) : data_(data), bytes_(bytes) {}
  DeviceBlock(const DeviceBlock&) = delete;
  DeviceBlock& operator=(const DeviceBlock&) = delete;
  ~DeviceBlock() override { cudaFree(data_); }

  [[nodiscard]] void* data() const override { return data_; }
  [[nodiscard]] std::size_t bytes() const override { return bytes_; }
  core::Status upload(const void* from, std::size_t bytes) override {
    return checked(cudaMemcpy(data_, from, bytes, cudaMemcpyHostToDevice), "copying to a plug-in");
  }
  core::Status download(void* to, std::size_t bytes) const override {
    return checked(cudaMemcpy(to, data_, bytes, cudaMemcpyDeviceToHost), "copying from a plug-in");
  }
  void lock() override {}
  void unlock() override {}

 private:
  void* data_;
  std::size_t bytes_;
};

class DeviceSpace final : public core::MemorySpace {
 public:
  core::Result<std::unique_ptr<core::MemoryBlock>> allocate(std::size_t wanted) override {
    const std::size_t bytes = (wanted + 15) / 16 * 16 + 16;
    void* data = nullptr;
    if (core::Status status = checked(cudaMalloc(&data, bytes), "memory for a plug-in"); !status) {
      core::Error error = status.error();
      error.what += " (" + std::to_string(bytes) + " bytes)";
      return error;
    }
    return std::unique_ptr<core::MemoryBlock>(std::make_unique<DeviceBlock>(data, bytes));
  }
};

}  // namespace

core::Result<std::unique_ptr<core::MemorySpace>> make_device_space() {
  if (const std::string why = device_absent(); !why.empty())
    return core::Error{why, "plug-in on the device", "", core::Exit::kMissing};
  return std::unique_ptr<core::MemorySpace>(std::make_unique<DeviceSpace>());
}
#else
core::Result<std::unique_ptr<core::MemorySpace>> make_device_space() {
  return core::Error{device_absent(), "plug-in on the device", "", core::Exit::kMissing};
}
#endif

}  // namespace broadside::gpu
