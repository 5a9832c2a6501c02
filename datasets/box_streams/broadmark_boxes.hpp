// The scenes of the broad-phase benchmark Broadmark (Serpa and Rodrigues 2019) as streams of boxes.
#pragma once

#include <cstdint>

#include "datasets/box_streams/box_stream.hpp"

namespace broadside::datasets {

enum class BroadmarkScene { kBrownian, kFreefall, kTurningGravity };
enum class BroadmarkObjects { kCubes, kSpheres, kAssorted };

// After Broadmark: 0.1 objects a unit of volume, so a cube of side L = (n / 0.1)^(1/3); centers start uniform in a ball
// of radius 0.45 L at its middle, velocities uniform in a ball of 0.75 L per second; frames of 1/30 s.
//   brownian: no gravity; each frame the next 1 % of the objects get a new velocity from that ball.
//   freefall: gravity of 9.81 a second squared down the y axis.
//   gravity:  four times as strong, its direction turned by 360 / 30 / 6.2 degrees a frame about an axis that turns
//             about z by as much.
// Cubes have side 1, spheres diameter 1, assorted sides uniform from 0.1 to 1.9.
//
// Where this leaves Broadmark: it records a physics engine, and here nothing but the walls stops an object, so that the
// boxes are the same everywhere without an engine. Hence
//   - objects pass through each other, and turn round at the walls without loss; a velocity's components are held to
//     0.75 L, which the rotating gravity would exceed;
//   - in freefall an object comes to rest where its center's unit square of ground has been filled up to, so that a
//     pile grows instead of one sheet;
//   - cubes tumble from the start, each about an axis of its own at up to 1 radian per second, where contacts would
//     turn them (so their boxes are 1 to 1.73 wide); those at rest do not;
//   - there are 300 frames, 10 s: in freefall all lie still for the last part.
BoxStream broadmark_boxes(BroadmarkScene scene, BroadmarkObjects objects, std::uint32_t n, std::uint64_t seed);

}  // namespace broadside::datasets
