// The HTML report from top to bottom.
#include "reports/element.hpp"
#include "reports/equivalence.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/html_sections.hpp"
#include "reports/page_assets.hpp"
#include "reports/plots/plot_style.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

// The policy forbids the page to fetch anything, even if a link got into it by mistake.
constexpr std::string_view kHeadStart = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; )"
                                        R"(script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
)";

std::string tally_item(std::uint64_t count, std::string_view word, std::string_view style) {
  return element("li." + std::string(count == 0 ? "zero" : style), element("b", counted(count)), " ", word);
}

std::string tally_list(const Tally& t) {
  return element("ul.tally", {{"aria-label", "counts"}}, tally_item(t.passed, "passed", "pass"),
                 tally_item(t.failed, "failed", "fail"), tally_item(t.inconclusive, "inconclusive", "open"),
                 tally_item(t.not_applicable, "not applicable", "none"), tally_item(t.recorded, "recorded", "none"),
                 tally_item(t.absent, "not measured", "none"), tally_item(t.admitted, "times admitted", "none"),
                 tally_item(t.struck_out, "times struck out", "none"));
}

std::string scene_head(const SceneView& scene) {
  const std::string text = stand_in(scene);
  return element("h2", html(scene.name)) +
         (text.empty() ? "" : element("p.stand-in", element("strong", "Stand-in mesh."), " ", html(text)));
}

std::string equivalence_part(const SceneView& scene, PageParts&) {
  return equivalence_section(scene);
}

constexpr ScenePart kSceneParts[] = {matrix_section,      coverage_section, times_section,        side_by_side_section,
                                     over_frames_section, counts_section,   frame_series_section, agreement_section,
                                     cells_section,       equivalence_part, facts_section};
constexpr RunPart kPartsBeforeScenes[] = {findings_section, view_section};
constexpr RunPart kPartsAfterScenes[] = {energy_section, scaling_section, guest_sections, history_section,
                                         repeat_section, laws_section,    legend_section};

std::string scene_article(const SceneView& scene, PageParts& page) {
  std::string parts = scene_head(scene) + "\n";
  for (const ScenePart part : kSceneParts) parts += part(scene, page) + "\n";
  return "\n" + element("article", {{"id", "scene-" + std::to_string(&scene - page.scenes.data())}}, parts) + "\n";
}

// Links to the parts, for pages longer than a screen.
std::string contents(const PageParts& page, const std::string& body) {
  std::string items;
  const auto add = [&](const std::string& id, const std::string& text) {
    if (body.find("id=\"" + id + "\"") != std::string::npos)
      items += element("li", element("a", {{"href", "#" + id}}, html(text)));
  };
  add("findings", "What did not pass");
  add("view-section", "Frame by frame");
  for (std::size_t k = 0; k < page.scenes.size(); ++k) add("scene-" + std::to_string(k), page.scenes[k].name);
  add("energy", "Energy");
  add("scaling", "Cost against bodies");
  for (const GuestPart& part : page.options.guests) add(part.id, part.title);
  add("history", "Earlier runs");
  add("repeat", "How to repeat");
  add("laws", "The laws");
  add("legend", "How to read this page");
  return element("nav", {{"aria-label", "Contents"}}, element("ul", items));
}

// Data for the script; a block that would be empty is left out.
std::string data_block(std::string_view id, const std::string& json) {
  return element("script", {{"type", "application/json"}, {"id", std::string(id)}}, json) + "\n";
}

std::string guest_style(const ReportOptions& options) {
  std::string style;
  for (const GuestPart& part : options.guests) style += part.style;
  return style;
}

}  // namespace

std::string guest_sections(PageParts& page) {
  std::string out;
  for (const GuestPart& part : page.options.guests)
    out += element("section", {{"id", part.id}}, element("h2", html(part.title)), part.body) + "\n";
  return out;
}

bool has_html_page() {
  return true;
}

bool has_page_bundle() {
  return kPageHasBundle;
}

std::vector<Chart> page_charts(const core::RunRows& rows, const ReportOptions& options) {
  const std::vector<SceneView> scenes = by_scene(rows);
  PageParts page{rows, options, scenes};
  for (const SceneView& scene : scenes)
    for (const ScenePart part : kSceneParts) part(scene, page);
  for (const RunPart part : kPartsAfterScenes) part(page);
  return page.charts.charts();
}

std::string html_page(const core::RunRows& rows, const ReportOptions& options) {
  const std::vector<SceneView> scenes = by_scene(rows);
  const Tally counts = tally(scenes);
  const core::Outcome state = overall(counts);
  const std::string sentence = headline(scenes);

  const std::string title = html(options.title.empty() ? kDefaultTitle : options.title);

  PageParts page{rows, options, scenes};
  std::string body;
  for (const RunPart part : kPartsBeforeScenes) body += part(page);
  for (const SceneView& scene : scenes) body += scene_article(scene, page);
  for (const RunPart part : kPartsAfterScenes) body += part(page) + "\n";

  const std::string brand =
      element("p.brand", element("b", "Broadside"), " ", element("span", title),
              options.generated_at.empty() ? "" : " " + element("time", html(options.generated_at)));
  const std::string verdict =
      element("h1." + std::string(outcome_class(state)), element("span.seal", {{"aria-hidden", "true"}}, symbol(state)),
              element("span", html(sentence)));
  const std::string without_charts =
      has_page_bundle() ? ""
                        : element("p.hint",
                                  "This page was built without charts and the 3-D view, because npm was missing; its "
                                  "tables hold the same figures.");
  std::string out = std::string(kHeadStart) + element("title", title) + "\n<style>\n" + std::string(kPageStyle) +
                    plots::plot_style() + guest_style(options) + "</style>\n</head>\n<body>\n";
  const std::string note = options.note.empty() ? "" : element("p.hint", html(options.note)) + "\n";
  out += element("header", brand, "\n", verdict, "\n", note, tally_list(counts), "\n", contents(page, body)) + "\n";
  out += element("main", "\n", body, without_charts, "\n") + "\n";
  if (has_page_bundle() && !page.charts.charts().empty()) out += data_block("charts", page.charts.json());
  if (has_page_bundle() && !options.playbacks.empty())
    out += data_block("playbacks", playbacks_json(options.playbacks));
  return out + "<script>\n" + std::string(kPageScript) + "</script>\n</body>\n</html>\n";
}

}  // namespace broadside::reports
