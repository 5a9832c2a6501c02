// Beyond the paper: cost against count, fitted, and where one method becomes faster than another.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/paper/beyond_plan.hpp"
#include "bench/paper/cost_model.hpp"
#include "bench/paper/measured.hpp"
#include "bench/paper/sections.hpp"
#include "reports/plots/line_plot.hpp"

namespace broadside::bench::paper {
namespace {

// A kind of comparison: which methods, and which part of a frame.
struct Family {
  std::string name;  // "whole frame"
  std::string id;
  bool is_broad = false;

  // The stage that is compared: a stage of the pipelines, or the whole "frame" of engines that are a broad phase alone.
  [[nodiscard]] std::string stage_of(const std::string& method) const {
    return is_broad && !is_broad_only(method) ? "broad" : "frame";
  }
  // A, B and C start from boxes of levels, so their broad stage does other work and is left out.
  [[nodiscard]] bool has(const std::string& method) const {
    if (!is_broad) return !is_broad_only(method);
    return is_broad_only(method) || method == "tree" || method == "hash" || method == "flat" ||
           method == "octree, L = 2";
  }
};

const std::vector<Family>& families() {
  static const std::vector<Family> kFamilies{{"whole frame", "frame", false}, {kBroadOnly, "broad", true}};
  return kFamilies;
}

std::vector<std::string> methods_of(const RowTable& rows, const Family& family) {
  std::vector<std::string> methods;
  for (const PaperRow* row : rows.rows())
    if (family.has(row->method) && std::find(methods.begin(), methods.end(), row->method) == methods.end())
      methods.push_back(row->method);
  return methods;
}

std::vector<CostCurve> curves_of(const RowTable& rows, const std::string& model, const Family& family) {
  std::vector<CostCurve> curves;
  for (const std::string& method : methods_of(rows, family)) {
    CostCurve curve{method, {}, {}};
    for (const auto& [m, count] : rows.places()) {
      if (m != model) continue;
      const PaperRow* row = rows.find(model, count, method);
      const bool is_usable = row != nullptr && row->has_times() && row->is_admitted;
      curve.counts.push_back(count);
      curve.seconds.push_back(is_usable ? row->stage_seconds(family.stage_of(method)) : std::vector<double>{});
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

Measured milliseconds(const PaperRow* row, const Family& family) {
  std::vector<double> values;
  if (row != nullptr)
    for (const double s : row->stage_seconds(family.stage_of(row->method))) values.push_back(1e3 * s);
  return measured(row, values);
}

void add_times(Document& document, const RowTable& rows, const std::string& model, const Family& family) {
  const std::vector<std::string> methods = methods_of(rows, family);
  Table table{"beyond_" + family.id + "_" + model,
              model + ", " + family.name + ": milliseconds per frame, mean \xC2\xB1 standard deviation over runs",
              {"bodies", "frames"},
              {}};
  table.columns.insert(table.columns.end(), methods.begin(), methods.end());
  for (const auto& [m, count] : rows.places()) {
    if (m != model) continue;
    std::vector<TableCell> line{{std::to_string(count), static_cast<double>(count)}, {"\xE2\x80\x93"}};
    for (const std::string& method : methods) {
      const PaperRow* row = rows.find(model, count, method);
      line.push_back(cell_of(milliseconds(row, family)));
      if (row != nullptr) line[1] = {std::to_string(row->frames), static_cast<double>(row->frames)};
    }
    table.rows.push_back(std::move(line));
  }
  document.blocks.emplace_back(std::move(table));
}

void add_plot(Document& document, const std::string& model, const Family& family,
              const std::vector<CostCurve>& curves) {
  using reports::plots::Scale;
  reports::plots::LinePlot plot;
  plot.text = {model + ": cost against count, " + family.name, "", "bodies", "milliseconds per frame"};
  plot.x_scale = plot.y_scale = Scale::kLog;
  for (const CostCurve& curve : curves) {
    reports::plots::Curve line{.name = curve.method};
    for (std::size_t k = 0; k < curve.counts.size(); ++k) {
      std::vector<double> runs = curve.seconds[k];
      double sum = 0.0;
      for (const double s : runs) sum += s;
      const double mean_ms = runs.empty() ? kNoValue : 1e3 * sum / static_cast<double>(runs.size());
      line.x.push_back(curve.counts[k]);
      line.y.push_back(mean_ms);
      if (!runs.empty())
        plot.text.description += fmt::format("{} at {:.0f}: {:.4g} ms. ", curve.method, curve.counts[k], mean_ms);
    }
    plot.curves.push_back(std::move(line));
    const auto fit = fit_cost(curve);
    if (!fit) continue;
    reports::plots::Curve model_line{.name = "fit", .is_fitted = true};
    const double low = curve.counts.front();
    const double high = curve.counts.back();
    constexpr int kSteps = 40;
    for (int k = 0; k <= kSteps; ++k) {
      const double n = low * std::pow(high / low, static_cast<double>(k) / kSteps);
      model_line.x.push_back(n);
      model_line.y.push_back(1e3 * fit->at(n));
    }
    plot.curves.push_back(std::move(model_line));
  }
  using reports::plots::Placement;
  document.blocks.emplace_back(Figure{"beyond_" + family.id + "_" + model, svg(plot, Placement::kFile),
                                      svg(plot, Placement::kInline),
                                      model + ", " + family.name + ": measured, and dashed the fitted model."});
}

void add_fit_rows(Table& table, const std::string& model, const Family& family, const std::vector<CostCurve>& curves) {
  std::optional<CostFit> brute;
  for (const CostCurve& curve : curves)
    if (curve.method == "flat") brute = fit_cost(curve);
  for (const CostCurve& curve : curves) {
    const auto fit = fit_cost(curve);
    if (!fit) {
      table.rows.push_back({{model}, {family.name}, {curve.method}, {"too few counts"}, {""}, {""}, {""}, {""}});
      continue;
    }
    const auto depth = brute && curve.method != "flat" ? effective_depth(*brute, *fit) : std::nullopt;
    const TableCell no_depth{fit->quadratic_share() >= 0.1 ? "\xE2\x80\x93" : "quadratic term below 10 %"};
    table.rows.push_back({{model},
                          {family.name},
                          {curve.method},
                          number_cell(1e6 * fit->fixed_s, 3),
                          number_cell(1e9 * fit->linear_s, 3),
                          number_cell(1e12 * fit->quadratic_s, 3),
                          fit->is_tested() ? number_cell(100.0 * fit->worst_relative_error, 2)
                                           : TableCell{fmt::format("untested: {} counts", fit->points)},
                          depth ? number_cell(*depth, 3) : no_depth});
  }
}

void add_crossover_rows(Table& table, const std::string& model, const Family& family,
                        const std::vector<CostCurve>& curves) {
  for (const Crossover& c : crossovers(curves)) {
    std::string interval = "too few runs";
    if (c.low) interval = fmt::format("{:.0f} to {:.0f}", *c.low, *c.high);
    table.rows.push_back({{model},
                          {family.name},
                          {c.late + " overtakes " + c.early},
                          {fmt::format("{:.0f}", c.count), c.count},
                          {interval},
                          c.low ? number_cell(100.0 * c.share, 3) : TableCell{"\xE2\x80\x93"}});
  }
}

}  // namespace

void add_beyond(Document& document, Rows all) {
  const RowTable rows(all, "beyond");
  if (rows.is_empty()) return;
  document.blocks.emplace_back(Heading{"Beyond the paper: cost against count", "beyond"});
  document.blocks.emplace_back(
      Paragraph{"Random move at rising counts. Whole frames are those of the pipelines. A broad phase alone was fed "
                "with the boxes of the same frames, as octree-cpu recorded them; its time is update, find and filter, "
                "and stands beside the broad "
                "stage of the pipelines."});
  Table fits{"beyond_fits",
             "Fitted cost t(N) = a + b N + c N^2; L: the depth for which c of flat over c of this is 8^L, as in the "
             "published O(N + N^2 / 8^L)",
             {"model", "part", "method", "a, us", "b, ns", "c, ps", "worst error, %", "L"},
             {}};
  Table crossings{"beyond_crossovers",
                  "Where one method overtakes another: straight lines in log-log between measured counts; 95 % "
                  "bootstrap interval over runs, and in how many of the resampled curves they cross there",
                  {"model", "part", "crossover", "bodies", "95 % interval", "crosses, %"},
                  {}};
  std::vector<std::string> models;
  for (const auto& place : rows.places())
    if (std::find(models.begin(), models.end(), place.first) == models.end()) models.push_back(place.first);
  for (const std::string& model : models) {
    for (const Family& family : families()) {
      const std::vector<CostCurve> curves = curves_of(rows, model, family);
      add_times(document, rows, model, family);
      add_plot(document, model, family, curves);
      add_fit_rows(fits, model, family, curves);
      add_crossover_rows(crossings, model, family, curves);
    }
  }
  if (crossings.rows.empty()) crossings.rows.push_back({{"none"}, {""}, {"none in this range"}, {""}, {""}, {""}});
  document.blocks.emplace_back(std::move(crossings));
  document.blocks.emplace_back(std::move(fits));
  document.blocks.emplace_back(Notes{reasons(rows)});
}

}  // namespace broadside::bench::paper
