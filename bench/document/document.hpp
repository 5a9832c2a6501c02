// A page of headings, sentences, tables and pictures, and the three ways to write it: HTML, Markdown, CSV.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bench/document/mosaic.hpp"
#include "bench/document/tone.hpp"
#include "core/result.hpp"

namespace broadside::bench {

struct TableCell {
  std::string text;  // as people read it
  // For CSV: the number behind the text, and its standard deviation where it has one. NaN = the text itself.
  double value = std::numeric_limits<double>::quiet_NaN();
  double deviation = std::numeric_limits<double>::quiet_NaN();
  bool is_struck = false;  // a time without proof
  Tone tone = Tone::kPlain;
  bool is_words = false;  // a sentence: set to the left, and wrapped
};

struct Table {
  std::string name;  // of the CSV file: "table5"
  std::string caption;
  std::vector<std::string> columns;
  std::vector<std::vector<TableCell>> rows;
};

struct Heading {
  std::string text;
  std::string id;  // of the anchor
};

struct Paragraph {
  std::string text;
};

struct Notes {
  std::vector<std::string> items;
  std::vector<std::string> ids = {};  // of the items' anchors; an empty one = it has none
};

struct Figure {
  std::string name;  // of the SVG file: "figure5_bunny"
  std::string file_svg;
  std::string inline_svg;
  std::string caption;
};

struct Fold;
using Block = std::variant<Heading, Paragraph, Notes, Table, Figure, Mosaic, Fold>;

// Blocks behind a heading that opens them. On paper a closed fold is only its heading, unless its blocks are printed.
struct Fold {
  std::string summary;
  std::string id;  // of the anchor
  bool is_printed = false;
  std::vector<Block> blocks;
};

struct Document {
  std::string title;
  std::string lead;  // the result in a sentence or two
  std::vector<Block> blocks;
};

// Self-contained; light and dark; fetches nothing.
std::string html_text(const Document& document);
// The same without the page around it, to be put into another page: headings one level lower, and every id begins with
// `prefix`.
std::string html_blocks(const Document& document, const std::string& prefix, int heading_level);
// The style that these blocks need in addition to the report's own.
std::string_view block_style();
// Pictures are named as SVG files that lie beside the text.
std::string markdown_text(const Document& document);
// A column of means gets a second one, NAME_std.
std::string csv_text(const Table& table);

// FOLDER/NAME.html, NAME.md, one SVG per figure and one CSV per table, folded ones too; each appears whole.
core::Status write_document(const Document& document, const std::filesystem::path& folder, const std::string& name);

}  // namespace broadside::bench
