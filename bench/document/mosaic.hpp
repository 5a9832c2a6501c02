// A large table as small squares, for so many cells that words would not fit a screen.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/document/tone.hpp"

namespace broadside::bench {

struct Square {
  Tone tone = Tone::kPlain;
  bool is_open = false;  // a bad one of unknown cause: it stands out
  std::string mark;      // a character or two, so that no state is told by color alone
  std::string words;     // what a tooltip shows and a screen reader reads
  std::string target;    // the anchor on this page that says more; empty = none
};

struct MosaicColumn {
  std::string name;
  std::string target;         // likewise
  bool starts_group = false;  // a little apart from the column before
};

struct MosaicRow {
  std::string name;
  std::vector<Square> squares;  // one a column
};

struct Mosaic {
  std::string caption;
  std::vector<MosaicColumn> columns;
  std::vector<MosaicRow> rows;
  std::vector<Square> legend;  // `words` stand beside each
};

// An HTML table with upright column heads, and its legend.
std::string html_of(const Mosaic& mosaic);
std::string_view mosaic_style();
// One line of marks for each row, with one mark for each column.
std::string markdown_of(const Mosaic& mosaic);

}  // namespace broadside::bench
