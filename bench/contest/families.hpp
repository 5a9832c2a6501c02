// Scenes of one kind of motion: "rigid:slide:heading-3" is of the family "slide".
#pragma once

#include <string>
#include <vector>

#include "bench/contest/contest_table.hpp"

namespace broadside::bench::contest {

struct Family {
  std::string name;
  std::vector<const SceneTable*> scenes;
};

// In the order of their first scenes.
std::vector<Family> families_of(const ContestTable& table);

// "slide:heading-3", "freefall:cube:100": without what all names begin with, and without parameters.
std::string short_name(const std::string& scene);

// Of the fold that shows a family, and of the line that shows what an engine broke on a scene.
std::string family_anchor(const Family& family);
std::string broken_anchor(const std::string& scene, const std::string& engine);

// "closed-form: 0.18 m, limit 0.02 m".
std::string measured_text(const core::Verdict& verdict);
// How many times its limit a law measured; infinite where the limit is zero or something is no number.
double share_of_limit(const core::Verdict& verdict);
// The broken law that is furthest beyond its limit; null where none is broken.
const core::Verdict* worst_of(const Entry& entry);

}  // namespace broadside::bench::contest
