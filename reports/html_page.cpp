// The HTML report from top to bottom.
#include "reports/equivalence.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/html_sections.hpp"
#include "reports/page_assets.hpp"
#include "reports/plots/plot_style.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

std::string tally_item(std::uint64_t count, std::string_view word, std::string_view style) {
  return "<li class=\"" + std::string(count == 0 ? "zero" : style) + "\"><b>" + counted(count) + "</b> " +
         std::string(word) + "</li>";
}

std::string tally_list(const Tally& t) {
  return "<ul class=\"tally\" aria-label=\"counts\">" + tally_item(t.passed, "passed", "pass") +
         tally_item(t.failed, "failed", "fail") + tally_item(t.inconclusive, "inconclusive", "open") +
         tally_item(t.not_applicable, "not applicable", "none") + tally_item(t.recorded, "recorded", "none") +
         tally_item(t.absent, "not measured", "none") + tally_item(t.admitted, "times admitted", "none") +
         tally_item(t.struck_out, "times struck out", "none") + "</ul>";
}

std::string scene_head(const SceneView& scene) {
  std::string out = "<h2>" + html(scene.name) + "</h2>";
  const std::string text = stand_in(scene);
  if (!text.empty()) out += "<p class=\"stand-in\"><strong>Stand-in mesh.</strong> " + html(text) + "</p>";
  return out;
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
  std::string out =
      "\n<article id=\"scene-" + std::to_string(&scene - page.scenes.data()) + "\">" + scene_head(scene) + "\n";
  for (const ScenePart part : kSceneParts) out += part(scene, page) + "\n";
  return out + "</article>\n";
}

// Links to the parts, for pages longer than a screen.
std::string contents(const PageParts& page, const std::string& body) {
  std::string items;
  const auto add = [&](const std::string& id, const std::string& text) {
    if (body.find("id=\"" + id + "\"") != std::string::npos)
      items += "<li><a href=\"#" + id + "\">" + html(text) + "</a></li>";
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
  return "<nav aria-label=\"Contents\"><ul>" + items + "</ul></nav>";
}

// Data for the script; a block that would be empty is left out.
std::string data_block(std::string_view id, const std::string& json) {
  return "<script type=\"application/json\" id=\"" + std::string(id) + "\">" + json + "</script>\n";
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
    out += "<section id=\"" + part.id + "\"><h2>" + html(part.title) + "</h2>" + part.body + "</section>\n";
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

  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      // Forbids the page to fetch anything, even if a link were to slip through.
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
      html(options.title.empty() ? kDefaultTitle : options.title) + "</title>\n<style>\n" + std::string(kPageStyle) +
      plots::plot_style() + guest_style(options) + "</style>\n</head>\n<body>\n";
  out += "<header><p class=\"brand\"><b>Broadside</b> <span>" +
         html(options.title.empty() ? kDefaultTitle : options.title) + "</span>";
  if (!options.generated_at.empty()) out += " <time>" + html(options.generated_at) + "</time>";
  out += "</p>\n<h1 class=\"" + std::string(outcome_class(state)) + "\"><span class=\"seal\" aria-hidden=\"true\">" +
         std::string(symbol(state)) + "</span><span>" + html(sentence) + "</span></h1>\n" + tally_list(counts) + "\n";
  PageParts page{rows, options, scenes};
  std::string body;
  for (const RunPart part : kPartsBeforeScenes) body += part(page);
  for (const SceneView& scene : scenes) body += scene_article(scene, page);
  for (const RunPart part : kPartsAfterScenes) body += part(page) + "\n";
  out += contents(page, body) + "</header>\n<main>\n" + body;
  if (!has_page_bundle())
    out +=
        "<p class=\"hint\">This page was built without charts and the 3-D view, because npm was missing; its tables "
        "hold the "
        "same figures.</p>";
  out += "\n</main>\n";
  if (has_page_bundle() && !page.charts.charts().empty()) out += data_block("charts", page.charts.json());
  if (has_page_bundle() && !options.playbacks.empty())
    out += data_block("playbacks", playbacks_json(options.playbacks));
  out += "<script>\n" + std::string(kPageScript) + "</script>\n</body>\n</html>\n";
  return out;
}

}  // namespace broadside::reports
