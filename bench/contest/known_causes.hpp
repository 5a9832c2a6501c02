// Why engines of others break laws on scenes with known answers, as far as somebody looked: reference/README.md has
// each with what was seen. What has no row here was not yet looked into, and the page says so.
#pragma once

#include <string_view>

namespace broadside::bench::contest {

// Empty where it was not yet looked into. engine: a label, "ode-world[solver=dantzig]". scene: a name, with "@1/60"
// after it where the step is not the scene's own; a cause of the scene's own step serves there too.
std::string_view known_cause(std::string_view engine, std::string_view law, std::string_view scene);

// Of laws that hold at a scene's own step: empty where the name has no step, or its cause is that of every step.
std::string_view known_cause_at_step(std::string_view engine, std::string_view law, std::string_view scene);

}  // namespace broadside::bench::contest
