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

}  // namespace

std::string html_page(const core::RunRows& rows, const ReportOptions& options) {
  const std::vector<SceneView> scenes = by_scene(rows);
  const Tally counts = tally(scenes);
  const core::Outcome state = overall(counts);
  const std::string sentence = headline(scenes);

  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      // Nothing is fetched, whatever slips through.
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
      html(options.title.empty() ? kDefaultTitle : options.title) + "</title>\n<style>\n" + std::string(kPageStyle) +
      (options.energy.empty() ? std::string() : plots::plot_style()) + "</style>\n</head>\n<body>\n";
  out += "<header><p class=\"brand\"><b>Broadside</b> <span>" +
         html(options.title.empty() ? kDefaultTitle : options.title) + "</span>";
  if (!options.generated_at.empty()) out += " <time>" + html(options.generated_at) + "</time>";
  out += "</p>\n<h1 class=\"" + std::string(outcome_class(state)) + "\"><span class=\"seal\" aria-hidden=\"true\">" +
         std::string(symbol(state)) + "</span><span>" + html(sentence) + "</span></h1>\n" + tally_list(counts) +
         "</header>\n<main>\n";
  out += findings_section(scenes);
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    out += "\n<article>" + scene_head(scenes[k]) + "\n" + matrix_section(scenes[k], k) + "\n" +
           times_section(scenes[k]) + "\n" + cells_section(scenes[k]) + "\n" + equivalence_section(scenes[k]) + "\n" +
           facts_section(scenes[k]) + "</article>\n";
  }
  out += energy_section(options.energy);
  out += repeat_section(scenes, options) + "\n" + legend_section();
  out += "\n</main>\n<script>\n" + std::string(kPageScript) + "</script>\n</body>\n</html>\n";
  return out;
}

}  // namespace broadside::reports
