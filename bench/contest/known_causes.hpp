// Known causes of laws that other people's engines break on scenes with known answers; reference/README.md has each
// with what was seen. A broken law without a row here was not yet looked into, and the page says so.
#pragma once

#include <string_view>

namespace broadside::bench::contest {

// Empty where it was not yet looked into. engine: a label, "ode-world[solver=dantzig]". scene: a name, with "@1/60"
// after it where the step is not the scene's own; a cause that is known at the scene's own step is used there too.
std::string_view known_cause(std::string_view engine, std::string_view law, std::string_view scene);

// The same for laws that hold at the scene's own step. Empty where the name has no step, or the cause is one of every
// step.
std::string_view known_cause_at_step(std::string_view engine, std::string_view law, std::string_view scene);

}  // namespace broadside::bench::contest
