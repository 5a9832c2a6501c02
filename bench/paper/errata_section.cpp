// The errata about reporting, E9 to E12 of METHOD 10: what the paper says of its own figures, computed from them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bench/paper/measured.hpp"
#include "bench/paper/sections.hpp"
#include "datasets/published/published_figures.hpp"

namespace broadside::bench::paper {
namespace {

using datasets::published_table;
using datasets::PublishedTable;

std::size_t claim(std::string_view erratum) {
  const PublishedTable& claims = published_table("claims");
  for (std::size_t r = 0; r < claims.rows.size(); ++r)
    if (claims.text(r, "erratum") == erratum) return r;
  return 0;
}

// In how many of our rows each method is the fastest of all, by more than the deviations.
std::string fastest_here(const RowTable& rows, const std::vector<std::string>& methods) {
  if (rows.is_empty()) return "";
  std::string text = " Here:";
  for (const std::string& method : methods) {
    int leads = 0;
    for (const auto& [model, count] : rows.places()) {
      const Measured own = fps_of(rows.find(model, count, method));
      bool is_first = own.is_usable();
      for (const std::string& other : methods)
        if (other != method)
          is_first = is_first && is_larger(own, fps_of(rows.find(model, count, other))) == Order::kHolds;
      leads += is_first ? 1 : 0;
    }
    text += fmt::format("{} {} leads in {}", method == methods.front() ? "" : ",", method, leads);
  }
  return text + fmt::format(" of {} rows.", rows.places().size());
}

std::string e9(Rows all) {
  const PublishedTable& t = published_table("table5");
  const PublishedTable& claims = published_table("claims");
  const std::size_t said = claim("E9");
  const std::string level = claims.text(said, "column");
  int others_lead = 0;
  for (std::size_t r = 0; r < t.rows.size(); ++r) others_lead += t.number(r, "B_mean") > t.number(r, level + "_mean");
  return fmt::format("E9: the {} calls {} the {}; in its own figures B is faster than {} in {} of {} rows.{}",
                     claims.text(said, "where"), level, claims.text(said, "value"), level, others_lead, t.rows.size(),
                     fastest_here(RowTable(all, "table5"), {"A", "B", "C"}));
}

std::string e10() {
  const PublishedTable& t = published_table("tableA1");
  std::string text =
      "E10: P-Table A1 divides the gain by the octree's FPS, P-Table 6 the change by the baseline's. Over the hash, "
      "the baseline, the late gains are";
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const double hash = t.number(r, "late_hash");
    const double octree = t.number(r, "late_octree");
    text += fmt::format("{} {} {:+.1f} % (printed {:.2f} %; divided by the octree's {:.2f} %)", r == 0 ? "" : ",",
                        t.text(r, "model"), change_percent(octree, hash), t.number(r, "late_printed_rcr_percent"),
                        100.0 * (octree - hash) / octree);
  }
  return text + ". Gains in this report divide by the baseline.";
}

std::string e11(Rows all) {
  const PublishedTable& claims = published_table("claims");
  const std::size_t said = claim("E11");
  const std::string model = claims.text(said, "model");
  const auto count = static_cast<std::uint32_t>(claims.number(said, "instances"));
  const double value = claims.number(said, "value");
  const PublishedTable& t5 = published_table("table5");
  const PublishedTable& t6 = published_table("table6");
  std::string whose = "no level's figure";
  if (const auto row = t5.find(model, count))
    for (const std::string level : {"A", "B", "C"})
      if (t5.number(*row, level + "_mean") == value) whose = level + "'s figure in P-Table 5";
  int flat_leads = 0;
  for (std::size_t r = 0; r < t6.rows.size(); ++r) flat_leads += t6.number(r, "flat_mean") > t6.number(r, "C_mean");
  const auto row = t6.find(model, count);
  return fmt::format(
      "E11: {} gives {:g} FPS as flat for {} {} bodies; that is {}, and flat is {:g}. Flat is faster than C in {} of "
      "{} rows of P-Table 6.{}",
      claims.text(said, "where"), value, count, model, whose, row ? t6.number(*row, "flat_mean") : std::nan(""),
      flat_leads, t6.rows.size(), fastest_here(RowTable(all, "table6"), {"flat", "C"}));
}

std::string e12() {
  const PublishedTable& t = published_table("table6");
  std::string text;
  int differing = 0;
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const double change = change_percent(t.number(r, "C_mean"), t.number(r, "flat_mean"));
    const double printed = t.number(r, "printed_change_percent");
    // The paper prints one digit, so half a unit of it is allowed, and a little more because decimal figures are not
    // exact in binary.
    if (std::abs(change - printed) <= 0.05 + 1e-9) continue;
    ++differing;
    text += fmt::format("{} {} {} prints {:.1f} % where its figures give {:.2f} %", text.empty() ? "" : ",",
                        t.text(r, "model"), t.text(r, "instances"), printed, change);
  }
  return fmt::format("E12: changes in P-Table 6 that disagree with its own figures: {} of {}:{}.", differing,
                     t.rows.size(), text);
}

}  // namespace

std::vector<std::string> errata_notes(Rows rows) {
  return {e9(rows), e10(), e11(rows), e12()};
}

void add_errata(Document& document, Rows rows) {
  document.blocks.emplace_back(Heading{"Where the paper's report contradicts its figures", "errata"});
  document.blocks.emplace_back(Notes{errata_notes(rows)});
}

}  // namespace broadside::bench::paper
