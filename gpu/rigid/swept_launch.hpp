// The launches that stop fast bodies short, after the substeps. long_contact_kernel.cu implements them on CUDA,
// on_host/rigid_on_host.cpp with fibers.
#pragma once

#include "core/result.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/rigid/swept_view.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

core::Result<LaunchShape> swept_launch_shape();

// Computes how far each body went, and a box around its way. Asynchronous.
core::Status launch_ways(const SweptView& view, StreamHandle stream);
// Stops bodies, given the pairs whose boxes overlap. Asynchronous.
core::Status launch_stop_short(const SweptView& view, const LaunchShape& shape, StreamHandle stream);

}  // namespace broadside::gpu
