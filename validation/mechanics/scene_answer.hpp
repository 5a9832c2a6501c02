// Exact answers of scenes that have one, by the name that a scene carries (core::Scene::answer): RIGID 6.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "validation/mechanics/motion.hpp"

namespace broadside::validation {

inline constexpr std::string_view kStands = "stands";

// One figure at one time: what the exact solution says, and how far an engine of order 1 may be from it.
struct ExactFigure {
  std::string_view what;  // static storage
  std::string_view unit;
  double error = 0.0;  // distance of the recorded state from the exact one
  double limit = 0.0;  // C h^p, p the declared order
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
