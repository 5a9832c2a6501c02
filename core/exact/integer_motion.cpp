#include "core/exact/integer_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace broadside::exact {
namespace {

constexpr int kDigits = std::numeric_limits<double>::digits;

// x = mantissa 2^exponent with an odd mantissa; or 0.
struct Dyadic {
  std::int64_t mantissa = 0;
  int exponent = 0;
};

Dyadic dyadic(double x) {
  if (x == 0.0) return {};
  Dyadic out;
  out.mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &out.exponent), kDigits));
  out.exponent -= kDigits;
  while (out.mantissa % 2 == 0) {
    out.mantissa /= 2;
    ++out.exponent;
  }
  return out;
}

const core::Vec3d& point_of(const continuous::MovingFeatures& features, int k) {
  return k < 4 ? features.start[k] : features.end[k - 4];
}

std::array<mpz_class, 3>& point_of(IntegerMotion& motion, int k) {
  return k < 4 ? motion.start[k] : motion.end[k - 4];
}

std::optional<mpz_class> integer(const std::string& text) {
  const std::size_t first = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  if (first == text.size() || text.find_first_not_of("0123456789", first) != std::string::npos) return std::nullopt;
  return mpz_class(text[0] == '+' ? text.substr(1) : text, 10);
}

using Fractions = std::array<std::array<mpq_class, 3>, 8>;

core::Result<Fractions> fractions(const RationalFeatures& features) {
  Fractions out;
  for (int k = 0; k < 8; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      const RationalText& text = features.points[k][axis];
      auto numerator = integer(text.numerator);
      auto denominator = integer(text.denominator);
      if (!numerator || !denominator || *denominator <= 0)
        return core::Error{"'" + text.numerator + " / " + text.denominator + "' is no fraction",
                           "point " + std::to_string(k) + ", axis " + "xyz"[axis],
                           "give two integers, the denominator above zero"};
      out[k][axis] = mpq_class(*numerator, *denominator);
      out[k][axis].canonicalize();
    }
  }
  return out;
}

// mpq's own conversion truncates; the nearest double is the result or the next one away from zero.
double nearest_double(const mpq_class& x) {
  const double cut = x.get_d();
  const double next = std::nextafter(cut, sgn(x) * std::numeric_limits<double>::infinity());
  if (!std::isfinite(cut) || !std::isfinite(next)) return cut;
  const mpq_class to_cut = abs(x - mpq_class(cut));
  const mpq_class to_next = abs(mpq_class(next) - x);
  if (to_cut == to_next) return dyadic(cut).exponent > dyadic(next).exponent ? cut : next;
  return to_cut < to_next ? cut : next;
}

}  // namespace

IntegerMotion integer_motion(const continuous::MovingFeatures& features) {
  std::array<std::array<Dyadic, 3>, 8> parts;
  int least = std::numeric_limits<int>::max();
  for (int k = 0; k < 8; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      parts[k][axis] = dyadic(point_of(features, k)[axis]);
      if (parts[k][axis].mantissa != 0) least = std::min(least, parts[k][axis].exponent);
    }
  }
  IntegerMotion out;
  out.kind = features.kind;
  for (int k = 0; k < 8; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      const Dyadic& part = parts[k][axis];
      mpz_class& x = point_of(out, k)[axis];
      x = static_cast<signed long>(part.mantissa);
      if (part.mantissa != 0) x <<= part.exponent - least;
    }
  }
  return out;
}

core::Result<IntegerMotion> integer_motion(const RationalFeatures& features) {
  auto read = fractions(features);
  if (!read) return read.error();
  mpz_class common = 1;
  for (const auto& point : read.value())
    for (const mpq_class& x : point) common = lcm(common, x.get_den());
  IntegerMotion out;
  out.kind = features.kind;
  for (int k = 0; k < 8; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      const mpq_class& x = read.value()[k][axis];
      point_of(out, k)[axis] = x.get_num() * (common / x.get_den());
    }
  return out;
}

core::Result<continuous::MovingFeatures> rounded(const RationalFeatures& features) {
  auto read = fractions(features);
  if (!read) return read.error();
  continuous::MovingFeatures out;
  out.kind = features.kind;
  for (int k = 0; k < 8; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      const double x = nearest_double(read.value()[k][axis]);
      if (!std::isfinite(x))
        return core::Error{"the coordinate is larger than any double",
                           "point " + std::to_string(k) + ", axis " + "xyz"[axis], "scale the query"};
      (k < 4 ? out.start[k] : out.end[k - 4])[axis] = x;
    }
  return out;
}

RationalFeatures to_rational(const continuous::MovingFeatures& features) {
  RationalFeatures out;
  out.kind = features.kind;
  for (int k = 0; k < 8; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      const mpq_class x(point_of(features, k)[axis]);
      out.points[k][axis] = {x.get_num().get_str(), x.get_den().get_str()};
    }
  return out;
}

}  // namespace broadside::exact
