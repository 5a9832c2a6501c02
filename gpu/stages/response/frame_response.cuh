// Resolves the contacts of a frame, then faces of the domain, and marks the ends of both stages: by one block in its
// shared memory, or by a team in global memory.
#pragma once

#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/body_stage.cuh"
#include "gpu/stages/grid/stage_clock.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/response/block_stage.cuh"
#include "gpu/stages/response/contact_stage.cuh"
#include "gpu/stages/response/order_stage.cuh"
#include "gpu/stages/vertices/narrow_pairs.cuh"

namespace broadside::gpu {

// Called by all threads of one block, for bodies and pairs that fit `room`. `counters`, in the block's shared memory,
// gets what these stages count; the block's first thread may read it afterwards.
__device__ inline void resolve_alone(const FrameView& f, const NarrowPairs& pairs, const BlockRoom& room,
                                     Counters& counters) {
  const BlockTeam team;
  resolve_in_block(f, pairs, room, [&] { mark_end(team, f.outcome, core::Stage::kResponse); });
  mark_end(team, f.outcome, core::Stage::kFaces);
  if (team.rank() != 0) return;
  counters.touching = room.counts->touching;
  counters.faces = room.counts->faces;
  counters.colors = room.counts->colors;
}

// Called by all threads of a team. `resolve` is called with the number of touching pairs, if there are any.
template <typename Team, typename Resolve>
__device__ void resolve_by_team(const Team& team, const FrameView& f, const NarrowPairs& pairs,
                                const Resolve& resolve) {
  collect_touching(team, f, pairs);
  team.sync();
  const std::uint64_t count = f.counters->touching;
  if (count > 0) resolve(count);
  mark_end(team, f.outcome, core::Stage::kResponse);
  resolve_faces(team, f);
  team.sync();
  mark_end(team, f.outcome, core::Stage::kFaces);
}

// Resolves `count` contacts with a thread for each body, which waits at each contact for the body's turn.
template <typename Team, typename Live>
__device__ void resolve_body_by_body(const Team& team, const FrameView& f, std::uint64_t count, const Live& live) {
  start_live(team, f, live);
  list_contacts<false>(team, f, count);
  resolve_by_looking(team, f, live);
  team.sync();
  finish_live(team, f, live);
}

}  // namespace broadside::gpu
