// A large table as small squares: so many that words would not fit a screen.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/document/tone.hpp"

namespace broadside::bench {

struct Square {
  Tone tone = Tone::kPlain;
  bool is_open = false;  // a bad one whose cause nobody knows: it stands out
  std::string mark;      // a character or two, so that no state is told by color alone
  std::string words;     // what a pointer that rests on it, or a reader of screens, is told
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

// A table whose column heads stand upright, and its legend.
std::string html_of(const Mosaic& mosaic);
std::string_view mosaic_style();
// A line of marks a row, as wide as there are columns.
std::string markdown_of(const Mosaic& mosaic);

}  // namespace broadside::bench
