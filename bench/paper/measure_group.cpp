#include "bench/paper/measure_group.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "bench/cell/cell_request.hpp"
#include "bench/paper/beyond_forecast.hpp"
#include "bench/paper/cell_files.hpp"
#include "bench/paper/measure_memory.hpp"
#include "bench/paper/motion_proof.hpp"
#include "bench/paper/paper_scene.hpp"
#include "bench/process/interrupt.hpp"
#include "bench/record/judging.hpp"
#include "bench/record/run_plan.hpp"
#include "bench/timing/timing.hpp"
#include "core/trace/trace_reader.hpp"
#include "reports/timing.hpp"
#include "reports/wording.hpp"

namespace broadside::bench::paper {
namespace {

// METHOD 9 writes statistics every 100 frames. Shorter runs are divided into thirty windows too, so that their curves
// have points.
std::uint64_t window_frames_of(std::uint64_t frames) {
  return frames >= 1000 ? core::kStatisticsWindow : std::max<std::uint64_t>(1, frames / 30);
}

core::Error interrupted() {
  return {"interrupted: finished cells and runs are kept", "paper", "the same command goes on from there",
          core::Exit::kMissing};
}

// Adds the wall time of its lifetime to a cell's time.
class Spent {
 public:
  explicit Spent(double& seconds) : seconds_(seconds) {}
  Spent(const Spent&) = delete;
  Spent& operator=(const Spent&) = delete;
  ~Spent() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point start_ = Clock::now();
};

// A cell from the moment it is asked for until it is measured.
struct Work {
  const PaperCell* cell = nullptr;
  CellSpec spec;
  std::uint32_t runs = 0;  // that are to be timed
  PaperRow row;
  bool is_done = false;
  bool is_again = false;  // the same measurement as an earlier cell, under another experiment's name
};

PaperRun run_of(const core::Sample& sample, std::uint64_t window_frames) {
  PaperRun run;
  for (const core::StageSeries& series : sample.stages) {
    double sum = 0.0;
    for (std::size_t k = 0; k < series.seconds.size(); ++k) {
      sum += series.seconds[k];
      if (series.stage != "frame") continue;
      if (k % window_frames == 0) run.window_s.push_back(0.0);
      run.window_s.back() += series.seconds[k];
    }
    if (!series.seconds.empty()) run.stage_s[series.stage] = sum / static_cast<double>(series.seconds.size());
  }
  return run;
}

class Group {
 public:
  Group(std::span<const PaperCell> cells, const MeasureOptions& options)
      : cells_(cells), options_(options), files_(options.folder) {}

  core::Result<std::vector<PaperRow>> measure() {
    if (core::Status s = prepare(); !s) return s.error();
    if (std::any_of(works_.begin(), works_.end(), [](const Work& w) { return !w.is_done; })) {
      if (core::Status s = record(); !s) return s.error();
      if (core::Status s = judge(); !s) return s.error();
      if (core::Status s = time(); !s) return s.error();
      if (core::Status s = finish(); !s) return s.error();
    }
    if (!options_.keeps_traces) files_.drop_work(cells_.front().turns);
    std::vector<PaperRow> rows;
    for (const Work& work : works_) rows.push_back(work.is_again ? files_.row(*work.cell) : work.row);
    return rows;
  }

 private:
  core::Status prepare() {
    bool is_all_there = true;
    for (const PaperCell& cell : cells_) {
      Work work;
      work.cell = &cell;
      work.runs = cell.is_timed ? options_.runs : 0;
      work.row.frames = cell.frames;
      work.row.window_frames = window_frames_of(cell.frames);
      auto spec = parse_cell_spec(cell.engine);
      if (!spec) return spec.error();
      work.spec = std::move(spec).value();
      work.is_again = std::any_of(works_.begin(), works_.end(), [&](const Work& w) { return w.cell->id == cell.id; });
      work.is_done = work.is_again;
      if (auto known = files_.finished(cell.id)) {
        work.row = *std::move(known);
        work.is_done = true;
      }
      is_all_there = is_all_there && work.is_done;
      describe(cell, work.row);
      works_.push_back(std::move(work));
    }
    return is_all_there ? core::Status(core::Done{}) : prepare_scene();
  }

  core::Status prepare_scene() {
    auto scene = make_paper_scene(cells_.front(), options_.allow_stand_in);
    for (Work& work : works_) {
      if (work.is_done) continue;
      if (core::Status s = scene ? identify(work, scene.value()) : no_scene(work, scene.error()); !s) return s;
    }
    if (!scene) return core::Done{};
    plan_.scene = std::move(scene).value();
    plan_.source = {cells_.front().scene, static_cast<std::uint32_t>(cells_.front().frames), options_.allow_stand_in};
    plan_.frames = cells_.front().frames;
    plan_.selection.every = cells_.front().every;
    plan_.reuse = true;
    plan_.folder = files_.work(cells_.front().turns);
    for (const Work& work : works_) steps_ += work.is_done ? 0 : steps_of(work);
    return core::Done{};
  }

  core::Status no_scene(Work& work, const core::Error& error) {
    work.row.stamp.scene_name = work.cell->scene;
    work.row.stamp.engine = work.spec.row->id;
    return give_up(work, error.line());
  }

  // Computes the stamp that the cell will have.
  core::Status identify(Work& work, const core::Scene& scene) {
    auto settings = core::Settings::parse(work.spec.row->id, work.spec.row->settings, work.spec.settings);
    if (!settings) return settings.error();
    core::Engine engine;
    engine.id = work.spec.row->id;
    engine.settings = std::move(settings).value();
    work.row.stamp = stamp_of(scene, engine);
    work.row.mesh = scene.meshes.empty() ? "" : scene.meshes[0]->source;
    work.row.is_stand_in = !scene.meshes.empty() && scene.meshes[0]->is_stand_in;
    if (!work.cell->left_out.empty()) return give_up(work, work.cell->left_out);
    const std::string forecast = why_too_long(*work.cell, options_.campaign, files_, options_.limit_s);
    if (!forecast.empty()) return give_up(work, forecast);
    const std::string reason = work.spec.row->absent != nullptr ? work.spec.row->absent() : "";
    return reason.empty() ? core::Status(core::Done{}) : give_up(work, "not measured: " + reason);
  }

  core::Status give_up(Work& work, const std::string& reason) {
    work.row.absence = reason;
    work.is_done = true;
    return files_.give_up(work.cell->id, work.row);
  }

  [[nodiscard]] std::uint64_t steps_of(const Work& work) const {
    return 1 + work.runs + (work.cell->wants_memory ? options_.runs : 0);
  }

  void advance() {
    ++done_;
    if (options_.progress)
      options_.progress(static_cast<double>(done_) / static_cast<double>(std::max<std::uint64_t>(1, steps_)));
  }

  core::Status record() {
    if (core::Status s = prepare_folder(plan_.folder); !s) return s;
    // One engine at a time, so that an engine that cannot load the scene (too little memory, say) does not stop the
    // others.
    for (Work& work : works_) {
      if (work.is_done) continue;
      const Spent spent(work.row.spent_s);
      RunPlan alone = plan_;
      alone.cells = {work.spec};
      auto outcome = run_plan(alone);
      if (is_interrupted()) return interrupted();
      const bool is_recorded = outcome && outcome.value().cells.back().state == core::CellState::kRecorded;
      if (!is_recorded) {
        const std::string why = outcome ? reports::state_text(outcome.value().cells.back()) : outcome.error().line();
        if (core::Status s = give_up(work, why); !s) return s;
        continue;
      }
      const core::Cell& cell = outcome.value().cells.back();
      if (core::Status s = note_recording(work, cell); !s) return s;
      advance();
    }
    return core::Done{};
  }

  core::Status note_recording(Work& work, const core::Cell& cell) {
    work.row.stamp = cell.stamp;
    work.row.judged = cell.frames;
    if (!cell.digests.empty()) work.row.final_digest = cell.digests.rbegin()->second;
    for (const auto& [what, value] : cell.notes) {
      constexpr std::string_view kPrefix = "pairs: ";
      constexpr std::string_view kSuffix = ", mean";
      if (!what.starts_with(kPrefix) || !what.ends_with(kSuffix)) continue;
      const std::string name = what.substr(kPrefix.size(), what.size() - kPrefix.size() - kSuffix.size());
      work.row.pairs[name] = std::strtod(value.c_str(), nullptr);
    }
    auto trace = core::TraceReader::open(plan_.folder / cell.trace_file);
    if (!trace) return trace.error();
    auto windows = trace.value().statistics();
    if (!windows) return windows.error();
    work.row.penetration = std::move(windows).value();
    return core::Done{};
  }

  core::Status judge() {
    auto rows = core::read_rows(plan_.folder);
    if (!rows) return rows.error();
    for (const core::Cell& cell : rows.value().cells) {
      if (cell.state != core::CellState::kRecorded) continue;
      const auto is_judged = [&](const core::CellVerdicts& v) { return reports::same_stamp(v.stamp, cell.stamp); };
      if (std::any_of(rows.value().verdicts.begin(), rows.value().verdicts.end(), is_judged)) continue;
      auto verdicts = judge_matter({plan_.folder / cell.trace_file, {}, false, {}});
      if (!verdicts) return verdicts.error();
      if (core::Status s = add_motion_proof(cell.stamp, verdicts.value()); !s) return s;
      rows.value().verdicts.push_back(std::move(verdicts).value());
      if (core::Status s = core::write_verdicts(plan_.folder / "verdicts.json", rows.value().verdicts); !s) return s;
      if (is_interrupted()) return interrupted();
    }
    proof_ = std::move(rows).value();
    return core::Done{};
  }

  // A trace of every k-th step says nothing of how one step follows from the one before.
  core::Status add_motion_proof(const core::Stamp& stamp, core::CellVerdicts& verdicts) const {
    if (plan_.selection.every == 1 || !verdicts.is_simulation) return core::Done{};
    for (const Work& work : works_) {
      if (work.is_done || !reports::same_stamp(work.row.stamp, stamp)) continue;
      auto found = verdicts_of_first_steps(plan_, work.spec, stamp);
      if (!found) return found.error();
      for (core::Verdict& v : found.value()) verdicts.verdicts.push_back(std::move(v));
      return core::Done{};
    }
    return core::Done{};
  }

  // Runs of different cells alternate, so that a drift of the machine affects all cells alike.
  core::Status time() {
    for (std::uint32_t r = 0; r < options_.runs; ++r) {
      for (Work& work : works_) {
        if (work.is_done || r >= work.runs) continue;
        auto kept = files_.run(work.cell->id, r);
        if (!kept) {
          if (core::Status s = time_once(work, r); !s) return s;
        } else {
          proof_.samples.push_back(*std::move(kept));
        }
        if (!work.is_done) advance();
      }
    }
    return measure_memories();
  }

  core::Status time_once(Work& work, std::uint32_t repetition) {
    const Spent spent(work.row.spent_s);
    if (std::find(warm_.begin(), warm_.end(), &work) == warm_.end()) {
      warm_.push_back(&work);
      if (auto warm = time_run(plan_, work.spec, kWarmUpFrames); !warm) return failed(work, warm.error());
    }
    auto sample = time_run(plan_, work.spec, plan_.frames);
    if (!sample) return failed(work, sample.error());
    sample.value().repetition = repetition;
    sample.value().warm_up_frames = kWarmUpFrames;
    if (core::Status s = files_.keep_run(work.cell->id, sample.value()); !s) return s;
    proof_.samples.push_back(std::move(sample).value());
    return core::Done{};
  }

  core::Status failed(Work& work, const core::Error& error) {
    return is_interrupted() ? core::Status(interrupted()) : give_up(work, error.line());
  }

  core::Status measure_memories() {
    for (std::uint32_t r = 0; r < options_.runs; ++r) {
      for (Work& work : works_) {
        if (work.is_done || !work.cell->wants_memory) continue;
        work.row.memory_kind = memory_kind(work.spec);
        auto bytes = memory_of_run(plan_, work.spec, work.row.window_frames);
        if (is_interrupted()) return interrupted();
        if (!bytes) {
          work.row.memory_kind = bytes.error().line();
          continue;
        }
        work.row.memory_bytes.push_back(bytes.value());
        advance();
      }
    }
    return core::Done{};
  }

  core::Status finish() {
    const std::vector<reports::Timing> timings = reports::pool_samples(proof_);
    for (Work& work : works_) {
      if (work.is_done) continue;
      count_verdicts(work.row);
      for (const core::Sample& sample : proof_.samples)
        if (reports::same_stamp(sample.stamp, work.row.stamp))
          work.row.runs.push_back(run_of(sample, work.row.window_frames));
      for (const reports::Timing& timing : timings) {
        if (!reports::same_stamp(timing.stamp, work.row.stamp)) continue;
        work.row.is_admitted = timing.admission.is_admitted;
        work.row.refusal = timing.admission.reason;
        work.row.caveat = timing.admission.caveat;
      }
      if (core::Status s = files_.finish(work.cell->id, work.row, proof_of(work.row.stamp)); !s) return s;
      work.is_done = true;
    }
    return core::Done{};
  }

  // The rows of a cell in the form that every campaign has.
  [[nodiscard]] core::RunRows proof_of(const core::Stamp& stamp) const {
    core::RunRows own;
    for (const core::Cell& cell : proof_.cells)
      if (reports::same_stamp(cell.stamp, stamp)) own.cells.push_back(cell);
    for (const core::CellVerdicts& verdicts : proof_.verdicts)
      if (reports::same_stamp(verdicts.stamp, stamp)) own.verdicts.push_back(verdicts);
    return own;
  }

  // Without times, the recorded statistics are admitted when no verdict failed and at least one passed.
  void count_verdicts(PaperRow& row) const {
    for (const core::CellVerdicts& verdicts : proof_.verdicts) {
      if (!reports::same_stamp(verdicts.stamp, row.stamp)) continue;
      for (const core::Verdict& v : verdicts.verdicts) {
        if (v.outcome == core::Outcome::kPass) ++row.passed;
        if (v.outcome != core::Outcome::kFail) continue;
        ++row.failed;
        row.refusal += (row.refusal.empty() ? "" : ", ") + v.validator + " failed";
      }
    }
    row.is_admitted = row.failed == 0 && row.passed > 0;
    if (row.failed == 0 && row.passed == 0) row.refusal = "nothing was proven";
  }

  std::span<const PaperCell> cells_;
  const MeasureOptions& options_;
  CellFiles files_;
  RunPlan plan_;
  core::RunRows proof_;
  std::vector<Work> works_;
  std::vector<const Work*> warm_;
  std::uint64_t steps_ = 0;
  std::uint64_t done_ = 0;
};

}  // namespace

core::Result<std::vector<PaperRow>> measure_group(std::span<const PaperCell> cells, const MeasureOptions& options) {
  if (cells.empty()) return std::vector<PaperRow>{};
  return Group(cells, options).measure();
}

}  // namespace broadside::bench::paper
