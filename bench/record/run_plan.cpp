#include "bench/record/run_plan.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <system_error>
#include <utility>

#include "bench/engines.hpp"
#include "bench/plugin_engines.hpp"
#include "bench/process/child.hpp"
#include "bench/process/interrupt.hpp"
#include "bench/process/progress.hpp"
#include "bench/record/record.hpp"
#include "bench/record/resume.hpp"
#include "core/trace/trace_reader.hpp"

namespace broadside::bench {
namespace {

constexpr std::string_view kDriver = "octree-cpu";

core::Stamp stamp_before_running(const RunPlan& plan, const CellSpec& spec) {
  core::Engine engine;
  engine.id = std::string(spec.row->id);
  auto settings = core::Settings::parse(spec.row->id, spec.row->settings, spec.settings);
  if (settings) engine.settings = std::move(settings).value();
  return stamp_of(plan.scene, engine);
}

core::Cell absent_cell(const RunPlan& plan, const CellSpec& spec, const std::string& reason) {
  core::Cell cell;
  cell.stamp = stamp_before_running(plan, spec);
  cell.state = core::CellState::kNotMeasured;
  cell.reason = reason;
  return cell;
}

class Runner {
 public:
  explicit Runner(const RunPlan& plan) : plan_(plan) {}

  core::Result<RunOutcome> run() {
    auto known = core::read_rows(plan_.folder);
    if (!known) return known.error();
    known_ = std::move(known.value().cells);

    std::vector<CellSpec> specs = plan_.cells;
    // Simulations run first, in the order asked for, because their traces drive the other engines.
    std::stable_partition(specs.begin(), specs.end(), [](const CellSpec& s) { return offers(*s.row, "dynamics"); });
    for (const CellSpec& spec : specs)
      if (!offers(*spec.row, "dynamics") && !records_a_driver()) return needs_full(*spec.row);
    for (const CellSpec& spec : specs) {
      if (is_interrupted()) {
        done_.push_back(absent_cell(plan_, spec, "interrupted before it started"));
        continue;
      }
      if (!offers(*spec.row, "dynamics") && driver_.empty()) {
        if (core::Status s = run_cell({driver_row(), {}}, false); !s) return s.error();
        if (driver_.empty()) return no_driver();
      }
      if (core::Status s = run_cell(spec, true); !s) return s.error();
    }
    if (core::Status s = save(); !s) return s.error();
    return RunOutcome{done_, reused_};
  }

 private:
  static const core::EngineRow* driver_row() { return find_engine(kDriver).value(); }

  // Engines that do not simulate need every frame of a full trace.
  [[nodiscard]] bool records_a_driver() const {
    return plan_.level == core::RecordLevel::kFull && plan_.selection.every == 1;
  }

  static core::Error needs_full(const core::EngineRow& row) {
    return {fmt::format(
                "it does not simulate: it is fed by all frames of a full trace of {}, which this run would not record",
                kDriver),
            std::string(row.id), "--record full without --every, or only engines that simulate"};
  }

  [[nodiscard]] core::Error no_driver() const {
    return {"it could not be recorded, and engines that do not simulate are fed by it: " + done_.back().reason,
            std::string(kDriver), "run it alone to see why", core::Exit::kMissing};
  }

  core::Status run_cell(const CellSpec& spec, bool is_asked_for) {
    const std::string reason = why_absent(*spec.row);
    if (!reason.empty()) {
      done_.push_back(absent_cell(plan_, spec, reason));
      say_done(done_.back(), done_.size(), std::max(plan_.cells.size(), done_.size()));
      return save();
    }
    const CellRequest request{plan_.source, &plan_.scene, spec.row,        spec.settings,
                              plan_.frames, plan_.level,  plan_.selection, plan_.narrow_every,
                              plan_.folder, driver_,      plan_.resume};
    std::optional<core::Cell> reused = plan_.reuse ? reusable(spec) : std::nullopt;
    if (reused) {
      if (reused->state == core::CellState::kRecorded) ++reused_;
      done_.push_back(*std::move(reused));
    } else {
      auto cell = is_apart(spec, is_asked_for) ? record_cell_in_child(request, plan_.limits) : record_cell(request);
      if (!cell) return cell.error();
      done_.push_back(std::move(cell).value());
    }
    note_driver(spec);
    say_done(done_.back(), done_.size(), std::max(plan_.cells.size(), done_.size()));
    return save();
  }

  // Other people's code may abort, and a limit that was asked for can only be set on a process of its own. The limit is
  // meant for the engines that were asked for, not for a driver that only feeds them.
  [[nodiscard]] bool is_apart(const CellSpec& spec, bool is_asked_for) const {
    return spec.row->runs_in_child || (is_asked_for && plan_.limits.are_asked);
  }

  void note_driver(const CellSpec& spec) {
    const core::Cell& cell = done_.back();
    const bool feeds = spec.row->id == kDriver && cell.state == core::CellState::kRecorded && records_a_driver() &&
                       cell.stamp.settings_short.empty();
    if (driver_.empty() && feeds) driver_ = plan_.folder / cell.trace_file;
  }

  // A recorded cell of the same stamp and length whose trace is still there, or one whose engine of the table does not
  // support the scene. Such an engine's own build line is part of the program's build, which is compared; a plug-in's
  // content is compared here.
  std::optional<core::Cell> reusable(const CellSpec& spec) const {
    const core::Stamp wanted = stamp_before_running(plan_, spec);
    const std::string content = plugin_content(*spec.row);
    for (const core::Cell& cell : known_) {
      const core::Stamp& s = cell.stamp;
      const bool is_unsupported = cell.state == core::CellState::kUnsupported && content.empty();
      if ((cell.state != core::CellState::kRecorded && !is_unsupported) || s.scene_digest != wanted.scene_digest ||
          s.engine != wanted.engine || s.settings != wanted.settings || s.broadside_build != wanted.broadside_build ||
          s.machine != wanted.machine || s.engine_build.find(content) == std::string::npos)
        continue;
      if (is_unsupported) return cell;
      if (cell.trace_file.empty() || cell.digests.empty()) continue;
      auto trace = core::TraceReader::open(plan_.folder / cell.trace_file);
      if (!trace || trace.value().steps().empty() || trace.value().header().level != plan_.level) continue;
      if (windows_of(trace.value().header()) != plan_.selection.windows_text()) continue;
      const std::uint64_t rhythm = offers(*spec.row, "dynamics") || offers(*spec.row, "broad") ? 1 : plan_.narrow_every;
      const std::uint64_t last = plan_.frames - plan_.frames % rhythm;
      if (trace.value().steps().back() != last || trace.value().digests().back() != cell.digests.rbegin()->second)
        continue;
      return cell;
    }
    return std::nullopt;
  }

  // Rows of other cells in the folder stay; a row of the same label is replaced.
  core::Status save() const {
    std::vector<core::Cell> rows;
    const auto is_done = [&](const core::Cell& old) {
      return std::any_of(done_.begin(), done_.end(), [&](const core::Cell& c) {
        return c.stamp.label() == old.stamp.label() && c.stamp.scene_digest == old.stamp.scene_digest;
      });
    };
    for (const core::Cell& old : known_)
      if (!is_done(old)) rows.push_back(old);
    rows.insert(rows.end(), done_.begin(), done_.end());
    return core::write_cells(plan_.folder / "cells.json", rows);
  }

  const RunPlan& plan_;
  std::vector<core::Cell> known_;
  std::vector<core::Cell> done_;
  std::filesystem::path driver_;
  std::uint64_t reused_ = 0;
};

}  // namespace

core::Result<RunOutcome> run_plan(const RunPlan& plan) {
  return Runner(plan).run();
}

core::Status prepare_folder(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed)
    return core::Error{"cannot make the folder: " + failed.message(), folder.string(), "choose another --out"};
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    return core::Error{"cannot write into the folder: " + std::generic_category().message(errno), folder.string(),
                       "choose another --out, or change its permissions"};
  return core::Done{};
}

}  // namespace broadside::bench
