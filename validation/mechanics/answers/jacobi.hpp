// Jacobi's elliptic functions, for the free turning of a body.
#pragma once

namespace broadside::validation {

struct Jacobi {
  double sn = 0.0;
  double cn = 1.0;
  double dn = 1.0;
};

// Of the modulus k with parameter m = k^2, 0 <= m < 1, by the arithmetic-geometric mean (Abramowitz and Stegun,
// Handbook of Mathematical Functions, 16.4).
Jacobi jacobi(double u, double m);

// The quarter period K(k), by the same mean (17.6).
double quarter_period(double m);

// The u with sn(u) = sin(phi) and cn(u) = cos(phi), by Carlson's duplication of R_F (Numerical computation of real or
// complex elliptic integrals, 1995). Any phi, rad.
double elliptic_f(double phi, double m);

}  // namespace broadside::validation
