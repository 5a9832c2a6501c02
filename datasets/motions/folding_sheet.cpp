#include <algorithm>
#include <cmath>

#include "datasets/motions/motions.hpp"
#include "datasets/random.hpp"

namespace broadside::datasets {
namespace {

constexpr std::uint32_t kLayers = 8;
// In lattice cells: the distance of layers, the sheet's sideways motion, and the random shift of vertices.
constexpr double kGap = 2.0;
constexpr double kSideways = 0.5;
constexpr double kStray = 0.2;
// A layer's bulge, in gaps: two layers that meet at a crease are 2 gaps apart at their other ends, and bulge by 1.6
// together.
constexpr double kBulge = 0.8;

}  // namespace

continuous::MovingSurface folding_sheet(std::uint64_t triangles, std::uint64_t seed) {
  const auto cells = static_cast<std::uint32_t>(
      std::max(1.0, std::floor(std::sqrt(static_cast<double>(triangles) / (2.0 * kLayers)))));
  const double cell_m = 1.0 / cells;
  const double gap_m = kGap * cell_m;
  RandomStream random(core::splitmix64(seed ^ 0x736865657473ULL));
  continuous::MovingSurface sheet;
  sheet.name = "folding sheet";
  const std::uint32_t columns = kLayers * cells;
  for (std::uint32_t i = 0; i <= columns; ++i) {
    const std::uint32_t layer = std::min(i / cells, kLayers - 1);
    const double along = static_cast<double>(i - layer * cells) * cell_m;
    const bool is_crease = i % cells == 0;
    for (std::uint32_t j = 0; j <= cells; ++j) {
      // The shift stays within the layer, so that layers stay plane; creases stay straight.
      const double u = along + (is_crease ? 0.0 : cell_m * random.between(-kStray, kStray));
      const double y = j * cell_m + cell_m * random.between(-kStray, kStray);
      const double x = layer % 2 == 0 ? u : 1.0 - u;
      const double z = gap_m * (layer + u);
      const double bulge_m = kBulge * gap_m * (16.0 * x * (1.0 - x) * y * (1.0 - y));
      const double stray_m = is_crease ? 0.0 : 0.1 * cell_m * random.between(-1.0, 1.0);
      sheet.start.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
      sheet.end.push_back({static_cast<float>(x + kSideways * cell_m), static_cast<float>(y),
                           static_cast<float>(z + (layer % 2 == 0 ? bulge_m : -bulge_m) + stray_m)});
    }
  }
  for (std::uint32_t i = 0; i < columns; ++i)
    for (std::uint32_t j = 0; j < cells; ++j) {
      const std::uint32_t a = i * (cells + 1) + j;
      const std::uint32_t b = a + cells + 1;
      sheet.triangles.push_back({a, b, b + 1});
      sheet.triangles.push_back({a, b + 1, a + 1});
    }
  return sheet;
}

}  // namespace broadside::datasets
