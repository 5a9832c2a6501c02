// The explanation of each law: a sentence, a small picture, and in how many traces it applied.
#include <algorithm>

#include "reports/element.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/html_sections.hpp"
#include "reports/law_pictures.hpp"

namespace broadside::reports {
namespace {

struct KnownLaw {
  const core::Verdict* said = nullptr;  // the verdict that explains the law most fully
  std::uint64_t applied = 0;            // traces
  std::uint64_t asked = 0;
};

std::vector<KnownLaw> laws_of(const std::vector<SceneView>& scenes) {
  std::vector<KnownLaw> laws;
  for (const SceneView& scene : scenes)
    for (const TraceView& trace : scene.traces)
      for (const auto& said : trace.verdicts) {
        if (said.empty()) continue;
        const core::Verdict& verdict = *said.front();
        auto found = std::find_if(laws.begin(), laws.end(),
                                  [&](const KnownLaw& l) { return l.said->validator == verdict.validator; });
        if (found == laws.end()) found = laws.insert(laws.end(), {&verdict});
        ++found->asked;
        if (verdict.outcome != core::Outcome::kNotApplicable) ++found->applied;
        if (verdict.parts.size() > found->said->parts.size()) found->said = &verdict;
      }
  return laws;
}

std::string_view heading_of(core::LawKind kind) {
  switch (kind) {
    case core::LawKind::kMechanics:
      return "Laws of mechanics, for every engine";
    case core::LawKind::kMethod:
      return "Laws of the published method, for traces that declare it";
    case core::LawKind::kTrace:
      return "Laws for every trace";
  }
  return "";
}

std::string law_html(const KnownLaw& law) {
  const core::Verdict& verdict = *law.said;
  std::string parts;
  for (const core::Verdict& part : verdict.parts)
    parts += element("li", element("b", html(part.validator)), " ", html(part.law));
  return element("li", law_picture(verdict.validator),
                 element("div", element("b", html(verdict.validator)),
                         verdict.ties_motion_to_forces ? " " + element("span.proves", "proves motion") : "",
                         element("p", html(verdict.law)), parts.empty() ? "" : element("ul", parts),
                         element("small", "applied to ", counted(law.applied), " of ", counted(law.asked, "trace"))));
}

}  // namespace

std::string laws_section(PageParts& page) {
  const std::vector<KnownLaw> laws = laws_of(page.scenes);
  // Rows of earlier builds contain no explanations of laws.
  const auto is_said = [](const KnownLaw& l) { return !l.said->law.empty(); };
  if (std::none_of(laws.begin(), laws.end(), is_said)) return "";
  std::string kinds;
  for (const core::LawKind kind : core::kLawKinds) {
    std::string items;
    for (const KnownLaw& law : laws)
      if (is_said(law) && law.said->kind == kind) items += law_html(law);
    if (!items.empty()) kinds += element("h3", heading_of(kind)) + element("ul.laws", items);
  }
  return element("section", {{"id", "laws"}}, element("h2", "The laws"),
                 element("p.hint",
                         "A time of an engine that moves bodies counts only where a law that proves motion passed on a "
                         "body that moved."),
                 kinds);
}

}  // namespace broadside::reports
