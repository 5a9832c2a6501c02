// A contest's table as a page: verdicts, error against cost, what stands at which step, determinism, declarations.
#pragma once

#include <string>
#include <vector>

#include "bench/contest/contest_table.hpp"
#include "bench/document/document.hpp"

namespace broadside::bench::contest {

// command: repeats the contest.
Document contest_document(const ContestTable& table, const std::string& command);

// One section each, in the order of the page; they add nothing where there is nothing to show.
void add_summary(Document& document, const ContestTable& table);
void add_overview(Document& document, const ContestTable& table);
void add_causes(Document& document, const ContestTable& table);
void add_families(Document& document, const ContestTable& table);
void add_verdicts(Document& document, const ContestTable& table);
void add_error_against_cost(Document& document, const ContestTable& table);
void add_energy_over_time(Document& document, const ContestTable& table);
void add_stability(Document& document, const ContestTable& table);
void add_other_steps(Document& document, const ContestTable& table);
void add_stacks(Document& document, const ContestTable& table);
void add_passages(Document& document, const ContestTable& table);
void add_heaps(Document& document, const ContestTable& table);
void add_determinism(Document& document, const ContestTable& table);
void add_tunings(Document& document, const ContestTable& table);
void add_declarations(Document& document, const ContestTable& table);

// `first`, then a column an entrant.
std::vector<std::string> columns_of(const ContestTable& table, std::vector<std::string> first);
// Whether the engine is native code. If not, its time does not count: code in WebAssembly does not have the library's
// own speed.
bool is_native(const ContestTable& table, const std::string& label);
// "energy_rigid_bounce": letters and digits alone.
std::string file_name_of(const std::string& what, std::string scene);

}  // namespace broadside::bench::contest
