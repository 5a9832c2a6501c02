#include "bench/paper/memory_in_use.hpp"

#include <dlfcn.h>
#include <malloc.h>

#include <cstddef>

namespace broadside::bench::paper {
namespace {

// The functions of the driver's library that are needed here. The library is opened at run time, because a program
// built without CUDA, or a machine without a driver, has none to link to.
struct Driver {
  using Init = int (*)(unsigned);
  using Retain = int (*)(void**, int);
  using SetCurrent = int (*)(void*);
  using MemGetInfo = int (*)(std::size_t*, std::size_t*);

  MemGetInfo memory = nullptr;

  Driver() {
    void* const library = dlopen("libcuda.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return;
    const auto init = reinterpret_cast<Init>(dlsym(library, "cuInit"));
    const auto retain = reinterpret_cast<Retain>(dlsym(library, "cuDevicePrimaryCtxRetain"));
    const auto set_current = reinterpret_cast<SetCurrent>(dlsym(library, "cuCtxSetCurrent"));
    const auto get = reinterpret_cast<MemGetInfo>(dlsym(library, "cuMemGetInfo_v2"));
    void* context = nullptr;
    constexpr int kSuccess = 0;
    // The CUDA runtime works in the first device's primary context too.
    if (init == nullptr || retain == nullptr || set_current == nullptr || get == nullptr || init(0) != kSuccess ||
        retain(&context, 0) != kSuccess || set_current(context) != kSuccess)
      return;
    memory = get;
  }
};

}  // namespace

std::uint64_t heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

std::optional<std::uint64_t> device_bytes() {
  static const Driver kDriver;
  std::size_t free = 0;
  std::size_t total = 0;
  if (kDriver.memory == nullptr || kDriver.memory(&free, &total) != 0) return std::nullopt;
  return total - free;
}

}  // namespace broadside::bench::paper
