#include "reports/page_json.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace broadside::reports {

std::string script_safe(std::string_view json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    // In JSON these occur only inside strings, where an escape means the same.
    if (c == '<')
      safe += "\\u003c";
    else if (c == '>')
      safe += "\\u003e";
    else if (c == '&')
      safe += "\\u0026";
    else
      safe += c;
  }
  return safe;
}

double short_number(double value) {
  if (!std::isfinite(value) || value == std::floor(value)) return value;  // steps and counts stay exact
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return std::strtod(text, nullptr);
}

}  // namespace broadside::reports
