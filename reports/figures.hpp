// Numbers as people read them: few digits, SI prefixes, and words where there is no number.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace broadside::reports {

// `digits` significant digits, no exponent from 1e-4 to 1e9, no trailing zeros; "not a number", "infinite".
std::string figure(double value, int digits = 3);

// With the unit: 0.00123 "m" -> "1.23 mm". Prefixes for m, s, J, N, N s, rad, m/s, kg m/s is left as it is. An empty
// unit gives the bare number. Units that count things ("pairs", "bodies") print whole numbers whole.
std::string quantity(double value, std::string_view unit, int digits = 3);

// Two compared quantities, with as many digits as are needed to see that they differ.
struct Compared {
  std::string measured;
  std::string limit;
};
Compared compared(double measured, double limit, std::string_view unit);

// A unit of time for a whole table: seconds scaled by one power of ten, so that columns can be compared downwards.
struct TimeUnit {
  double per_second;
  std::string_view name;  // "ms"
};
TimeUnit time_unit_for(double typical_s);
std::string time_in(TimeUnit unit, double seconds);  // the number alone; "<0.001" for what would print as 0

std::string counted(std::uint64_t count);  // thousands apart: "12 345", narrow no-break spaces
std::string counted(std::uint64_t count, std::string_view singular);  // "1 cell", "3 cells"
std::string percent(double share);                                    // 0.1234 -> "12.3 %"
std::string hexadecimal(std::uint64_t digest);                        // "0x" + 16 digits

}  // namespace broadside::reports
