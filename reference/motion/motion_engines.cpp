#include "reference/motion/motion_engines.hpp"

#include <array>

namespace broadside::reference {

std::span<const core::MotionEngineRow> motion_engine_rows() {
  static const std::array kEngines{
#define MOTION_ENGINE_ROW(function) function(),
#include "reference/motion/motion_engines.inc"
#undef MOTION_ENGINE_ROW
  };
  return kEngines;
}

}  // namespace broadside::reference
