#include "bench/agree/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace broadside::bench {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string row_text(std::string_view name, const AgreementBin& bin) {
  return fmt::format("  {:<20} {:>8}  {}\n", name, bin.pairs(), agreement_text(bin));
}

// "1e-8 12, 1e-7 300": how many are below each power of ten and not below the one before.
template <std::size_t N>
std::string decades(const std::array<std::uint64_t, N>& count, int lowest) {
  std::string text;
  for (std::size_t k = 0; k < N; ++k) {
    if (count[k] == 0) continue;
    const int power = lowest + static_cast<int>(k);
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                        k + 1 < N ? fmt::format("<1e{}", power) : fmt::format(">=1e{}", power - 1), count[k]);
  }
  return text.empty() ? "none" : text;
}

std::string study_text(const EngineStudy& study) {
  std::string out = study.label + "\n";
  if (!study.absent.empty()) return out + "  nothing: " + study.absent + "\n";
  for (std::size_t k = 0; k < std::size(kSeparations); ++k) {
    const AgreementBin& bin = study.table.by_separation[k];
    if (bin.pairs() == 0) continue;
    out += row_text(kSeparations[k], bin);
    out += fmt::format("  {:<20} {:>8}  off by m: {}\n  {:<20} {:>8}  off by rad: {}\n", "", "", decades(bin.error, -8),
                       "", "", decades(bin.angle, -6));
  }
  for (std::size_t k = 1; k < std::size(kDegeneracies); ++k)
    if (study.table.by_degeneracy[k].pairs() > 0) out += row_text(kDegeneracies[k], study.table.by_degeneracy[k]);
  for (const auto& [words, count] : study.words) out += fmt::format("  {} x {}\n", count, words);
  for (const std::string& command : study.repeats) out += "  repeat: " + command + "\n";
  return out;
}

OrderedJson bin_json(const AgreementBin& bin) {
  OrderedJson counts = OrderedJson::object();
  for (std::size_t k = 0; k < kAgreements.size(); ++k)
    if (bin.count[k] > 0) counts[std::string(kAgreements[k])] = bin.count[k];
  const double median = bin.median_s();
  return {{"pairs", bin.pairs()},
          {"verdicts", counts},
          {"error_decades_from_1e-8_m", bin.error},
          {"angle_decades_from_1e-6_rad", bin.angle},
          {"median_s", std::isnan(median) ? OrderedJson(nullptr) : OrderedJson(median)}};
}

// Counts by decade, summed over all separations. The report draws them as a histogram.
template <std::size_t N>
std::string histogram_text(const AgreementTable& table, std::array<std::uint64_t, N> AgreementBin::*of) {
  std::string text;
  for (std::size_t k = 0; k < N; ++k) {
    std::uint64_t sum = 0;
    for (const AgreementBin& bin : table.by_separation) sum += (bin.*of)[k];
    text += (k == 0 ? "" : " ") + std::to_string(sum);
  }
  return text;
}

core::Cell cell_of(const EngineStudy& study) {
  core::Cell cell;
  cell.stamp = study.stamp;
  cell.state = study.absent.empty() ? core::CellState::kRecorded : core::CellState::kUnsupported;
  cell.reason = study.absent;
  cell.notes = study.notes;
  core::add_notes(study.defects, cell.notes);
  if (!study.absent.empty()) return cell;
  const auto add = [&](std::string_view group, std::size_t order, std::string_view name, const AgreementBin& bin) {
    if (bin.pairs() > 0) cell.notes[fmt::format("agreement: {}{} {}", group, order, name)] = agreement_text(bin);
    cell.frames += group == "s" ? bin.pairs() : 0;
  };
  for (std::size_t k = 0; k < std::size(kSeparations); ++k) add("s", k, kSeparations[k], study.table.by_separation[k]);
  for (std::size_t k = 1; k < std::size(kDegeneracies); ++k)
    add("t", k, kDegeneracies[k], study.table.by_degeneracy[k]);
  cell.notes["agreement histogram: distance, m, from -8"] = histogram_text(study.table, &AgreementBin::error);
  cell.notes["agreement histogram: normal, rad, from -6"] = histogram_text(study.table, &AgreementBin::angle);
  return cell;
}

}  // namespace

std::string agreement_tables(const std::vector<EngineStudy>& studies) {
  std::string out;
  for (const EngineStudy& study : studies) out += (out.empty() ? "" : "\n") + study_text(study);
  return out;
}

std::string agreement_json(const std::vector<EngineStudy>& studies, std::string_view kind, std::uint64_t seed) {
  OrderedJson engines = OrderedJson::array();
  for (const EngineStudy& study : studies) {
    OrderedJson bins = OrderedJson::object();
    OrderedJson forms = OrderedJson::object();
    for (std::size_t k = 0; k < std::size(kSeparations); ++k)
      bins[std::string(kSeparations[k])] = bin_json(study.table.by_separation[k]);
    for (std::size_t k = 0; k < std::size(kDegeneracies); ++k)
      forms[std::string(kDegeneracies[k])] = bin_json(study.table.by_degeneracy[k]);
    engines.push_back({{"engine", study.label},
                       {"build", study.stamp.engine_build},
                       {"absent", study.absent},
                       {"by_separation", bins},
                       {"by_degeneracy", forms},
                       {"words", study.words},
                       {"repeat", study.repeats}});
  }
  return OrderedJson{{"format", "broadside-agreement"},    {"version", 1},      {"pairs", kind}, {"seed", seed},
                     {"touching_band_m", kTouchingBand_m}, {"engines", engines}}
      .dump(2);
}

core::Status save_agreement(const std::vector<EngineStudy>& studies, const std::filesystem::path& folder) {
  auto known = core::read_rows(folder);
  if (!known) return known.error();
  std::vector<core::Cell> cells = std::move(known.value().cells);
  for (const EngineStudy& study : studies) {
    std::erase_if(cells, [&](const core::Cell& c) {
      return c.stamp.scene_name == study.stamp.scene_name && c.stamp.label() == study.stamp.label();
    });
    cells.push_back(cell_of(study));
  }
  return core::write_cells(folder / "cells.json", cells);
}

}  // namespace broadside::bench
