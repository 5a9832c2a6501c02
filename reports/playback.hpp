// What the 3-D view of a report shows of one recorded run: a selection of its frames, small enough for a page.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/math/box.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/pair.hpp"
#include "core/stamp.hpp"

namespace broadside::reports {

// Coordinates relative to the body's position, in its first orientation, m.
struct PlaybackShape {
  std::vector<std::vector<core::Box>> levels;  // octree boxes of level 0, 1, 2; level 0 is one box
  std::vector<core::Vec3> vertices;            // empty when there are too many for a page: then boxes are drawn
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct PlaybackContact {
  std::uint32_t a = 0, b = 0;  // b may be a face of the domain, kFirstFace + k
  core::Vec3 point;            // m: the engine's point, or the middle of the overlap
  core::Vec3 normal;           // unit, from b to a
  float depth_m = 0.0F;
};

struct PlaybackFrame {
  std::uint64_t step = 0;
  std::vector<core::Vec3> position;  // [bodies] at detection where the trace has it, else at the end of the step, m
  std::vector<core::Quat> turn;      // [bodies] from the first orientation to this one; empty: bodies translate only
  std::vector<core::Pair> pairs;     // candidates
  std::vector<PlaybackContact> contacts;
};

// A place that a verdict names, to which the view can move.
struct PlaybackMark {
  std::string text;  // "center-of-mass: step 412, bodies 3 and 17"
  std::string validator;
  std::string baseline;
  std::int64_t step = -1;
  std::vector<std::uint32_t> bodies;
};

struct Playback {
  core::Stamp stamp;
  std::string trace_file;
  core::Box domain;
  core::Vec3 up;  // unit, against gravity
  double dt_s = 0.0;
  std::uint64_t last_step = 0;  // of the run, of whose frames these are a selection
  std::vector<std::uint32_t> shape_of_body;
  std::vector<PlaybackShape> shapes;
  std::vector<PlaybackFrame> frames;  // rising in step
  std::vector<PlaybackMark> marks;
};

// Bytes that a frame takes on the page, for callers that select frames up to a size.
std::uint64_t playback_bytes(const Playback& playback);

// For <script type="application/json">: positions, pairs and contacts as 16-bit whole numbers in base64.
std::string playbacks_json(const std::vector<Playback>& playbacks);

// One frame as an SVG picture in parallel projection, for paper and for browsers without WebGL. The bodies of the mark
// are emphasized and named. mark: index into playback.marks, or -1 for the last frame without a mark.
std::string playback_picture(const Playback& playback, int mark);

}  // namespace broadside::reports
