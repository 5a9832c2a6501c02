// Rows to JSON and back.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>

#include "bench/paper/paper_row.hpp"
#include "core/whole_file.hpp"
#include "reports/figures.hpp"

namespace broadside::bench::paper {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr int kRowVersion = 1;
constexpr const char* kRowFormat = "broadside-paper";

// JSON has no infinity and no NaN; null stands for them.
OrderedJson number(double value) {
  return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}
double number_of(const OrderedJson& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

// Times keep eight digits: more than any clock here resolves, and few enough that files stay small.
OrderedJson time(double seconds) {
  if (!std::isfinite(seconds)) return nullptr;
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.8g", seconds);
  return std::strtod(text.data(), nullptr);
}

OrderedJson to_json(const PaperRun& run) {
  OrderedJson json{{"window_s", OrderedJson::array()}, {"stage_s", OrderedJson::object()}};
  for (const double s : run.window_s) json["window_s"].push_back(time(s));
  for (const auto& [stage, s] : run.stage_s) json["stage_s"][stage] = time(s);
  return json;
}

PaperRun run_of(const OrderedJson& json) {
  PaperRun run;
  for (const OrderedJson& s : json.at("window_s")) run.window_s.push_back(number_of(s));
  for (const auto& [stage, s] : json.at("stage_s").items()) run.stage_s[stage] = number_of(s);
  return run;
}

OrderedJson to_json(const core::PenetrationStatistics& w) {
  return {w.first_step,
          w.last_step,
          w.frames,
          w.body_contacts,
          w.face_contacts,
          number(w.mean_depth_m),
          number(w.largest_depth_m),
          number(w.share_above_slop)};
}

core::PenetrationStatistics window_of(const OrderedJson& json) {
  return {json.at(0).get<std::uint64_t>(), json.at(1).get<std::uint64_t>(),
          json.at(2).get<std::uint64_t>(), json.at(3).get<std::uint64_t>(),
          json.at(4).get<std::uint64_t>(), number_of(json.at(5)),
          number_of(json.at(6)),           number_of(json.at(7))};
}

std::uint64_t digest_of(const OrderedJson& json) {
  return std::strtoull(json.get<std::string>().c_str(), nullptr, 16);
}

OrderedJson to_json(const PaperRow& row, std::size_t facts) {
  OrderedJson json{{"experiments", row.experiments},
                   {"model", row.model},
                   {"count", row.count},
                   {"method", row.method},
                   {"scene", row.stamp.scene_name},
                   {"scene_digest", reports::hexadecimal(row.stamp.scene_digest)},
                   {"engine", row.stamp.engine},
                   {"settings", row.stamp.settings},
                   {"settings_short", row.stamp.settings_short},
                   {"facts", facts},
                   {"mesh", row.mesh},
                   {"is_stand_in", row.is_stand_in},
                   {"absence", row.absence},
                   {"frames", row.frames},
                   {"judged", row.judged},
                   {"passed", row.passed},
                   {"failed", row.failed},
                   {"is_admitted", row.is_admitted},
                   {"refusal", row.refusal},
                   {"caveat", row.caveat},
                   {"final_digest", reports::hexadecimal(row.final_digest)},
                   {"window_frames", row.window_frames},
                   {"runs", OrderedJson::array()},
                   {"penetration", OrderedJson::array()},
                   {"pairs", row.pairs},
                   {"memory_bytes", row.memory_bytes},
                   {"memory_kind", row.memory_kind},
                   {"spent_s", row.spent_s}};
  if (row.beta > 0.0) json["beta"] = row.beta, json["delta_m"] = row.delta_m;
  for (const PaperRun& run : row.runs) json["runs"].push_back(to_json(run));
  for (const auto& window : row.penetration) json["penetration"].push_back(to_json(window));
  return json;
}

PaperRow row_of(const OrderedJson& json, const OrderedJson& facts) {
  PaperRow row;
  json.at("experiments").get_to(row.experiments);
  json.at("model").get_to(row.model);
  json.at("count").get_to(row.count);
  json.at("method").get_to(row.method);
  json.at("scene").get_to(row.stamp.scene_name);
  row.stamp.scene_digest = digest_of(json.at("scene_digest"));
  json.at("engine").get_to(row.stamp.engine);
  json.at("settings").get_to(row.stamp.settings);
  json.at("settings_short").get_to(row.stamp.settings_short);
  const OrderedJson& shared = facts.at(json.at("facts").get<std::size_t>());
  shared.at("machine").get_to(row.stamp.machine);
  shared.at("build").get_to(row.stamp.broadside_build);
  shared.at("engine_build").get_to(row.stamp.engine_build);
  json.at("mesh").get_to(row.mesh);
  json.at("is_stand_in").get_to(row.is_stand_in);
  json.at("absence").get_to(row.absence);
  json.at("frames").get_to(row.frames);
  json.at("judged").get_to(row.judged);
  json.at("passed").get_to(row.passed);
  json.at("failed").get_to(row.failed);
  json.at("is_admitted").get_to(row.is_admitted);
  json.at("refusal").get_to(row.refusal);
  json.at("caveat").get_to(row.caveat);
  row.final_digest = digest_of(json.at("final_digest"));
  json.at("window_frames").get_to(row.window_frames);
  if (row.window_frames == 0) throw std::invalid_argument("window_frames is 0");
  for (const OrderedJson& run : json.at("runs")) row.runs.push_back(run_of(run));
  for (const OrderedJson& window : json.at("penetration")) row.penetration.push_back(window_of(window));
  json.at("pairs").get_to(row.pairs);
  json.at("memory_bytes").get_to(row.memory_bytes);
  json.at("memory_kind").get_to(row.memory_kind);
  row.spent_s = json.value("spent_s", 0.0);  // earlier files lack it
  if (json.contains("beta")) {
    json.at("beta").get_to(row.beta);
    json.at("delta_m").get_to(row.delta_m);
  }
  return row;
}

}  // namespace

core::Status write_paper_rows(const std::filesystem::path& file, const std::vector<PaperRow>& rows) {
  std::vector<std::tuple<std::string, std::string, std::string>> facts;
  OrderedJson out{{"format", kRowFormat},
                  {"version", kRowVersion},
                  {"facts", OrderedJson::array()},
                  {"rows", OrderedJson::array()}};
  for (const PaperRow& row : rows) {
    const auto own = std::tuple(row.stamp.machine, row.stamp.broadside_build, row.stamp.engine_build);
    const auto found = std::find(facts.begin(), facts.end(), own);
    const auto at = static_cast<std::size_t>(found - facts.begin());
    if (found == facts.end()) {
      facts.push_back(own);
      out["facts"].push_back(
          {{"machine", std::get<0>(own)}, {"build", std::get<1>(own)}, {"engine_build", std::get<2>(own)}});
    }
    out["rows"].push_back(to_json(row, at));
  }
  // One row a line: small, and a diff still shows which cell changed.
  std::string text = "{\"format\":\"" + std::string(kRowFormat) + "\",\"version\":" + std::to_string(kRowVersion) +
                     ",\n\"facts\":" + out["facts"].dump() + ",\n\"rows\":[";
  for (std::size_t k = 0; k < rows.size(); ++k)
    text += (k == 0 ? "\n" : ",\n") + out["rows"][k].dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  return core::write_whole_file(file, text + "\n]}\n");
}

core::Result<std::vector<PaperRow>> read_paper_rows(const std::filesystem::path& file) {
  auto text = core::read_whole_file(file);
  if (!text) return text.error();
  std::size_t at = 0;
  try {
    const OrderedJson json = OrderedJson::parse(text.value());
    if (json.at("format") != kRowFormat)
      return core::Error{"it holds no rows of the paper's experiments", file.string(), "name a rows.json of 'paper'"};
    if (json.at("version") != kRowVersion)
      return core::Error{"it is of another version", file.string(), "make it again with this program"};
    std::vector<PaperRow> rows;
    for (const OrderedJson& row : json.at("rows")) {
      ++at;
      rows.push_back(row_of(row, json.at("facts")));
    }
    return rows;
  } catch (const std::exception& error) {
    return core::Error{"row " + std::to_string(at) + ": " + error.what(), file.string(), "make it again"};
  }
}

}  // namespace broadside::bench::paper
