// The look of plots, as CSS: one palette, light and dark.
#pragma once

#include <string>

namespace broadside::reports::plots {

inline constexpr int kSeriesColors = 8;

// For a page with plots inside (Placement::kInline). It uses the page's variables --ink, --soft, --line, --paper,
// --fail and --s0 to --s7, as reports/page/report.css defines them.
std::string plot_style();

// The same with the values of those variables, for a file without a page.
std::string file_style();

}  // namespace broadside::reports::plots
