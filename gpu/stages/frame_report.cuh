// What a frame reports to the host at its end.
#pragma once

#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

// Called by one thread. If the frame was aborted, the counters say how much room it needed.
__device__ inline void tell_host(const FrameView& f, Counters counters, bool is_aborted) {
  counters.is_aborted = is_aborted ? 1 : 0;
  *f.counters = counters;
  f.outcome->counters = counters;
}

// Whether all contacts with faces were stored. Known only after the last stage.
__device__ inline bool has_room_for_faces(const FrameView& f, const Counters& counters) {
  return counters.faces <= f.face_contacts.capacity;
}

}  // namespace broadside::gpu
