// The style and the script of the HTML report: page/report.css and page/report.js, compiled in.
#pragma once

#include <string_view>

namespace broadside::reports {

extern const std::string_view kPageStyle;
extern const std::string_view kPageScript;

}  // namespace broadside::reports
