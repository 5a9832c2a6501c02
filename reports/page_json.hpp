// JSON inside an HTML page.
#pragma once

#include <string>
#include <string_view>

namespace broadside::reports {

// The same JSON with every "<", ">" and "&" as an escape: nothing in it can end the script element that holds it.
std::string script_safe(std::string_view json);

// To four significant digits, more than a chart can show; whole numbers stay exact, and what is not finite stays so
// (null in JSON).
double short_number(double value);

}  // namespace broadside::reports
