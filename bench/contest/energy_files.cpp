// Energy over time of a contest's traces, and the file that keeps the curves where traces are not kept.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "bench/contest/contest_table.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench::contest {
namespace {

namespace fs = std::filesystem;
using CurvesByTrace = std::map<std::string, EnergyCurve>;

// A file that is missing or damaged gives no curves: it is made anew from the traces.
CurvesByTrace kept_curves(const fs::path& file) {
  const auto text = core::read_whole_file(file);
  if (!text) return {};
  const auto document = nlohmann::json::parse(text.value(), nullptr, false);
  CurvesByTrace curves;
  if (!document.is_object()) return curves;
  for (const auto& [trace, curve] : document.items()) {
    if (!curve.is_object() || !curve.contains("time_s") || !curve.contains("gained_j")) continue;
    EnergyCurve read;
    for (const auto& [from, to] : {std::pair{&curve["time_s"], &read.time_s}, {&curve["gained_j"], &read.gained_j}})
      if (from->is_array())
        for (const auto& value : *from)
          to->push_back(value.is_number() ? value.get<double>() : std::nan(""));  // NaN is written as null
    if (!read.time_s.empty() && read.time_s.size() == read.gained_j.size()) curves[trace] = std::move(read);
  }
  return curves;
}

core::Status keep_curves(const fs::path& file, const CurvesByTrace& curves) {
  nlohmann::json document = nlohmann::json::object();
  for (const auto& [trace, curve] : curves) document[trace] = {{"time_s", curve.time_s}, {"gained_j", curve.gained_j}};
  return core::write_whole_file(file, document.dump() + "\n");
}

}  // namespace

core::Status read_energy(ContestTable& table, const fs::path& folder, const std::vector<std::string>& scenes) {
  // More than a curve of a page's width can show.
  constexpr std::size_t kMostFrames = 240;
  const fs::path file = folder / "energy.json";
  const CurvesByTrace before = kept_curves(file);
  CurvesByTrace curves;
  for (SceneTable& scene : table.scenes) {
    if (std::find(scenes.begin(), scenes.end(), scene.scene) == scenes.end()) continue;
    for (const Entrant& e : table.entrants) {
      const Entry* entry = own_entry(scene, e.engine);
      if (entry == nullptr || entry->trace_file.empty()) continue;
      const fs::path trace = folder / entry->trace_file;
      std::error_code failed;
      EnergyCurve curve;
      if (fs::exists(trace, failed)) {
        auto read = energy_curve(trace, kMostFrames);
        if (!read) return read.error();
        curve = std::move(read).value();
      } else if (const auto kept = before.find(entry->trace_file); kept != before.end()) {
        curve = kept->second;
      } else {
        continue;
      }
      curves[entry->trace_file] = curve;
      scene.energy[e.engine] = std::move(curve);
    }
  }
  if (curves.empty()) return core::Done{};
  return keep_curves(file, curves);
}

}  // namespace broadside::bench::contest
