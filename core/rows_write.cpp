// Rows to JSON. The reader of the same files is rows_read.cpp.
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/coverage.hpp"
#include "core/rows.hpp"
#include "core/whole_file.hpp"

namespace broadside::core {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string hex(std::uint64_t digest) {
  char text[19];
  std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(digest));
  return text;
}

// JSON has no literal for these numbers, and a missing value would read as zero.
OrderedJson number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

OrderedJson numbers(const std::vector<double>& values) {
  OrderedJson array = OrderedJson::array();
  for (const double value : values) array.push_back(number(value));
  return array;
}

OrderedJson to_json(const Stamp& stamp) {
  return OrderedJson{{"scene_name", stamp.scene_name},
                     {"scene_digest", hex(stamp.scene_digest)},
                     {"engine", stamp.engine},
                     {"settings", stamp.settings},
                     {"settings_short", stamp.settings_short},
                     {"engine_build", stamp.engine_build},
                     {"broadside_build", stamp.broadside_build},
                     {"machine", stamp.machine}};
}

OrderedJson to_json(const Cell& cell) {
  OrderedJson digests = OrderedJson::object();
  for (const auto& [step, digest] : cell.digests) digests[std::to_string(step)] = hex(digest);
  OrderedJson counters = OrderedJson::object();
  for (const auto& [name, count] : cell.counters) counters[name] = count;
  OrderedJson notes = OrderedJson::object();
  for (const auto& [key, text] : cell.notes) notes[key] = text;
  return OrderedJson{{"stamp", to_json(cell.stamp)},  {"state", std::string(cell_state_word(cell.state))},
                     {"reason", cell.reason},         {"trace_file", cell.trace_file},
                     {"frames", cell.frames},         {"wall_s", number(cell.wall_s)},
                     {"digests", std::move(digests)}, {"counters", std::move(counters)},
                     {"notes", std::move(notes)}};
}

OrderedJson to_json(const Verdict& verdict);

OrderedJson all_of(const std::vector<Verdict>& verdicts) {
  OrderedJson array = OrderedJson::array();
  for (const Verdict& verdict : verdicts) array.push_back(to_json(verdict));
  return array;
}

OrderedJson to_json(const Verdict& verdict) {
  OrderedJson json{
      {"validator", verdict.validator},
      {"outcome", std::string(outcome_word(verdict.outcome))},
      {"measured", number(verdict.measured)},
      {"limit", number(verdict.limit)},
      {"unit", verdict.unit},
      {"origin", verdict.origin},
      {"explanation", verdict.explanation},
      {"worst",
       OrderedJson{{"step", verdict.worst.step}, {"bodies", verdict.worst.bodies}, {"field", verdict.worst.field}}},
      {"checked", verdict.checked},
      {"violations", verdict.violations},
      {"baseline", verdict.baseline},
      {"law", verdict.law},
      {"kind", std::string(law_kind_word(verdict.kind))},
      {"ties_motion_to_forces", verdict.ties_motion_to_forces},
      {"moved", verdict.moved}};
  if (!verdict.parts.empty()) json["parts"] = all_of(verdict.parts);
  return json;
}

OrderedJson to_json(const LawCount& count) {
  return OrderedJson{{"applied", count.applied}, {"laws", count.laws}};
}

OrderedJson to_json(const CellVerdicts& cell) {
  OrderedJson coverage = OrderedJson::object();
  const Coverage counts = coverage_of(cell.verdicts);
  for (std::size_t k = 0; k < kLawKinds.size(); ++k)
    coverage[std::string(law_kind_word(kLawKinds[k]))] = to_json(counts.counts[k]);
  OrderedJson declaration = OrderedJson::object();
  for (const auto& [key, text] : cell.declaration) declaration[key] = text;
  return OrderedJson{{"trace_file", cell.trace_file},       {"stamp", to_json(cell.stamp)},
                     {"is_simulation", cell.is_simulation}, {"declaration", std::move(declaration)},
                     {"coverage", std::move(coverage)},     {"verdicts", all_of(cell.verdicts)}};
}

OrderedJson to_json(const Sample& sample) {
  OrderedJson stages = OrderedJson::array();
  for (const StageSeries& series : sample.stages)
    stages.push_back(OrderedJson{{"stage", series.stage}, {"seconds", numbers(series.seconds)}});
  return OrderedJson{{"stamp", to_json(sample.stamp)}, {"repetition", sample.repetition},
                     {"process", hex(sample.process)}, {"warm_up_frames", sample.warm_up_frames},
                     {"stages", std::move(stages)},    {"final_digest", hex(sample.final_digest)},
                     {"final_step", sample.final_step}};
}

// One row per line, so that two files can be compared line by line and long series stay compact.
template <typename Row>
Status write_rows(const std::filesystem::path& file, std::string_view format, const std::vector<Row>& rows) {
  std::string text = "{\"format\": \"" + std::string(format) + "\", \"version\": 1, \"rows\": [";
  const char* separator = "\n";
  for (const Row& row : rows) {
    text += separator;
    text += to_json(row).dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    separator = ",\n";
  }
  text += "\n]}\n";
  return write_whole_file(file, text);
}

}  // namespace

Status write_cells(const std::filesystem::path& file, const std::vector<Cell>& cells) {
  return write_rows(file, "broadside-cells", cells);
}

Status write_verdicts(const std::filesystem::path& file, const std::vector<CellVerdicts>& verdicts) {
  return write_rows(file, "broadside-verdicts", verdicts);
}

Status write_samples(const std::filesystem::path& file, const std::vector<Sample>& samples) {
  return write_rows(file, "broadside-samples", samples);
}

}  // namespace broadside::core
