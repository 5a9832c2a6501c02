// Why laws are broken: a line for each cause, and below it the engines and scenes that it affects.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string_view>

#include "bench/contest/contest_document.hpp"
#include "bench/contest/families.hpp"
#include "bench/contest/known_causes.hpp"

namespace broadside::bench::contest {
namespace {

constexpr std::string_view kNotYet = "not yet looked into";

// The broken laws of one cause; those without a known cause are kept by engine.
struct Strike {
  std::string cause;
  std::set<std::string> entrants;
  std::set<std::string> laws;
  std::vector<std::string> families;
  std::set<std::string> scenes;
  std::size_t count = 0;
};

std::string id_of(const Entrant& e) {
  return e.engine.substr(0, e.engine.find('['));
}

std::vector<Strike> strikes_of(const ContestTable& table) {
  std::vector<Strike> strikes;
  std::map<std::pair<std::string, std::string>, std::size_t> places;
  for (const Family& family : families_of(table))
    for (const SceneTable* scene : family.scenes)
      for (const Entrant& e : table.entrants) {
        const Entry* entry = own_entry(*scene, e.engine);
        if (entry == nullptr) continue;
        for (const core::Verdict& v : entry->broken) {
          const std::string cause(known_cause(e.engine, v.validator, scene->scene));
          const auto [at, is_new] = places.emplace(std::pair(cause, cause.empty() ? id_of(e) : ""), strikes.size());
          if (is_new) strikes.push_back({cause, {}, {}, {}, {}, 0});
          Strike& strike = strikes[at->second];
          strike.entrants.insert(e.engine);
          strike.laws.insert(v.validator);
          if (strike.families.empty() || strike.families.back() != family.name) strike.families.push_back(family.name);
          strike.scenes.insert(scene->scene);
          ++strike.count;
        }
      }
  // Broken laws without a known cause come first, then causes by how many laws they break.
  std::stable_sort(strikes.begin(), strikes.end(), [](const Strike& a, const Strike& b) {
    if (a.cause.empty() != b.cause.empty()) return a.cause.empty();
    return a.count > b.count;
  });
  return strikes;
}

// "tip, arch (4 scenes)"; a scene's own name where it is one.
std::string scenes_text(const Strike& strike) {
  if (strike.scenes.size() == 1) return short_name(*strike.scenes.begin());
  return fmt::format("{} ({} scenes)", fmt::join(strike.families, ", "), strike.scenes.size());
}

// The engines of which every entrant is affected, and the affected entrants of other engines.
std::string entrants_text(const Strike& strike, const ContestTable& table) {
  std::map<std::string, std::vector<std::string>> all;
  for (const Entrant& e : table.entrants) all[id_of(e)].push_back(e.engine);
  std::vector<std::string> names;
  for (const auto& [id, entrants] : all) {
    std::vector<std::string> struck;
    std::copy_if(entrants.begin(), entrants.end(), std::back_inserter(struck),
                 [&](const std::string& e) { return strike.entrants.count(e) > 0; });
    if (struck.size() == entrants.size())
      names.push_back(id);
    else
      names.insert(names.end(), struck.begin(), struck.end());
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void add_causes(Document& document, const ContestTable& table) {
  const std::vector<Strike> strikes = strikes_of(table);
  if (strikes.empty()) return;
  Table causes{
      "causes", "Causes of broken laws, at the scenes' own steps", {"cause", "engine", "laws", "scenes", "broken"}, {}};
  std::size_t known = 0;
  std::size_t open = 0;
  for (const Strike& strike : strikes) {
    (strike.cause.empty() ? open : known) += strike.count;
    std::vector<TableCell> line{{strike.cause.empty() ? std::string(kNotYet) : strike.cause},
                                {entrants_text(strike, table)},
                                {fmt::format("{}", fmt::join(strike.laws, ", "))},
                                {scenes_text(strike)},
                                {std::to_string(strike.count)}};
    for (std::size_t c = 1; c < 4; ++c) line[c].is_words = true;
    if (strike.cause.empty()) line.back().tone = Tone::kBad;
    causes.rows.push_back(std::move(line));
  }
  document.blocks.emplace_back(Heading{"Why laws are broken", "broken"});
  document.blocks.emplace_back(Paragraph{fmt::format(
      "A broken law comes from a defect of the engine, a method that it declares, a wrong setting of ours, or an "
      "error of the law. Of the broken laws {} were looked into: the table names the causes, and reference/README.md "
      "says more. The other {} are not yet looked into.",
      known, open)});
  document.blocks.emplace_back(std::move(causes));
}

}  // namespace broadside::bench::contest
