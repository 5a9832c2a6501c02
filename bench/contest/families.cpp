#include "bench/contest/families.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/contest/contest_document.hpp"

namespace broadside::bench::contest {

std::string short_name(const std::string& scene) {
  constexpr std::string_view kFamily = "rigid:";
  const std::string name = scene.substr(0, scene.find('['));
  return name.starts_with(kFamily) ? name.substr(kFamily.size()) : name;
}

std::vector<Family> families_of(const ContestTable& table) {
  std::vector<Family> families;
  for (const SceneTable& scene : table.scenes) {
    const std::string name = short_name(scene.scene);
    const std::string family = name.substr(0, name.find(':'));
    auto of = std::find_if(families.begin(), families.end(), [&](const Family& f) { return f.name == family; });
    if (of == families.end()) of = families.insert(families.end(), {family, {}});
    of->scenes.push_back(&scene);
  }
  return families;
}

std::string family_anchor(const Family& family) {
  return file_name_of("family", family.name);
}

std::string broken_anchor(const std::string& scene, const std::string& engine) {
  return file_name_of("broken", scene + "-" + engine);
}

std::string measured_text(const core::Verdict& verdict) {
  const std::string unit = verdict.unit.empty() ? "" : " " + verdict.unit;
  return fmt::format("{}: {:.3g}{}, limit {:.3g}{}", verdict.validator, verdict.measured, unit, verdict.limit, unit);
}

double share_of_limit(const core::Verdict& verdict) {
  const double share = verdict.limit > 0.0 ? verdict.measured / verdict.limit : std::numeric_limits<double>::infinity();
  return std::isfinite(share) ? share : std::numeric_limits<double>::infinity();
}

const core::Verdict* worst_of(const Entry& entry) {
  const auto worst = std::max_element(
      entry.broken.begin(), entry.broken.end(),
      [](const core::Verdict& a, const core::Verdict& b) { return share_of_limit(a) < share_of_limit(b); });
  return worst == entry.broken.end() ? nullptr : &*worst;
}

}  // namespace broadside::bench::contest
