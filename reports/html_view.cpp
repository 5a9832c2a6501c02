// The place of the 3-D view on the page, and the links to it.
#include "reports/element.hpp"
#include "reports/escape.hpp"
#include "reports/html_sections.hpp"

namespace broadside::reports {

std::string view_section(PageParts& page) {
  const std::vector<Playback>& playbacks = page.options.playbacks;
  if (playbacks.empty()) return "";
  const Playback& first = playbacks.front();
  const std::string picture = playback_picture(first, first.marks.empty() ? -1 : 0);
  // Shown on paper and without scripts: a picture of the place that the view would show.
  std::string marks;
  for (const Playback& playback : playbacks)
    for (const PlaybackMark& mark : playback.marks)
      marks += element("li", html(playback.stamp.scene_name), " ", label_html(playback.stamp, playback.stamp.label()),
                       ": ", html(mark.text));
  return element(
      "section", {{"id", "view-section"}}, element("h2", "The scene, frame by frame"),
      element("p.hint",
              "Boxes of the octree levels in red, turned with their body; candidate pairs; contacts with their "
              "normals from B to A. Drag turns, the wheel zooms; with the picture in focus, space plays and the "
              "arrow keys step. Of a long run, the page has all frames around each place that a verdict names, and "
              "others at even intervals."),
      element("div", {{"id", "view"}}, element("div", {{"id", "view-picture"}}, picture)),
      marks.empty()
          ? ""
          : element("details.beside", element("summary", "Places that verdicts name"), element("ul.plain", marks)));
}

std::string to_view_button(const PageParts& page, const core::Stamp& stamp, const std::string& trace_file,
                           const core::Verdict& verdict) {
  for (std::size_t p = 0; p < page.options.playbacks.size(); ++p) {
    const Playback& playback = page.options.playbacks[p];
    if (playback.trace_file != trace_file || playback.stamp.scene_digest != stamp.scene_digest) continue;
    for (std::size_t m = 0; m < playback.marks.size(); ++m) {
      const PlaybackMark& mark = playback.marks[m];
      if (mark.validator != verdict.validator || mark.baseline != verdict.baseline || mark.step != verdict.worst.step ||
          mark.bodies != verdict.worst.bodies)
        continue;
      return " " + element("button.to-view",
                           {{"type", "button"},
                            {"data-playback", std::to_string(p)},
                            {"data-mark", std::to_string(m)},
                            {"hidden", ""}},
                           "Show in 3-D", element("span.unseen", ": ", html(mark.text)));
    }
  }
  return "";
}

}  // namespace broadside::reports
