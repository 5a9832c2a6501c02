// How long cells of a contest take: as an earlier contest measured them, and how much of that this contest has left.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "bench/campaign/manifest.hpp"
#include "core/result.hpp"

namespace broadside::bench::contest {

// Recording, judging and timing of a cell, in seconds of the clock. Text: a line a cell,
// "seconds<tab>scene<tab>engine"; lines that begin with '#' say where they come from.
class CellSeconds {
 public:
  static core::Result<CellSeconds> parse(const std::string& text, const std::string& where);
  // FOLDER/seconds.tsv; none there = nothing known.
  static core::Result<CellSeconds> read(const std::filesystem::path& folder);
  // What was kept of a whole contest, compiled in.
  static CellSeconds kept();

  void set(const std::string& scene, const std::string& engine, double seconds);
  // origin: where they come from, a line.
  [[nodiscard]] core::Status write(const std::filesystem::path& folder, const std::string& origin) const;

  [[nodiscard]] bool knows(const std::string& scene, const std::string& engine) const;
  // As measured; else the mean of this scene, else of all scenes; 0 where nothing is known.
  [[nodiscard]] double expected(const std::string& scene, const std::string& engine) const;
  [[nodiscard]] const std::string& origin() const { return origin_; }

 private:
  struct Sum {
    double seconds = 0.0;
    double cells = 0.0;
  };
  std::map<std::pair<std::string, std::string>, double> seconds_;
  std::map<std::string, Sum> by_scene_;
  Sum all_;
  std::string origin_;  // what the lines with '#' say
};

// The time that unfinished cells will take, scaled by the pace of those that this call finished: a busy or slower
// machine takes longer for each, by about the same factor.
class Forecast {
 public:
  Forecast(const CellSeconds& known, const campaign::Manifest& manifest, const std::filesystem::path& folder);
  void finish(const campaign::CellWork& work, double seconds);
  [[nodiscard]] double left_s(std::uint32_t jobs) const;

 private:
  const CellSeconds& known_;
  double left_s_ = 0.0;      // as known
  double expected_s_ = 0.0;  // of what was finished
  double taken_s_ = 0.0;
};

// The sum, the cells whose time is not known, and the most expensive cells, as text.
std::string plan_text(const CellSeconds& known, const campaign::Manifest& manifest, std::uint32_t jobs);

// The text of results/seconds.tsv, made when the program is built.
std::string_view kept_seconds_text();

}  // namespace broadside::bench::contest
