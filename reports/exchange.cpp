#include "reports/exchange.hpp"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "reports/admission.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/sample_figures.hpp"
#include "reports/timing.hpp"

namespace broadside::reports {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string dumped(const OrderedJson& json) {
  return json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

std::string name_of(const core::Stamp& stamp, const std::string& stage) {
  return printable(stamp.scene_name) + "/" + printable(stamp.label()) + "/" + printable(stage);
}

struct Part {
  std::string stage;
  std::vector<double> seconds;
};

// The whole frame first, then the stages.
std::vector<Part> parts_of(const core::Sample& sample) {
  std::vector<Part> parts{{"frame", frame_seconds(sample)}};
  for (const core::StageSeries& series : sample.stages)
    if (series.stage != "frame") parts.push_back({series.stage, series.seconds});
  return parts;
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& raw : cells) {
    std::string cell = printable(raw);
    if (cell.find_first_of(",\"") != std::string::npos) {
      std::string quoted = "\"";
      for (const char c : cell) quoted += c == '"' ? "\"\"" : std::string(1, c);
      cell = quoted + "\"";
    }
    line += (line.empty() ? "" : ",") + cell;
  }
  return line + "\n";
}

std::string number(double value) {
  return std::isfinite(value) ? OrderedJson(value).dump() : "";
}

}  // namespace

std::string google_benchmark_json(const core::RunRows& rows) {
  OrderedJson benchmarks = OrderedJson::array();
  std::map<std::string, std::size_t> repetitions;
  std::set<std::string> builds;
  for (const core::Sample& sample : rows.samples)
    if (admit(sample, rows).is_admitted) ++repetitions[name_of(sample.stamp, "frame")];
  std::map<std::string, std::size_t> done;
  std::map<std::string, std::size_t> families;
  for (const core::Sample& sample : rows.samples) {
    if (!admit(sample, rows).is_admitted) continue;
    builds.insert(sample.stamp.broadside_build);
    const std::size_t repetition = done[name_of(sample.stamp, "frame")]++;
    for (const Part& part : parts_of(sample)) {
      const Summary s = summarize(part.seconds);
      if (s.count == 0) continue;
      const std::string name = name_of(sample.stamp, part.stage);
      const std::size_t family = families.try_emplace(name, families.size()).first->second;
      benchmarks.push_back({{"name", name},
                            {"family_index", family},
                            {"per_family_instance_index", 0},
                            {"run_name", name},
                            {"run_type", "iteration"},
                            {"repetitions", repetitions[name_of(sample.stamp, "frame")]},
                            {"repetition_index", repetition},
                            {"threads", 1},
                            {"iterations", s.count},
                            {"real_time", 1e9 * s.mean},
                            {"cpu_time", 1e9 * s.mean},
                            {"time_unit", "ns"}});
    }
  }
  OrderedJson context{{"executable", "broadside"}, {"cpu_time", "not measured: repeats real_time"}};
  if (!rows.samples.empty()) context["machine"] = printable(rows.samples.front().stamp.machine);
  if (!builds.empty()) context["build"] = printable(*builds.begin());
  return dumped({{"context", std::move(context)}, {"benchmarks", std::move(benchmarks)}});
}

std::string smaller_is_better_json(const core::RunRows& rows) {
  OrderedJson all = OrderedJson::array();
  for (const Timing& timing : pool_samples(rows)) {
    if (!timing.admission.is_admitted || timing.frame.count == 0) continue;
    all.push_back({{"name", name_of(timing.stamp, "median frame")},
                   {"unit", "ms"},
                   {"value", 1e3 * timing.frame.median},
                   {"range", figure(1e3 * timing.frame.q1, 4) + " to " + figure(1e3 * timing.frame.q3, 4)},
                   {"extra", counted(timing.repetitions, "run") + " on " + printable(timing.stamp.machine)}});
  }
  for (const core::Cell& cell : rows.cells)
    for (const auto& [name, count] : cell.counters)
      all.push_back({{"name", name_of(cell.stamp, name)},
                     {"unit", "count"},
                     {"value", count},
                     {"extra", "over " + counted(cell.frames, "frame") + "; the same on every machine"}});
  return dumped(all);
}

std::string figures_csv(const core::RunRows& rows) {
  std::string text =
      csv_line({"scene", "engine", "settings", "machine", "what", "name", "value", "unit", "runs", "counts"});
  const auto line = [&](const core::Stamp& s, const std::string& what, const std::string& name,
                        const std::string& value, const std::string& unit, const std::string& runs,
                        const std::string& counts) {
    text += csv_line({s.scene_name, s.engine, s.settings_short, s.machine, what, name, value, unit, runs, counts});
  };
  for (const core::Cell& cell : rows.cells) {
    line(cell.stamp, "cell", "state", std::string(core::cell_state_word(cell.state)), "", "", cell.reason);
    for (const auto& [name, count] : cell.counters)
      line(cell.stamp, "counter", name, std::to_string(count), "", "", "yes");
  }
  for (const core::CellVerdicts& judged : rows.verdicts)
    for (const core::Verdict& v : judged.verdicts)
      line(judged.stamp, "verdict", v.baseline.empty() ? v.validator : v.validator + " against " + v.baseline,
           number(v.measured), v.unit, "", std::string(core::outcome_word(v.outcome)));
  for (const Timing& timing : pool_samples(rows)) {
    const std::string counts = timing.admission.is_admitted ? "yes" : timing.admission.reason;
    const std::string runs = std::to_string(timing.repetitions);
    const auto summary = [&](const std::string& stage, const Summary& s) {
      for (const auto& [name, value] : {std::pair{"median", s.median}, {"mean", s.mean}, {"p5", s.p5}, {"p95", s.p95}})
        line(timing.stamp, "time", stage + " " + name, number(value), "s", runs, counts);
    };
    summary("frame", timing.frame);
    for (const StageTiming& stage : timing.stages) summary(stage.stage, stage.seconds);
  }
  return text;
}

}  // namespace broadside::reports
