// The parts of the paper's report, each made from the rows that it shows. A part without rows adds nothing.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/document/document.hpp"
#include "bench/paper/paper_row.hpp"
#include "core/result.hpp"

namespace broadside::bench::paper {

using Rows = std::span<const PaperRow>;

void add_table5(Document& document, Rows rows);
void add_table6(Document& document, Rows rows);
void add_figure4(Document& document, Rows rows);
void add_table_a1(Document& document, Rows rows);  // and Figure 5
void add_memory(Document& document, Rows rows);
void add_figure_a2(Document& document, Rows rows);
void add_beyond(Document& document, Rows rows);
// Which of the published orders hold here, counted.
void add_orderings(Document& document, Rows rows);
// E9 to E12, computed from the published figures and from ours.
void add_errata(Document& document, Rows rows);

// The sentences of add_errata, for tests.
std::vector<std::string> errata_notes(Rows rows);

// Figure A1: these meshes with the boxes of the three levels of their octrees. A mesh that is not on this machine is a
// sentence that says so.
void add_figure_a1(Document& document, const std::vector<std::string>& models, bool allow_stand_in);

struct PaperText {
  std::string device;   // what ran, in a sentence
  std::string command;  // that made it
  bool shows_models = false;
  std::vector<std::string> models;  // of Figure A1; empty = the default three
  bool allow_stand_in = false;
};

// The whole report.
Document paper_document(Rows rows, const PaperText& text);

// One line per cell, for cells.csv.
Table cell_table(Rows rows);

}  // namespace broadside::bench::paper
