// The report as a comment on a pull request.
#include <algorithm>

#include "reports/equivalence.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/report.hpp"
#include "reports/scene_view.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

// Longer names are cut, because they are a mistake or an attack; the page has them whole.
constexpr std::size_t kNameColumns = 120;
// Kept free for the remarks on what was left out.
constexpr std::size_t kReserve = 2'000;

std::string name(std::string_view text) {
  return markdown(clipped(printable(text), kNameColumns));
}
std::string sentence(std::string_view text) {
  return markdown(clipped(printable(text), 400));
}

// Collects lines as long as they fit.
class Comment {
 public:
  // Adds a block whole or not at all.
  void add(const std::string& block) {
    if (!fits(block)) return;
    text_ += block;
  }

  // Adds a head, then as many rows as fit, and then how many did not fit.
  void add_rows(const std::string& head, const std::vector<std::string>& rows) {
    if (rows.empty()) return;
    if (!fits(head + rows.front())) {
      text_ += "\n_" + counted(rows.size(), "row") + " left out here to keep this comment short._\n";
      return;
    }
    text_ += head;
    std::size_t written = 0;
    for (; written < rows.size() && fits(rows[written]); ++written) text_ += rows[written];
    if (written < rows.size())
      text_ += "\n_" + counted(rows.size() - written, "more row") + " left out to keep this comment short._\n";
  }

  std::string take() { return std::move(text_); }

 private:
  [[nodiscard]] bool fits(const std::string& block) const {
    return text_.size() + block.size() + kReserve <= kMarkdownLimit;
  }

  std::string text_;
};

std::string row_of(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + cell + " |";
  return row + "\n";
}

std::string head_of(const std::vector<std::string>& cells, std::size_t first_figure) {
  std::string rule = "|";
  for (std::size_t k = 0; k < cells.size(); ++k) rule += k >= first_figure ? " ---: |" : " --- |";
  return "\n" + row_of(cells) + rule + "\n";
}

std::string word_of(core::Outcome outcome) {
  switch (outcome) {
    case core::Outcome::kPass:
      return "\xE2\x9C\x93 pass";
    case core::Outcome::kFail:
      return "**\xE2\x9C\x97 FAIL**";
    case core::Outcome::kInconclusive:
      return "**? unsure**";
    case core::Outcome::kNotApplicable:
      return "n/a";
  }
  return "";
}

void add_failures(Comment& comment, const std::vector<SceneView>& scenes) {
  std::vector<std::string> rows;
  for (const core::Outcome outcome : {core::Outcome::kFail, core::Outcome::kInconclusive}) {
    for (const SceneView& scene : scenes) {
      for (const TraceView& trace : scene.traces) {
        for (const auto& said : trace.verdicts) {
          for (const core::Verdict* verdict : said) {
            if (verdict->outcome != outcome) continue;
            const Compared values = compared(verdict->measured, verdict->limit, verdict->unit);
            const std::string step = verdict->worst.step < 0 ? "none" : std::to_string(verdict->worst.step);
            const std::string bodies = bodies_text(verdict->worst.bodies);
            rows.push_back(row_of({word_of(outcome), name(verdict->validator), name(trace.label), name(values.measured),
                                   name(values.limit), step, bodies.empty() ? "none" : name(bodies),
                                   sentence(verdict->explanation)}));
          }
        }
      }
    }
  }
  comment.add_rows("\n### What did not pass\n" +
                       head_of({"verdict", "validator", "engine", "measured", "limit", "frame", "pair", "why"}, 8),
                   rows);
}

void add_matrix(Comment& comment, const SceneView& scene) {
  std::vector<std::string> head{"engine"};
  for (const std::string& validator : scene.validators) head.push_back(name(validator));
  std::vector<std::string> rows;
  for (const TraceView& trace : scene.traces) {
    std::vector<std::string> cells{name(trace.label)};
    if (!trace.is_judged()) {
      // The reason is printed once; the other places refer to it by the same word.
      cells.push_back(name(trace.absence()));
      const std::string word = trace.cell == nullptr || trace.cell->state == core::CellState::kRecorded
                                   ? "not judged"
                                   : std::string(core::cell_state_word(trace.cell->state));
      for (std::size_t c = 1; c < scene.validators.size(); ++c) cells.push_back(word);
      if (scene.validators.empty()) cells.resize(2);
    } else {
      for (const auto& said : trace.verdicts)
        cells.push_back(said.empty() ? "not judged" : word_of(said.front()->outcome));
    }
    rows.push_back(row_of(cells));
  }
  if (scene.validators.empty()) head.emplace_back("state");
  comment.add_rows("\n### " + name(scene.name) + "\n" + head_of(head, head.size()), rows);
}

// How many laws applied, and why the others did not.
void add_coverage(Comment& comment, const SceneView& scene) {
  std::vector<std::string> rows;
  for (const TraceView& trace : scene.traces) {
    if (!trace.is_judged()) continue;
    std::string others;
    for (const auto& [why, laws] : trace.not_applied()) {
      std::string names;
      for (const std::string& law : laws) names += (names.empty() ? "" : ", ") + law;
      others += (others.empty() ? "" : "; ") + names + ": " + why;
    }
    const std::string motion = !trace.is_simulation        ? "it moves no bodies"
                               : trace.has_proven_motion() ? "proven"
                                                           : "**its motion was not proven**";
    rows.push_back(row_of({name(trace.label), core::coverage_text(trace.coverage()), motion,
                           others.empty() ? "none" : markdown(clipped(printable(others), 2000))}));
  }
  comment.add_rows("\n#### How much was judged\n" + head_of({"engine", "coverage", "motion", "did not apply"}, 4),
                   rows);
}

void add_times(Comment& comment, const SceneView& scene) {
  if (scene.timings.empty()) {
    comment.add("\nTimes: not measured.\n");
    return;
  }
  std::vector<std::string> rows;
  for (const Timing& timing : scene.timings) {
    const auto struck = [&](const std::string& text) {
      return timing.admission.is_admitted ? text : "~~" + text + "~~";
    };
    const Summary& f = timing.frame;
    const TimeUnit unit = time_unit_for(f.median);
    std::string stages;
    for (const StageTiming& stage : timing.stages)
      stages += (stages.empty() ? "" : ", ") + name(stage.stage) + " " + time_in(unit, stage.seconds.median);
    std::string remark = timing.admission.is_admitted ? "admitted" : "struck out: " + timing.admission.reason;
    if (!timing.admission.caveat.empty()) remark += ", " + timing.admission.caveat;
    rows.push_back(row_of({name(timing.stamp.label()), struck(time_in(unit, f.median) + " " + std::string(unit.name)),
                           struck(time_in(unit, f.p5) + " \xE2\x80\x93 " + time_in(unit, f.p95)),
                           struck(percent(f.relative_spread)), struck(figure(timing.fps.mean, 4)), counted(f.count),
                           counted(timing.repetitions), stages.empty() ? "none" : stages, sentence(remark)}));
  }
  comment.add_rows("\n#### Times per frame\n" + head_of({"engine", "median", "p5 \xE2\x80\x93 p95", "spread", "FPS",
                                                         "frames", "runs", "median of stages", "counts?"},
                                                        1),
                   rows);
}

void add_machine(Comment& comment, const SceneView& scene) {
  std::vector<std::string> machines;
  for (const TraceView& trace : scene.traces) {
    const std::string line = name(trace.stamp.machine) + "; " + name(trace.stamp.broadside_build);
    if (std::find(machines.begin(), machines.end(), line) == machines.end()) machines.push_back(line);
  }
  for (const std::string& line : machines) comment.add("\nOn " + line + ".\n");
  const std::string text = stand_in(scene);
  if (!text.empty()) comment.add("\n**Stand-in mesh:** " + sentence(text) + "\n");
}

}  // namespace

std::string markdown_text(const core::RunRows& rows, const ReportOptions& options) {
  const std::vector<SceneView> scenes = by_scene(rows);
  Comment comment;
  const core::Outcome state = overall(tally(scenes));
  comment.add("## Broadside: " + name(options.title.empty() ? kDefaultTitle : options.title) + "\n\n**" +
              std::string(symbol(state)) + "** " + sentence(headline(scenes)) + "\n");
  if (!options.note.empty()) comment.add("\n" + sentence(options.note) + "\n");
  add_failures(comment, scenes);
  for (const SceneView& scene : scenes) {
    add_matrix(comment, scene);
    add_coverage(comment, scene);
    add_times(comment, scene);
    for (const std::string& block : equivalence_markdown(scene)) comment.add(block);
    add_machine(comment, scene);
  }
  if (!options.command.empty()) comment.add("\nMade by " + sentence(options.command) + "\n");
  if (!options.generated_at.empty()) comment.add("\n" + name(options.generated_at) + "\n");
  return comment.take();
}

}  // namespace broadside::reports
