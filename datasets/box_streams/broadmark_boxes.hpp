// The scenes of the broad-phase benchmark Broadmark (Serpa and Rodrigues 2019) as streams of boxes.
#pragma once

#include <cstdint>

#include "datasets/box_streams/box_stream.hpp"

namespace broadside::datasets {

enum class BroadmarkScene { kBrownian, kFreefall, kTurningGravity };
enum class BroadmarkObjects { kCubes, kSpheres, kAssorted };

// As in Broadmark: 0.1 objects per unit of volume, so a cube of side L = (n / 0.1)^(1/3); centers start uniform in a
// ball of radius 0.45 L at its middle, velocities uniform in a ball of 0.75 L per second; frames of 1/30 s.
//   brownian: no gravity; each frame the next 1 % of the objects get a new velocity from that ball.
//   freefall: gravity of 9.81 a second squared down the y axis.
//   gravity:  four times as strong, its direction turned by 360 / 30 / 6.2 degrees a frame about an axis that turns
//             about z by as much.
// Cubes have side 1, spheres diameter 1, assorted sides uniform from 0.1 to 1.9.
//
// How this differs from Broadmark: Broadmark records a physics engine. Here only the walls stop an object, so that the
// boxes are the same everywhere without an engine. Therefore
//   - objects pass through each other, and reverse at the walls without loss; a velocity's components are limited to
//     0.75 L, which the rotating gravity would exceed;
//   - in freefall an object comes to rest at the height to which the unit square of ground below its center has been
//     filled, so that a pile grows instead of one sheet;
//   - cubes tumble from the start, each about its own axis at up to 1 radian per second, where in Broadmark contacts
//     would make them turn (so their boxes are 1 to 1.73 wide); cubes at rest do not tumble;
//   - there are 300 frames, 10 s: in freefall all objects lie still in the last part.
BoxStream broadmark_boxes(BroadmarkScene scene, BroadmarkObjects objects, std::uint32_t n, std::uint64_t seed);

}  // namespace broadside::datasets
