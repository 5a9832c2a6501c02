#include "reports/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace broadside::reports {
namespace {

constexpr std::string_view kNarrowSpace = "\xE2\x80\xAF";

std::string printed(const char* format, int digits, double value) {
  std::array<char, 400> buffer;
  const int length = std::snprintf(buffer.data(), buffer.size(), format, digits, value);
  return {buffer.data(), static_cast<std::size_t>(std::clamp(length, 0, static_cast<int>(buffer.size()) - 1))};
}

void drop_trailing_zeros(std::string& text) {
  if (text.find('.') == std::string::npos) return;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
}

struct Prefix {
  double factor;
  std::string_view name;
};
constexpr std::array kPrefixes{Prefix{1e9, "G"},  Prefix{1e6, "M"},         Prefix{1e3, "k"},  Prefix{1.0, ""},
                               Prefix{1e-3, "m"}, Prefix{1e-6, "\xC2\xB5"}, Prefix{1e-9, "n"}, Prefix{1e-12, "p"}};
constexpr std::array<std::string_view, 8> kPrefixable{"m", "s", "J", "N", "N s", "rad", "m/s", "Hz"};

bool is_count(double value, std::string_view unit) {
  return (unit == "pairs" || unit == "bodies" || unit == "frames" || unit == "contacts" || unit == "vertices") &&
         value == std::floor(value) && std::abs(value) < 1e15;
}

}  // namespace

std::string figure(double value, int digits) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return value > 0 ? "infinite" : "minus infinite";
  if (value == 0.0) return "0";
  // The exponent after rounding to `digits`: 9.996 has four digits before it becomes 10.0.
  const std::string scientific = printed("%.*e", digits - 1, value);
  const int exponent = std::stoi(scientific.substr(scientific.find('e') + 1));
  if (exponent < -4 || exponent >= 9) {
    std::string mantissa = scientific.substr(0, scientific.find('e'));
    drop_trailing_zeros(mantissa);
    return mantissa + "e" + std::to_string(exponent);
  }
  std::string text = printed("%.*f", std::max(0, digits - 1 - exponent), value);
  drop_trailing_zeros(text);
  return text;
}

std::string quantity(double value, std::string_view unit, int digits) {
  if (!std::isfinite(value)) return figure(value);
  if (is_count(value, unit)) return printed("%.*f", 0, value) + " " + std::string(unit);
  if (unit.empty()) return figure(value, digits);
  if (value == 0.0 || std::find(kPrefixable.begin(), kPrefixable.end(), unit) == kPrefixable.end())
    return figure(value, digits) + " " + std::string(unit);
  for (const Prefix& prefix : kPrefixes) {
    const double scaled = value / prefix.factor;
    // Compared after rounding, so that 999.96 m with three digits becomes 1 km and not 1000 m.
    if (std::abs(std::stod(printed("%.*e", digits - 1, scaled))) < 1.0) continue;
    return figure(scaled, digits) + " " + std::string(prefix.name) + std::string(unit);
  }
  return figure(value, digits) + " " + std::string(unit);
}

Compared compared(double measured, double limit, std::string_view unit) {
  for (int digits = 3;; ++digits) {
    Compared text{quantity(measured, unit, digits), quantity(limit, unit, digits)};
    if (measured == limit || text.measured != text.limit || digits >= 17) return text;
  }
}

TimeUnit time_unit_for(double typical_s) {
  if (!(typical_s > 0.0)) return {1e3, "ms"};
  if (typical_s < 1e-6) return {1e9, "ns"};
  if (typical_s < 1e-3) return {1e6, "\xC2\xB5s"};
  if (typical_s < 1.0) return {1e3, "ms"};
  return {1.0, "s"};
}

std::string time_in(TimeUnit unit, double seconds) {
  if (!std::isfinite(seconds)) return figure(seconds);
  const double value = seconds * unit.per_second;
  // Three significant digits, but trailing zeros stay, so that a column of figures lines up.
  const double size = std::abs(value);
  if (size > 0.0 && size < 0.0005) return "<0.001";
  return printed("%.*f", size >= 99.95 ? 0 : size >= 9.995 ? 1 : size >= 0.9995 ? 2 : 3, value);
}

std::string counted(std::uint64_t count) {
  std::string text = std::to_string(count);
  if (count < 10000) return text;
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, kNarrowSpace);
  return text;
}

std::string counted(std::uint64_t count, std::string_view singular) {
  return counted(count) + " " + std::string(singular) + (count == 1 ? "" : "s");
}

std::string percent(double share) {
  if (!std::isfinite(share)) return figure(share);
  return figure(share * 100.0, 3) + " %";
}

std::string hexadecimal(std::uint64_t digest) {
  std::array<char, 19> text;
  std::snprintf(text.data(), text.size(), "0x%016llx", static_cast<unsigned long long>(digest));
  return text.data();
}

}  // namespace broadside::reports
