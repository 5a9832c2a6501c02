// An axis: where values lie on it, and which of them are labelled.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace broadside::reports::plots {

enum class Scale { kLinear, kLog };

struct Tick {
  double value = 0.0;
  std::string label;
};

class Axis {
 public:
  // An axis that contains every finite value (every positive one on a log scale), extended to round numbers. Without
  // any value it goes from 0 to 1 (1 to 10). from_zero also includes 0, on a linear scale.
  Axis(Scale scale, std::span<const double> values, bool from_zero);

  // The place along the axis: 0 at its low end, 1 at its high end; NaN for a value without a place (0 on a log scale).
  [[nodiscard]] double share(double value) const;
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }
  // Linear: steps of 1, 2 or 5 times a power of ten. Log: powers of ten, with 2 and 5 where there are few of them.
  [[nodiscard]] const std::vector<Tick>& ticks() const { return ticks_; }

 private:
  void make_linear(double low, double high);
  void make_log(double low, double high);

  Scale scale_;
  double low_ = 0.0;
  double high_ = 1.0;
  std::vector<Tick> ticks_;
};

// "0.25", "1500", and from 10 000 on with thousands apart.
std::string tick_label(double value);

}  // namespace broadside::reports::plots
