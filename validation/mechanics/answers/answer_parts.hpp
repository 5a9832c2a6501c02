// What the formulas of scenes share: time, planes, and how far an engine of a declared order may be off.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "validation/mechanics/scene_answer.hpp"

namespace broadside::validation {

using Figures = std::vector<ExactFigure>;

// The groups of formulas, one file each.
std::span<const SceneAnswer> free_answers();
std::span<const SceneAnswer> slope_answers();
std::span<const SceneAnswer> ball_answers();
std::span<const SceneAnswer> impact_answers();
std::span<const SceneAnswer> static_answers();

inline double time_of(const Motion& m) {
  return static_cast<double>(m.step) * m.h;
}

// Error over a time t of a method of order p on a solution whose derivative of order p + 1 is at most this: each step
// is off by h^(p + 1) / (p + 1)! of it, and steps add up.
inline double truncation(double derivative, double h, double order, double t) {
  return derivative * t * std::pow(h, order) / std::tgamma(order + 2.0);
}

// When in a step a contact begins, ends or turns from sliding to rolling is not known: its acceleration acts for up to
// a step more or less, whatever the order, and the difference in speed remains.
inline double one_step_late(double acceleration, const Motion& m) {
  return acceleration * m.h * time_of(m);
}

// Rounding of a state that n operations a substep have summed: each declared substep adds to the state and rounds it.
inline double rounding_over(const Motion& m, double operations, double magnitude) {
  return m.rounding_of(operations * m.substeps * static_cast<double>(m.step)) * magnitude;
}

// What body 0 lies on: the first static body, whose y axis is its normal, or the floor.
struct Plane {
  Vec3d normal{0.0, 1.0, 0.0};
  double friction = 0.0;
  double restitution = 0.0;
};
Plane plane_of(const core::Scene& scene, const Motion& m);

inline Vec3d start_position(const core::Scene& scene) {
  return Vec3d(scene.bodies[0].position);
}
inline Vec3d start_velocity(const core::Scene& scene) {
  return Vec3d(scene.bodies[0].velocity);
}
inline Vec3d unit(Vec3d v) {
  return (1.0 / length(v)) * v;
}
// v without its part along the unit vector n.
inline Vec3d across(Vec3d v, Vec3d n) {
  return v - dot(v, n) * n;
}

// Where no order of convergence is defined, an error is a class: A up to 1 %, B up to 5 %, C up to 20 % of the scale.
inline ExactFigure classed(std::string_view what, std::string_view unit, double error, double scale) {
  return {.what = what, .unit = unit, .error = error, .limit = kClassC * scale, .has_order = false, .scale = scale};
}

// A figure of free motion: the method's truncation beside a floor of rounding.
inline ExactFigure smooth(std::string_view what, std::string_view unit, double error, double truncated, double floor) {
  return {.what = what, .unit = unit, .error = error, .limit = truncated + floor, .floor = floor};
}

// A figure of a contact that begins or changes at an unknown moment of a step.
inline ExactFigure touching(std::string_view what, std::string_view unit, double error, double late, double floor) {
  return {.what = what, .unit = unit, .error = error, .limit = late + floor, .floor = floor, .is_first_order = true};
}

}  // namespace broadside::validation
