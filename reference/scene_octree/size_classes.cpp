// The model. Boxes of a class with c members in a volume V are spaced (V / c)^(1/3) apart, so a pack of 8 is about
// twice that wide, plus its largest member. Packs of widths W and W', n and n' of them, meet n n' E[(W + W')^3] / V
// times, in expectation. In a class of mixed sizes, packs that contain a large member are wide; one more class costs
// each finer pack a walk through its tree. V is the volume of the bounds, or the sum of the boxes' own volumes where
// that is less, since then the boxes are crowded into part of the bounds.
#include "reference/scene_octree/size_classes.hpp"

#include <algorithm>
#include <cmath>

namespace broadside::reference {
namespace {

// The cost of a walk through a tree that finds nothing, in pack tests.
constexpr double kWalk = 2.0;

struct Span {
  int first_bin;
  int last_bin;
  double count;
  // Moments of a pack's width.
  double width;
  double width2;
  double width3;
};

double bin_side(int bin) {
  return std::ldexp(1.5, bin - 127);
}

class Model {
 public:
  Model(const std::array<std::uint32_t, core::kSizeBins>& histogram, double bounds_m3) : histogram_(histogram) {
    double boxes_m3 = 0.0;
    for (int bin = 0; bin < core::kSizeBins; ++bin) boxes_m3 += histogram[at(bin)] * std::pow(bin_side(bin), 3);
    volume_ = bounds_m3 > 0.0 ? std::min(bounds_m3, boxes_m3) : boxes_m3;
  }

  [[nodiscard]] Span span(int first_bin, int last_bin) const {
    Span s{first_bin, last_bin, 0.0, 0.0, 0.0, 0.0};
    for (int bin = first_bin; bin <= last_bin; ++bin) s.count += histogram_[at(bin)];
    const double spacing = 2.0 * std::cbrt(volume_ / s.count);
    double below = 0.0;
    double had = 0.0;
    for (int bin = first_bin; bin <= last_bin; ++bin) {
      if (histogram_[at(bin)] == 0) continue;
      below += histogram_[at(bin)];
      // The probability that the largest of eight boxes is in this bin or a smaller one.
      const double up_to = std::pow(below / s.count, 8);
      const double chance = up_to - had;
      had = up_to;
      const double width = spacing + bin_side(bin);
      s.width += chance * width;
      s.width2 += chance * width * width;
      s.width3 += chance * width * width * width;
    }
    return s;
  }

  // Expected pack tests between two classes, or within one.
  [[nodiscard]] double tests(const Span& a, const Span& b, bool same) const {
    const double cube = a.width3 + 3.0 * a.width2 * b.width + 3.0 * a.width * b.width2 + b.width3;
    const double packs = a.count / 8.0 * (b.count / 8.0);
    return same ? 0.5 * packs * cube / volume_ : packs * cube / volume_ + kWalk * a.count / 8.0;
  }

  [[nodiscard]] double total(const std::vector<Span>& classes) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < classes.size(); ++i)
      for (std::size_t j = i; j < classes.size(); ++j) sum += tests(classes[i], classes[j], i == j);
    return sum;
  }

 private:
  static std::size_t at(int bin) { return static_cast<std::size_t>(bin); }

  const std::array<std::uint32_t, core::kSizeBins>& histogram_;
  double volume_;
};

std::vector<Span> with_merged(const Model& model, const std::vector<Span>& classes, std::size_t k) {
  std::vector<Span> merged = classes;
  merged[k] = model.span(classes[k].first_bin, classes[k + 1].last_bin);
  merged.erase(merged.begin() + static_cast<std::ptrdiff_t>(k) + 1);
  return merged;
}

std::vector<Span> fewest_tests(const Model& model, std::vector<Span> classes) {
  double cost = model.total(classes);
  while (classes.size() > 1) {
    std::vector<Span> best;
    double best_cost = 0.0;
    for (std::size_t k = 0; k + 1 < classes.size(); ++k) {
      std::vector<Span> merged = with_merged(model, classes, k);
      const double merged_cost = model.total(merged);
      if (best.empty() || merged_cost < best_cost) {
        best = std::move(merged);
        best_cost = merged_cost;
      }
    }
    if (best_cost >= cost && classes.size() <= static_cast<std::size_t>(core::kMaxSizeClasses)) break;
    classes = std::move(best);
    cost = best_cost;
  }
  return classes;
}

}  // namespace

SizeClasses plan_size_classes(const std::array<std::uint32_t, core::kSizeBins>& histogram, double bounds_m3) {
  const Model model(histogram, bounds_m3);
  std::vector<Span> classes;
  // Trying every merge costs the cube of the number of spans: above 32 occupied bins, start from spans of a few bins.
  const auto occupied =
      core::kSizeBins - static_cast<int>(std::count(histogram.begin(), histogram.end(), std::uint32_t{0}));
  const int stride = 1 + (occupied - 1) / 32;
  for (int first = 0; first < core::kSizeBins; first += stride) {
    const int last = std::min(first + stride, core::kSizeBins) - 1;
    if (std::any_of(histogram.begin() + first, histogram.begin() + last + 1, [](std::uint32_t c) { return c > 0; }))
      classes.push_back(model.span(first, last));
  }
  if (classes.size() > 1) classes = fewest_tests(model, std::move(classes));

  SizeClasses plan;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    for (int bin = classes[k].first_bin; bin <= classes[k].last_bin; ++bin)
      plan.class_of_bin[static_cast<std::size_t>(bin)] = static_cast<std::uint8_t>(k);
    plan.counts.push_back(static_cast<std::uint32_t>(classes[k].count));
  }
  return plan;
}

}  // namespace broadside::reference
