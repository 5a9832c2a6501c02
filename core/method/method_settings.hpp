// Settings of the method. Engines on the CPU and on the GPU offer the same rows, so that one value means one thing.
#pragma once

#include "core/engine/settings.hpp"

namespace broadside::core {

inline SettingRow levels_setting() {
  return {"levels", "C", {"flat", "level1", "A", "B", "C"}, "body-octree levels tested, as in P-Tables 5 and 6"};
}

inline SettingRow solver_setting() {
  return {"solver", "colored", {"colored", "jacobi", "printed-E8"}, "order in which contacts are resolved"};
}

inline SettingRow variant_setting() {
  return {"variant",
          "sound",
          {"sound", "printed-E1", "printed-E2", "printed-E3", "printed-E4", "printed-E5", "printed-E6", "printed-E7",
           "printed-E8"},
          "a printed, wrong form of the paper to run instead"};
}

inline SettingRow vertex_stage_setting() {
  return {"vertex_stage", "on", {"on", "off"}, "off: bodies touch if boxes of their last level overlap"};
}

inline SettingRow cell_setting() {
  return {"cell_mm", "0", {}, "edge of a cell in mm; 0 = the scene's hash_cell_m, and 250 for boxes alone"};
}

inline SettingRow contact_setting() {
  return {"contact",
          "conjugate",
          {"conjugate", "soft-step", "stiff"},
          "bodies that turn: how contacts of a step are solved together; soft-step = one sweep a substep, stiff = "
          "for structures that barely stand, at many times the cost"};
}

inline SettingRow substeps_setting() {
  return {"substeps", "0", {}, "bodies that turn: substeps of a step; 0 = the solver's own choice"};
}

inline SettingRow thresholds_setting() {
  return {"thresholds",
          "scaled",
          {"scaled", "fixed"},
          "bodies that turn: slop and bounce speed by size, gravity and step, or fixed = the scene's delta_m and "
          "v_threshold_m_s"};
}

inline SettingRow sleep_setting() {
  return {"sleep",
          "off",
          {"off", "on"},
          "bodies that turn: on = groups of touching bodies at rest are not solved until an awake body touches them"};
}

inline SettingRow sweep_setting() {
  return {"sweep",
          "flagged",
          {"flagged", "fast", "off"},
          "bodies that turn: a body that moves farther in a step than it is thick stops before it passes through "
          "others: flagged = bodies that the scene marks as fast, fast = all, off = none"};
}

}  // namespace broadside::core
