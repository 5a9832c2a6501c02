// Which engine lets bodies pass through others: one picture per course, with a row per engine and a column per distance
// that the body moves a step.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "bench/contest/contest_document.hpp"
#include "bench/contest/passage_courses.hpp"
#include "reports/plots/chart_area.hpp"
#include "reports/plots/drawing.hpp"

namespace broadside::bench::contest {
namespace {

using namespace reports::plots;

constexpr double kWidth = 760.0;
constexpr double kRowHeight = 17.0;
constexpr double kGap = 1.5;

// The color of a mark, and how full it is: a passage is full, so that it can be seen without colors too.
struct Look {
  std::string_view style;
  double opacity;
};

Look look_of(const Entry* entry) {
  if (entry == nullptr || entry->state != core::CellState::kRecorded) return {"s0", 0.0};
  if (entry->passage == "through") return {"s5", 0.95};
  if (entry->passage == "held") return {"s3", 0.3};
  return {"s7", 0.2};
}

std::string word_of(const Entry* entry) {
  if (entry == nullptr) return "not run";
  if (entry->state != core::CellState::kRecorded) return std::string(core::cell_state_word(entry->state));
  return entry->passage;
}

const Entry* entry_of(const ContestTable& table, const std::string& scene_name, const std::string& engine) {
  const auto [name, step] = name_and_step(scene_name);
  for (const auto* scenes : {&table.scenes, &table.fast_scenes})
    for (const SceneTable& scene : *scenes)
      if (scene.scene == name)
        if (const auto of = scene.entries.find(engine); of != scene.entries.end())
          if (const auto at = of->second.find(step); at != of->second.end()) return &at->second;
  return nullptr;
}

// The engines that ran at any distance.
std::vector<std::string> engines_of(const ContestTable& table, const PassageCourse& course) {
  std::vector<std::string> engines;
  for (const Entrant& e : table.entrants)
    if (std::count_if(course.runs.begin(), course.runs.end(),
                      [&](const PassageRun& run) { return entry_of(table, run.scene, e.engine) != nullptr; }) > 1)
      engines.push_back(e.engine);
  return engines;
}

std::string picture(const ContestTable& table, const PassageCourse& course, const std::vector<std::string>& engines,
                    Placement placement) {
  std::string words;
  for (const std::string& engine : engines) {
    words += engine + ":";
    for (const PassageRun& run : course.runs)
      words += fmt::format(" {:.3g} m {},", run.step_m, word_of(entry_of(table, run.scene, engine)));
    words.back() = '.';
    words += ' ';
  }
  const double top = 52.0;
  Drawing drawing(kWidth, top + kRowHeight * static_cast<double>(engines.size()) + 8.0, course.name, words);
  draw_head(drawing, course.name, {});
  double left = 0.0;
  for (const std::string& engine : engines) left = std::max(left, text_width(engine));
  left += 16.0;
  const double width = (kWidth - 8.0 - left) / static_cast<double>(course.runs.size());
  drawing.text("name", {left - 6.0, top - 6.0}, Anchor::kEnd, "moves a step");
  for (std::size_t c = 0; c < course.runs.size(); ++c)
    drawing.text("tick", {left + (static_cast<double>(c) + 0.5) * width, top - 6.0}, Anchor::kMiddle,
                 fmt::format("{:.3g} m", course.runs[c].step_m));
  for (std::size_t r = 0; r < engines.size(); ++r) {
    const double y = top + static_cast<double>(r) * kRowHeight;
    drawing.text("value", {left - 6.0, y + 12.0}, Anchor::kEnd, engines[r]);
    for (std::size_t c = 0; c < course.runs.size(); ++c) {
      const double x = left + static_cast<double>(c) * width;
      const Entry* entry = entry_of(table, course.runs[c].scene, engines[r]);
      const Look look = look_of(entry);
      drawing.shaded_rect(look.style, {x, y}, width - kGap, kRowHeight - kGap, look.opacity,
                          entry == nullptr ? std::string() : entry->passage_words);
      drawing.text(look.opacity > 0.5 ? "on-full" : "value", {x + 0.5 * width, y + 12.0}, Anchor::kMiddle,
                   word_of(entry));
    }
  }
  return drawing.finish(placement);
}

}  // namespace

void add_passages(Document& document, const ContestTable& table) {
  std::vector<Block> figures;
  const std::vector<PassageCourse> courses = passage_courses();
  // Engines that ran only at the scenes' own steps are in the table of verdicts.
  std::vector<std::string> columns;
  for (const Entrant& e : table.entrants)
    if (std::any_of(courses.begin(), courses.end(), [&](const PassageCourse& course) {
          const auto ran = engines_of(table, course);
          return std::find(ran.begin(), ran.end(), e.engine) != ran.end();
        }))
      columns.push_back(e.engine);
  Table words{"passages", "The law passage on fast bodies", {"scene", "moves a step, m"}, {}};
  words.columns.insert(words.columns.end(), columns.begin(), columns.end());
  for (const PassageCourse& course : courses) {
    const std::vector<std::string> engines = engines_of(table, course);
    if (engines.empty()) continue;
    figures.emplace_back(Figure{file_name_of("passage", course.name), picture(table, course, engines, Placement::kFile),
                                picture(table, course, engines, Placement::kInline), course.what});
    for (const PassageRun& run : course.runs) {
      std::vector<TableCell> line{{course.name}, {fmt::format("{:.3g}", run.step_m), run.step_m}};
      for (const std::string& engine : columns) {
        const Entry* entry = entry_of(table, run.scene, engine);
        TableCell cell{word_of(entry)};
        cell.tone = cell.text == "held" ? Tone::kGood : cell.text == "through" ? Tone::kBad : Tone::kAbsent;
        line.push_back(std::move(cell));
      }
      words.rows.push_back(std::move(line));
    }
  }
  if (figures.empty()) return;
  document.blocks.emplace_back(Heading{"What passes through what", "passages"});
  document.blocks.emplace_back(Paragraph{
      "The verdict of the law passage, which follows the motion between frames: held, or through. Nothing met: the "
      "body had stopped, or was turned aside, before the obstacle. The fast scenes run at steps of 1/60 to 1/960 s; "
      "the mesh drops at 1 to 200 m/s at 1/60 s."});
  for (Block& figure : figures) document.blocks.push_back(std::move(figure));
  document.blocks.emplace_back(Fold{"The same in words", "passages_table", false, {std::move(words)}});
}

}  // namespace broadside::bench::contest
