#include "bench/paper/report_part.hpp"

#include <algorithm>
#include <string>

#include "bench/document/document.hpp"
#include "bench/paper/paper_row.hpp"
#include "bench/paper/sections.hpp"
#include "reports/escape.hpp"

namespace broadside::bench::paper {
namespace {

constexpr std::string_view kOctreePictures = "figureA1";

// Figure A1 has no rows: it is drawn again when the folder holds its pictures.
bool has_octree_pictures(const std::filesystem::path& folder) {
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
    if (entry.path().filename().string().starts_with(kOctreePictures)) return true;
  return false;
}

}  // namespace

core::Result<std::optional<reports::GuestPart>> report_part(const std::filesystem::path& named, const std::string& id) {
  std::error_code failed;
  const std::filesystem::path file = std::filesystem::is_directory(named, failed) ? named / "rows.json" : named;
  if (!std::filesystem::exists(file, failed)) return std::optional<reports::GuestPart>{};
  auto rows = read_paper_rows(file);
  if (!rows) return rows.error();
  PaperText text;
  text.shows_models = has_octree_pictures(file.parent_path());
  const Document document = paper_document(rows.value(), text);
  return std::optional<reports::GuestPart>{
      {id, document.title, "<p>" + reports::html(document.lead) + "</p>\n" + html_blocks(document, id + "-", 3),
       std::string(block_style())}};
}

}  // namespace broadside::bench::paper
