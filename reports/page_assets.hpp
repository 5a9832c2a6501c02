// The style and the script of the HTML report, compiled in: page/report.css, and page/*.js as one file.
#pragma once

#include <string_view>

namespace broadside::reports {

extern const std::string_view kPageStyle;
extern const std::string_view kPageScript;
// Charts and the 3-D view are part of the script: false where npm could not provide them, and the script is
// page/comfort.js alone.
extern const bool kPageHasBundle;

}  // namespace broadside::reports
