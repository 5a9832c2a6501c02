// The launches that find the contacts of turning bodies: contact_kernel.cu, near_contact_kernel.cu and
// long_contact_kernel.cu implement them on CUDA, on_host/rigid_on_host.cpp with fibers.
#pragma once

#include "core/result.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/rigid/contact_view.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

core::Result<LaunchShape> contact_launch_shape();
core::Result<LaunchShape> near_contact_launch_shape();
core::Result<LaunchShape> long_contact_launch_shape();

// Body-octree levels and patches of contact, after the broad phase. Asynchronous. Does nothing if the frame has no
// pairs.
core::Status launch_contacts(const ContactView& frame, const LaunchShape& shape, StreamHandle stream);
// The same in two launches, in this order, for frames with frame.has_long_contacts or frame.follows_ways.
core::Status launch_near_contacts(const ContactView& frame, const LaunchShape& shape, StreamHandle stream);
core::Status launch_long_contacts(const ContactView& frame, const LaunchShape& shape, StreamHandle stream);

}  // namespace broadside::gpu
