// One pair of bodies, still or moving, saved as a file, so that a library's answer to it can be repeated.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "bench/agree/motion/body_draw.hpp"
#include "bench/agree/pairs.hpp"
#include "core/result.hpp"

namespace broadside::bench {

// JSON: meshes with vertices (m, body coordinates) and triangles, positions, orientations w x y z. Floats are written
// with enough digits to restore their bits. The file appears whole or not at all.
core::Status write_case(const PairSource& source, const TestPair& pair, const std::filesystem::path& file);

struct Case {
  PairSource source;
  TestPair pair;
};

// Errors name the file and what is missing in it.
core::Result<Case> read_case(const std::filesystem::path& file);

// The same with the displacement (m) and the rotation (rad) of each body over the step.
core::Status write_motion_case(const BodySource& source, const MotionTest& test, const std::filesystem::path& file);

struct MotionCase {
  BodySource source;
  MotionTest test;
};
core::Result<MotionCase> read_motion_case(const std::filesystem::path& file);

}  // namespace broadside::bench
