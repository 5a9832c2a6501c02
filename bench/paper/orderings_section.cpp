// Which of the published orders hold here. Orders can be compared between two machines; absolute figures
// cannot.
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "bench/paper/measured.hpp"
#include "bench/paper/sections.hpp"
#include "datasets/published/published_figures.hpp"

namespace broadside::bench::paper {
namespace {

using datasets::published_table;
using datasets::PublishedTable;

struct Count {
  int holds = 0;
  int fails = 0;
  int open = 0;

  void add(Order order) {
    holds += order == Order::kHolds ? 1 : 0;
    fails += order == Order::kFails ? 1 : 0;
    open += order == Order::kOpen ? 1 : 0;
  }
  [[nodiscard]] int all() const { return holds + fails + open; }
  [[nodiscard]] std::string text() const {
    if (all() == 0) return "\xE2\x80\x93";
    return fmt::format("{} of {}{}", holds, all(), open > 0 ? fmt::format(" ({} not told apart)", open) : "");
  }
};

Measured theirs(const PublishedTable& table, std::size_t row, const std::string& mean, const std::string& deviation) {
  Measured m;
  m.mean = table.number(row, mean);
  if (!deviation.empty()) m.deviation = table.number(row, deviation);
  return m;
}

Measured mean_of_half(const PaperRow* row, bool is_early) {
  return measured(row, row == nullptr ? std::vector<double>{} : row->half_fps(is_early));
}

Measured megabytes(const PaperRow* row) {
  return measured(row, row == nullptr ? std::vector<double>{} : row->memory_bytes);
}

// One statement about an order: as it was published, and as it is in one place of our results.
struct Statement {
  std::string words;
  std::string_view experiment;
  std::function<Order(const PublishedTable&, std::size_t)> published;
  std::function<Order(const RowTable&, const std::string&, std::uint32_t)> ours;
};

Statement faster(std::string_view table, const std::string& quick, const std::string& slow) {
  return {quick + " is faster than " + slow, table,
          [=](const PublishedTable& t, std::size_t r) {
            return is_larger(theirs(t, r, quick + "_mean", quick + "_std"),
                             theirs(t, r, slow + "_mean", slow + "_std"));
          },
          [=](const RowTable& rows, const std::string& model, std::uint32_t count) {
            return is_larger(fps_of(rows.find(model, count, quick)), fps_of(rows.find(model, count, slow)));
          }};
}

std::vector<Statement> statements() {
  std::vector<Statement> all{faster("table5", "C", "A"), faster("table5", "B", "C")};
  all.push_back({"A < C < B", "table5",
                 [](const PublishedTable& t, std::size_t r) {
                   const auto level = [&](const std::string& l) { return theirs(t, r, l + "_mean", l + "_std"); };
                   return both(is_larger(level("C"), level("A")), is_larger(level("B"), level("C")));
                 },
                 [](const RowTable& rows, const std::string& model, std::uint32_t count) {
                   const auto level = [&](const char* l) { return fps_of(rows.find(model, count, l)); };
                   return both(is_larger(level("C"), level("A")), is_larger(level("B"), level("C")));
                 }});
  all.push_back(faster("table6", "flat", "C"));
  for (const bool is_early : {true, false}) {
    const std::string part = is_early ? "early" : "late";
    all.push_back({"octree is faster than hash, " + part, "tableA1",
                   [=](const PublishedTable& t, std::size_t r) {
                     return is_larger(theirs(t, r, part + "_octree", ""), theirs(t, r, part + "_hash", ""));
                   },
                   [=](const RowTable& rows, const std::string& model, std::uint32_t count) {
                     return is_larger(mean_of_half(rows.find(model, count, "octree"), is_early),
                                      mean_of_half(rows.find(model, count, "hash"), is_early));
                   }});
  }
  all.push_back({"octree takes more memory than hash", "memory",
                 [](const PublishedTable& t, std::size_t r) {
                   return is_larger(theirs(t, r, "octree_mean", "octree_std"), theirs(t, r, "hash_mean", "hash_std"));
                 },
                 [](const RowTable& rows, const std::string& model, std::uint32_t count) {
                   return is_larger(megabytes(rows.find(model, count, "octree")),
                                    megabytes(rows.find(model, count, "hash")));
                 }});
  all.push_back({"level 1 is faster than level 2", "figure4",
                 [](const PublishedTable& t, std::size_t r) {
                   return is_larger(theirs(t, r, "level_1", ""), theirs(t, r, "level_2", ""));
                 },
                 [](const RowTable& rows, const std::string& model, std::uint32_t count) {
                   return is_larger(fps_of(rows.find(model, count, "level 1")),
                                    fps_of(rows.find(model, count, "level 2")));
                 }});
  return all;
}

std::string_view agreement(const Count& published, const Count& ours) {
  if (ours.all() == 0) return "nothing measured";
  if (2 * ours.open >= ours.all()) return "open";
  const bool is_published = 2 * published.holds > published.all();
  const bool is_ours = 2 * ours.holds > ours.all();
  return is_published == is_ours ? "agrees" : "does not agree";
}

}  // namespace

void add_orderings(Document& document, Rows all) {
  Table table{"orderings",
              "In how many rows each order holds; two means are told apart when they differ by more than the sum of "
              "their standard deviations",
              {"order", "table", "published", "here", "verdict"},
              {}};
  for (const Statement& statement : statements()) {
    const RowTable rows(all, statement.experiment);
    if (rows.is_empty()) continue;
    Count published;
    Count ours;
    const PublishedTable& source = published_table(statement.experiment);
    for (std::size_t r = 0; r < source.rows.size(); ++r) published.add(statement.published(source, r));
    for (const auto& [model, count] : rows.places()) ours.add(statement.ours(rows, model, count));
    table.rows.push_back({{statement.words},
                          {std::string(statement.experiment)},
                          {published.text()},
                          {ours.text()},
                          {std::string(agreement(published, ours))}});
  }
  if (table.rows.empty()) return;
  document.blocks.emplace_back(Heading{"Which orders agree", "orderings"});
  document.blocks.emplace_back(std::move(table));
}

}  // namespace broadside::bench::paper
