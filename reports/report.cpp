#include "reports/report.hpp"

#include "core/whole_file.hpp"

namespace broadside::reports {

core::Status write_html(const core::RunRows& rows, const ReportOptions& options, const std::filesystem::path& file) {
  if (!has_html_page())
    return core::Error{"this build has no HTML report (BROADSIDE_REPORT_HTML=OFF)", file.string(),
                       "write Markdown, JUnit or JSON, or build with -DBROADSIDE_REPORT_HTML=ON"};
  return core::write_whole_file(file, html_page(rows, options));
}

core::Status write_markdown(const core::RunRows& rows, const ReportOptions& options,
                            const std::filesystem::path& file) {
  return core::write_whole_file(file, markdown_text(rows, options));
}

core::Status write_junit(const core::RunRows& rows, const ReportOptions& options, const std::filesystem::path& file) {
  return core::write_whole_file(file, junit_xml(rows, options));
}

}  // namespace broadside::reports
