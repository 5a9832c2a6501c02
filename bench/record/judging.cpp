#include "bench/record/judging.hpp"

#include <algorithm>
#include <utility>

#include "bench/process/interrupt.hpp"
#include "bench/process/progress.hpp"
#include "core/trace/trace_reader.hpp"
#include "validation/energy.hpp"
#include "validation/energy_ledger.hpp"
#include "validation/judge.hpp"
#include "validation/outcome.hpp"
#include "validation/subject_facts.hpp"

namespace broadside::bench {
namespace {

bool needs_baseline(const std::string& validator) {
  const auto table = validation::validators();
  return std::any_of(table.begin(), table.end(), [&](const validation::ValidatorRow& row) {
    return row.name == validator && row.baseline_groups != 0;
  });
}

// Values are in the order of core::kEnergyColumns.
void add(const validation::EnergyRow& row, core::EnergySeries& series) {
  const double values[] = {row.kinetic,  row.potential,  row.integration, row.normal,
                           row.friction, row.correction, row.clip};
  static_assert(std::size(values) == core::kEnergyColumnCount);
  series.step.push_back(row.step);
  for (std::size_t k = 0; k < core::kEnergyColumnCount; ++k) series.joule[k].push_back(values[k]);
}

}  // namespace

core::Result<core::CellVerdicts> judge_matter(const Matter& matter) {
  auto trace = core::TraceReader::open(matter.trace);
  if (!trace) return trace.error();
  std::optional<core::TraceReader> baseline;
  if (!matter.baseline.empty()) {
    auto opened = core::TraceReader::open(matter.baseline);
    if (!opened) return opened.error();
    baseline = std::move(opened).value();
  }
  core::CellVerdicts row;
  row.trace_file = matter.trace.filename().string();
  row.stamp = trace.value().header().stamp;
  row.is_simulation = validation::moves_bodies(trace.value().header());
  const auto& declared = trace.value().header().declaration.declared();
  row.declaration.insert(declared.begin(), declared.end());

  Progress progress("judging " + row.stamp.label(), trace.value().frame_count());
  validation::JudgeOptions options;
  options.only = matter.only;
  options.progress = [&](std::uint64_t done, std::uint64_t) { progress.at(done); };
  const core::TraceHeader& header = trace.value().header();
  const validation::EnergyLedger ledger(header.scene);
  const bool has_ledger = matter.energy != nullptr && validation::energy_row().why_not({header, nullptr, 0}).empty();
  if (has_ledger) {
    *matter.energy = {row.trace_file, row.stamp.scene_name, row.stamp.label(), {}, {}};
    options.observed_groups = validation::energy_row().groups;
    options.observe = [&](const validation::Evidence& evidence) {
      if (const auto frame = ledger.row(evidence.frame, evidence.previous)) add(*frame, *matter.energy);
    };
  }
  auto verdicts = validation::judge(trace.value(), baseline ? &*baseline : nullptr, options);
  if (!verdicts) return verdicts.error();
  row.verdicts = std::move(verdicts).value();
  if (matter.only_against_baseline) {
    std::erase_if(row.verdicts, [&](const core::Verdict& v) {
      return v.baseline.empty() || v.outcome == core::Outcome::kNotApplicable || !needs_baseline(v.validator);
    });
  }
  return row;
}

core::Exit exit_of(const std::vector<core::CellVerdicts>& rows) {
  std::vector<core::Verdict> all;
  for (const core::CellVerdicts& row : rows) all.insert(all.end(), row.verdicts.begin(), row.verdicts.end());
  return validation::exit_of(validation::worst_outcome(all));
}

}  // namespace broadside::bench
