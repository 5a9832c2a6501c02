// How much memory an engine holds while it runs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace broadside::bench::paper {

// Bytes of this process's heap that are allocated and not freed (glibc's mallinfo2).
std::uint64_t heap_bytes();

// Bytes of the GPU's memory in use by all programs, as its driver counts them; nothing without a driver. Makes this
// process's CUDA context if there is none, so that a later difference does not contain it.
std::optional<std::uint64_t> device_bytes();

}  // namespace broadside::bench::paper
