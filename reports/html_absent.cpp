// Stands in for the HTML page where it was not built; declared in report.hpp.
#include "reports/report.hpp"

namespace broadside::reports {

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
