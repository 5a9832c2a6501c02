#include "core/exact/integer_cubic.hpp"

#include <algorithm>
#include <utility>

namespace broadside::exact {
namespace {

// Roots that are still in one interval of this width are more likely one double root than two roots. Then the common
// divisor with the derivative is divided out. Any other depth gives the same roots.
constexpr unsigned kDoubtfulBits = 24;
// Signs are first tried by intervals down to this width, before the common divisor is computed.
constexpr unsigned kTriedBits = 16;

int degree(const IntegerCubic& p) {
  for (int k = 3; k > 0; --k)
    if (p.of_power[k] != 0) return k;
  return 0;
}

// 2^(3 bits) p((place + s) / 2^bits) as a polynomial in s.
IntegerCubic within(const IntegerCubic& p, const mpz_class& place, unsigned bits) {
  IntegerCubic out = p;
  for (int k = 0; k < 4; ++k) out.of_power[k] <<= mp_bitcnt_t{bits} * static_cast<unsigned>(3 - k);
  // Horner's scheme, three times: the Taylor shift by place.
  if (place != 0)
    for (int first = 0; first < 3; ++first)
      for (int k = 2; k >= first; --k) out.of_power[k] += place * out.of_power[k + 1];
  return out;
}

// Three times the Bernstein coefficients on [0, 1]: they enclose the values.
std::array<mpz_class, 4> bernstein(const IntegerCubic& p) {
  const auto& c = p.of_power;
  return {3 * c[0], 3 * c[0] + c[1], 3 * c[0] + 2 * c[1] + c[2], 3 * (c[0] + c[1] + c[2] + c[3])};
}

// Descartes: the number of roots in the open interval is at most this, and differs from it by an even number.
int sign_changes(const std::array<mpz_class, 4>& b) {
  int changes = 0;
  int before = 0;
  for (const mpz_class& x : b) {
    const int now = sgn(x);
    if (now != 0 && before != 0 && now != before) ++changes;
    if (now != 0) before = now;
  }
  return changes;
}

int first_sign(const std::array<mpz_class, 4>& b) {
  for (const mpz_class& x : b)
    if (x != 0) return sgn(x);
  return 0;
}

int sign_at_fraction(const IntegerCubic& p, const mpz_class& place, unsigned bits) {
  mpz_class value = p.of_power[3];
  for (int k = 2; k >= 0; --k)
    value = value * place + (p.of_power[k] << (mp_bitcnt_t{bits} * static_cast<unsigned>(3 - k)));
  return sgn(value);
}

void make_primitive(IntegerCubic& p) {
  mpz_class common = 0;
  for (const mpz_class& c : p.of_power) common = gcd(common, c);
  if (common > 1)
    for (mpz_class& c : p.of_power) c /= common;
}

// Polynomial remainder: a times some power of b's leading coefficient, minus a multiple of b; its degree is lower than
// b's.
IntegerCubic remainder(IntegerCubic a, const IntegerCubic& b) {
  const int low = degree(b);
  for (int k = degree(a); k >= low; --k) {
    const mpz_class lead = a.of_power[k];
    for (mpz_class& c : a.of_power) c *= b.of_power[low];
    for (int i = 0; i <= low; ++i) a.of_power[k - low + i] -= lead * b.of_power[i];
  }
  make_primitive(a);
  return a;
}

IntegerCubic common_divisor(IntegerCubic a, IntegerCubic b) {
  make_primitive(a);
  make_primitive(b);
  if (degree(a) < degree(b)) std::swap(a, b);
  while (!b.is_zero()) {
    if (degree(b) == 0) return b;
    a = remainder(std::move(a), b);
    std::swap(a, b);
  }
  return a;
}

// Precondition: the division is exact; both are primitive.
IntegerCubic quotient(IntegerCubic a, const IntegerCubic& b) {
  IntegerCubic out;
  const int low = degree(b);
  for (int k = degree(a); k >= low; --k) {
    mpz_class& q = out.of_power[k - low];
    q = a.of_power[k] / b.of_power[low];
    for (int i = 0; i <= low; ++i) a.of_power[k - low + i] -= q * b.of_power[i];
  }
  return out;
}

IntegerCubic derivative(const IntegerCubic& p) {
  return {{p.of_power[1], 2 * p.of_power[2], 3 * p.of_power[3], 0}};
}

Root exact_root(const IntegerCubic& p, const mpz_class& place, unsigned bits) {
  return {p, place, bits, 0, true};
}

// Returns false when roots are too close to separate.
bool isolate(const IntegerCubic& p, const mpz_class& place, unsigned bits, unsigned most_bits,
             std::vector<Root>& roots) {
  const auto b = bernstein(within(p, place, bits));
  const int changes = sign_changes(b);
  if (changes == 0) return true;
  if (changes == 1) {
    roots.push_back({p, place, bits, first_sign(b), false});
    return true;
  }
  if (bits == most_bits) return false;
  const mpz_class middle = 2 * place + 1;
  if (sign_at_fraction(p, middle, bits + 1) == 0) roots.push_back(exact_root(p, middle, bits + 1));
  return isolate(p, 2 * place, bits + 1, most_bits, roots) && isolate(p, middle, bits + 1, most_bits, roots);
}

}  // namespace

bool IntegerCubic::is_zero() const {
  return std::all_of(of_power.begin(), of_power.end(), [](const mpz_class& c) { return c == 0; });
}

IntegerCubic operator+(const IntegerCubic& a, const IntegerCubic& b) {
  IntegerCubic out;
  for (int k = 0; k < 4; ++k) out.of_power[k] = a.of_power[k] + b.of_power[k];
  return out;
}

IntegerCubic operator-(const IntegerCubic& a, const IntegerCubic& b) {
  IntegerCubic out;
  for (int k = 0; k < 4; ++k) out.of_power[k] = a.of_power[k] - b.of_power[k];
  return out;
}

IntegerCubic operator*(const IntegerCubic& a, const IntegerCubic& b) {
  IntegerCubic out;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; i + k < 4; ++k)
      if (a.of_power[i] != 0 && b.of_power[k] != 0) out.of_power[i + k] += a.of_power[i] * b.of_power[k];
  return out;
}

std::vector<Root> roots_in_step(const IntegerCubic& polynomial) {
  IntegerCubic p = polynomial;
  for (unsigned most_bits = kDoubtfulBits;; most_bits = ~0U) {
    std::vector<Root> roots;
    for (const int end : {0, 1})
      if (sign_at_fraction(p, end, 0) == 0) roots.push_back(exact_root(p, end, 0));
    if (isolate(p, 0, 0, most_bits, roots)) return roots;
    make_primitive(p);
    p = quotient(p, common_divisor(p, derivative(p)));
  }
}

void refine(Root& root, unsigned bits) {
  while (!root.is_exact && root.bits < bits) {
    root.place = 2 * root.place + 1;
    ++root.bits;
    const int sign = sign_at_fraction(root.polynomial, root.place, root.bits);
    root.is_exact = sign == 0;
    if (sign == -root.sign_before) --root.place;
  }
}

int sign_at(const IntegerCubic& polynomial, Root& root) {
  const unsigned tried = root.bits + kTriedBits;
  bool is_surely_other = false;
  for (;;) {
    if (root.is_exact) return sign_at_fraction(polynomial, root.place, root.bits);
    const auto b = bernstein(within(polynomial, root.place, root.bits));
    const auto [least, most] = std::minmax_element(b.begin(), b.end());
    if (*least > 0 || *most < 0) return sgn(*least);
    if (!is_surely_other && root.bits >= tried) {
      // A common root of both is a root of their common divisor. The divisor has no other root in the interval.
      const IntegerCubic common = common_divisor(polynomial, root.polynomial);
      if (sign_changes(bernstein(within(common, root.place, root.bits))) % 2 != 0) return 0;
      is_surely_other = true;
    }
    refine(root, root.bits + 4);
  }
}

}  // namespace broadside::exact
