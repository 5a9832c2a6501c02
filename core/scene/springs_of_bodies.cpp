#include "core/scene/springs_of_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/method/integrate.hpp"

namespace broadside::core {

SpringsOfBodies springs_of_bodies(const Scene& scene) {
  SpringsOfBodies sorted;
  if (scene.springs.empty()) return sorted;
  sorted.springs = scene.springs;
  std::stable_sort(sorted.springs.begin(), sorted.springs.end(),
                   [](const Spring& p, const Spring& q) { return p.body < q.body; });
  sorted.begin.assign(scene.bodies.size() + 1, 0);
  for (const Spring& s : sorted.springs) ++sorted.begin[s.body + 1];
  for (std::size_t i = 1; i < sorted.begin.size(); ++i) sorted.begin[i] += sorted.begin[i - 1];
  return sorted;
}

Status check_spring_step(const Scene& scene, Variant variant) {
  const SpringsOfBodies sorted = springs_of_bodies(scene);
  if (sorted.springs.empty()) return Done{};
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    double stiffness = 0.0;
    double damping = 0.0;
    for (std::uint32_t k = sorted.begin[i]; k < sorted.begin[i + 1]; ++k)
      stiffness += sorted.springs[k].stiffness_n_m, damping += sorted.springs[k].damping_n_s_m;
    const double w = scene.bodies[i].inverse_mass;
    const double w0 = std::sqrt(stiffness * w);
    const double g = damping * w;
    if (w0 == 0.0 && g == 0.0) continue;
    const double limit_s = variant == Variant::kE1 ? step_limit_printed(w0, g) : step_limit_sound(w0, g);
    if (scene.dt_s < limit_s) continue;
    return Error{"dt_s is " + std::to_string(scene.dt_s) + ", and the springs of body " + std::to_string(i) +
                     " are stable only below " + std::to_string(limit_s) + " s",
                 scene.name, "take a shorter step, softer springs or less damping"};
  }
  return Done{};
}

}  // namespace broadside::core
