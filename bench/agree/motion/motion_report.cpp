#include "bench/agree/motion/motion_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace broadside::bench {
namespace {

using OrderedJson = nlohmann::ordered_json;

double worst_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

std::string bin_text(const MotionBin& bin) {
  std::string text;
  for (std::size_t k = 0; k < kMotionVerdicts.size(); ++k)
    if (bin.count[k] > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", bin.count[k], kMotionVerdicts[k]);
  if (bin.touches() > 0)
    text +=
        fmt::format("; missed {:.3g} % of {} touches",
                    100.0 * static_cast<double>(bin.of(MotionVerdict::kMissed)) / static_cast<double>(bin.touches()),
                    bin.touches());
  if (!bin.early.empty())
    text += fmt::format("; early {:.1e} (median), {:.1e} (most)", median_of(bin.early), worst_of(bin.early));
  if (!bin.late.empty())
    text += fmt::format("; after the touch {}: {:.1e} (median), {:.1e} (most)", bin.late.size(), median_of(bin.late),
                        worst_of(bin.late));
  if (!bin.seconds.empty())
    text += fmt::format("; median {:.3g} us", 1e6 * median_of({bin.seconds.begin(), bin.seconds.end()}));
  return text;
}

OrderedJson number(double x) {
  return std::isnan(x) ? OrderedJson(nullptr) : OrderedJson(x);
}

OrderedJson bin_json(const MotionBin& bin) {
  OrderedJson counts = OrderedJson::object();
  for (std::size_t k = 0; k < kMotionVerdicts.size(); ++k)
    if (bin.count[k] > 0) counts[std::string(kMotionVerdicts[k])] = bin.count[k];
  return {{"queries", bin.tests()},
          {"touches", bin.touches()},
          {"verdicts", counts},
          {"early_median", number(median_of(bin.early))},
          {"early_most", worst_of(bin.early)},
          {"after_the_touch", bin.late.size()},
          {"late_most", worst_of(bin.late)},
          {"median_s", number(median_of({bin.seconds.begin(), bin.seconds.end()}))}};
}

}  // namespace

std::string motion_tables(MotionKind kind, const std::vector<MotionStudy>& studies) {
  const auto families = families_of(kind);
  std::string out;
  for (const MotionStudy& study : studies) {
    out += (out.empty() ? "" : "\n") + study.label + "\n";
    if (!study.absent.empty()) {
      out += "  nothing: " + study.absent + "\n";
      continue;
    }
    out += fmt::format("  {:<22} {:>8}  {}\n", "all", study.table.all.tests(), bin_text(study.table.all));
    for (std::size_t k = 0; k < families.size(); ++k)
      if (const MotionBin& bin = study.table.by_family[k]; bin.tests() > 0)
        out += fmt::format("  {:<22} {:>8}  {}\n", families[k], bin.tests(), bin_text(bin));
    for (const auto& [words, count] : study.words) out += fmt::format("  {} x {}\n", count, words);
    for (const std::string& command : study.repeats) out += "  repeat: " + command + "\n";
  }
  return out;
}

std::string motion_json(MotionKind kind, const std::vector<MotionStudy>& studies, std::uint64_t seed) {
  const auto families = families_of(kind);
  OrderedJson engines = OrderedJson::array();
  for (const MotionStudy& study : studies) {
    OrderedJson bins = OrderedJson::object();
    if (study.absent.empty())
      for (std::size_t k = 0; k < families.size(); ++k)
        bins[std::string(families[k])] = bin_json(study.table.by_family[k]);
    engines.push_back({{"engine", study.label},
                       {"build", study.build},
                       {"absent", study.absent},
                       {"all", bin_json(study.table.all)},
                       {"by_family", bins},
                       {"words", study.words},
                       {"repeat", study.repeats}});
  }
  return OrderedJson{{"format", "broadside-motion-agreement"},
                     {"version", 1},
                     {"motion", kMotionKinds[static_cast<int>(kind)]},
                     {"seed", seed},
                     {"engines", engines}}
      .dump(2);
}

}  // namespace broadside::bench
