#include "datasets/box_streams/box_kind.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <vector>

#include "datasets/box_streams/box_of.hpp"
#include "datasets/cube_root.hpp"

namespace broadside::datasets {
namespace {

using core::Box;

constexpr std::size_t kMostLookedAt = 100'000;
constexpr double kThin = 16.0;
constexpr double kBoxesACell = 8.0;

double middle_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Triple center_of(const Box& b) {
  Triple center;
  for (int k = 0; k < 3; ++k)
    center[static_cast<std::size_t>(k)] = 0.5 * (static_cast<double>(b.min[k]) + static_cast<double>(b.max[k]));
  return center;
}

// Cubic cells over the bounds of the centers; a world that is flat or a line has only a plane or a row of cells.
double cells_of_half(const std::vector<Triple>& centers) {
  Triple low = centers[0];
  Triple high = centers[0];
  for (const Triple& c : centers)
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], c[k]), high[k] = std::max(high[k], c[k]);
  const double wanted = std::max(1.0, static_cast<double>(centers.size()) / kBoxesACell);
  // Finds the cell width at which the world has the wanted number of cells. Uses bisection, because each axis has at
  // least one cell.
  const double widest = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  if (!(widest > 0.0)) return 1.0;
  const auto cells = [&](double width, std::size_t k) { return std::floor((high[k] - low[k]) / width) + 1.0; };
  const auto all_cells = [&](double width) { return cells(width, 0) * cells(width, 1) * cells(width, 2); };
  double fine = widest / (wanted + 1.0);
  double coarse = 2.0 * widest;
  for (int step = 0; step < 60; ++step) {
    const double between = 0.5 * (fine + coarse);
    (all_cells(between) > wanted ? fine : coarse) = between;
  }
  std::vector<double> cell_of;
  cell_of.reserve(centers.size());
  for (const Triple& c : centers) {
    double cell = 0.0;
    for (std::size_t k = 0; k < 3; ++k) cell = cell * cells(coarse, k) + std::floor((c[k] - low[k]) / coarse);
    cell_of.push_back(cell);
  }
  std::sort(cell_of.begin(), cell_of.end());
  std::vector<std::size_t> counts;
  for (std::size_t k = 0; k < cell_of.size();) {
    const std::size_t begin = k;
    while (k < cell_of.size() && cell_of[k] == cell_of[begin]) ++k;
    counts.push_back(k - begin);
  }
  std::sort(counts.begin(), counts.end(), std::greater<>());
  std::size_t held = 0;
  std::size_t fullest = 0;
  while (2 * held < centers.size()) held += counts[fullest++];
  return static_cast<double>(fullest) / all_cells(coarse);
}

}  // namespace

double BoxKind::size_ratio() const {
  if (least_m > 0.0) return most_m / least_m;
  return most_m > 0.0 ? std::numeric_limits<double>::infinity() : 1.0;
}

BoxKind kind_of(std::span<const Box> boxes) {
  BoxKind kind;
  kind.boxes = boxes.size();
  if (boxes.empty()) return kind;
  const std::size_t stride = (boxes.size() + kMostLookedAt - 1) / kMostLookedAt;
  std::vector<double> longest;
  std::vector<double> flatness;
  std::vector<Triple> centers;
  std::size_t thin = 0;
  for (std::size_t i = 0; i < boxes.size(); i += stride) {
    double most = 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const double side = static_cast<double>(boxes[i].max[k]) - static_cast<double>(boxes[i].min[k]);
      most = std::max(most, side);
      least = std::min(least, side);
    }
    longest.push_back(most);
    flatness.push_back(most > 0.0 ? least / most : 1.0);
    thin += kThin * least < most ? 1 : 0;
    centers.push_back(center_of(boxes[i]));
  }
  const auto [least, most] = std::minmax_element(longest.begin(), longest.end());
  kind.least_m = *least;
  kind.most_m = *most;
  kind.median_m = middle_of(longest);
  kind.flatness = middle_of(flatness);
  kind.thin_share = static_cast<double>(thin) / static_cast<double>(centers.size());
  kind.cells_of_half = cells_of_half(centers);
  return kind;
}

std::string words_of(const BoxKind& kind, double pairs_a_box) {
  char text[400];
  std::snprintf(
      text, sizeof text,
      "%llu boxes, longest side %.3g to %.3g m (median %.3g), shortest to longest %.2g (median), %.3g %% over 16 "
      "times longer than thick, half of all boxes in %.3g %% of the world's cells, %.3g pairs a box",
      static_cast<unsigned long long>(kind.boxes), kind.least_m, kind.most_m, kind.median_m, kind.flatness,
      100.0 * kind.thin_share, 100.0 * kind.cells_of_half, pairs_a_box);
  return text;
}

}  // namespace broadside::datasets
