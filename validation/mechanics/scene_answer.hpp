// Exact answers of scenes that have one, by the name that a scene carries (core::Scene::answer): RIGID 6. They are in
// validation/mechanics/answers/, one file a group.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "validation/mechanics/motion.hpp"

namespace broadside::validation {

inline constexpr std::string_view kStands = "stands";      // rest judges it
inline constexpr std::string_view kReported = "reported";  // no agreed answer

// Shares of a figure's scale: classes of figures without an order.
inline constexpr double kClassA = 0.01;
inline constexpr double kClassB = 0.05;
inline constexpr double kClassC = 0.2;

// One figure at one time: what the exact solution says, and how far an engine of the declared order may be from it.
struct ExactFigure {
  std::string_view what;  // static storage
  std::string_view unit;
  double error = 0.0;     // distance of the recorded state from the exact one
  double limit = 0.0;     // C h^p, or class C of the scale
  double floor = 0.0;     // the part of the limit that does not fall with h: rounding, and what settles
  bool has_order = true;  // whether the error falls with a power of h
  // Where contacts begin or end within a step, no method is of more than the first order.
  bool is_first_order = false;
  double scale = 0.0;  // of the classes, where there is no order
};

struct SceneAnswer {
  std::string_view name;    // in scenes
  std::string_view what;    // the formula, one line
  std::string_view source;  // where it comes from
  // The figures at the end of a step. order: declared. Empty where the formula says nothing at this time.
  std::function<std::vector<ExactFigure>(const core::Scene& scene, const Motion& motion, double order)> figures;
};

std::span<const SceneAnswer> scene_answers();
const SceneAnswer* find_answer(std::string_view name);

}  // namespace broadside::validation
