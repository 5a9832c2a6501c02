// Takes the place of the HTML page where it was not built; declared in report.hpp.
#include "reports/page_assets.hpp"
#include "reports/report.hpp"

namespace broadside::reports {

// The paper's own page is still written, but without the page's style.
const std::string_view kPageStyle;

bool has_html_page() {
  return false;
}

bool has_page_bundle() {
  return false;
}

std::vector<Chart> page_charts(const core::RunRows&, const ReportOptions&) {
  return {};
}

std::string html_page(const core::RunRows&, const ReportOptions&) {
  return "";
}

}  // namespace broadside::reports
