// Polynomials in t of degree at most three with integer coefficients, and their roots in [0, 1] as exact numbers.
#pragma once

#include <gmpxx.h>

#include <array>
#include <vector>

namespace broadside::exact {

struct IntegerCubic {
  std::array<mpz_class, 4> of_power;  // of_power[0] + of_power[1] t + of_power[2] t^2 + of_power[3] t^3

  [[nodiscard]] bool is_zero() const;
};

IntegerCubic operator+(const IntegerCubic& a, const IntegerCubic& b);
IntegerCubic operator-(const IntegerCubic& a, const IntegerCubic& b);
// Precondition: the sum of both degrees is at most three.
IntegerCubic operator*(const IntegerCubic& a, const IntegerCubic& b);

// One root. When exact, t = place / 2^bits. Otherwise it is the only root of the polynomial in the open interval from
// place / 2^bits to (place + 1) / 2^bits, and it is simple.
struct Root {
  IntegerCubic polynomial;
  mpz_class place;
  unsigned bits = 0;
  int sign_before = 0;  // sign of the polynomial between the interval's beginning and the root
  bool is_exact = false;
};

// All roots in the closed interval [0, 1] of a polynomial that is not zero, in no particular order.
std::vector<Root> roots_in_step(const IntegerCubic& polynomial);

// Halves the interval until it is 2^-bits wide or the root is exact.
void refine(Root& root, unsigned bits);

// -1, 0 or 1: the sign of another polynomial at the root, decided exactly. May refine the root.
int sign_at(const IntegerCubic& polynomial, Root& root);

}  // namespace broadside::exact
