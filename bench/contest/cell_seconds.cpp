#include "bench/contest/cell_seconds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <vector>

#include "core/whole_file.hpp"

namespace broadside::bench::contest {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFile = "seconds.tsv";
constexpr std::size_t kShown = 20;

}  // namespace

core::Result<CellSeconds> CellSeconds::parse(const std::string& text, const std::string& where) {
  CellSeconds known;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    ++number;
    if (line.empty()) continue;
    if (line.starts_with("#")) {
      known.origin_ += line.substr(std::min(line.find_first_not_of("# "), line.size()));
      continue;
    }
    const std::size_t scene = line.find('\t');
    const std::size_t engine = scene == std::string::npos ? scene : line.find('\t', scene + 1);
    double seconds = 0.0;
    const auto read = std::from_chars(line.data(), line.data() + std::min(scene, line.size()), seconds);
    if (engine == std::string::npos || read.ec != std::errc() || read.ptr != line.data() + scene ||
        !std::isfinite(seconds) || seconds < 0.0)
      return core::Error{fmt::format("cannot read line {}: '{}'", number, line), where,
                         "a line has seconds, scene and engine, separated by tabs; remove the file to start again"};
    known.set(line.substr(scene + 1, engine - scene - 1), line.substr(engine + 1), seconds);
  }
  return known;
}

core::Result<CellSeconds> CellSeconds::read(const fs::path& folder) {
  const fs::path file = folder / kFile;
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return CellSeconds();
  auto text = core::read_whole_file(file);
  if (!text) return text.error();
  return parse(text.value(), file.string());
}

CellSeconds CellSeconds::kept() {
  auto known = parse(std::string(kept_seconds_text()), "results/seconds.tsv");
  return known ? std::move(known).value() : CellSeconds();
}

void CellSeconds::set(const std::string& scene, const std::string& engine, double seconds) {
  const auto [at, is_new] = seconds_.emplace(std::pair(scene, engine), seconds);
  const double more = is_new ? seconds : seconds - at->second;
  at->second = seconds;
  for (Sum* sum : {&by_scene_[scene], &all_}) {
    sum->seconds += more;
    sum->cells += is_new ? 1.0 : 0.0;
  }
}

core::Status CellSeconds::write(const fs::path& folder, const std::string& origin) const {
  std::string text = "# " + origin + "\n";
  for (const auto& [cell, seconds] : seconds_)
    text += fmt::format("{:.2f}\t{}\t{}\n", seconds, cell.first, cell.second);
  return core::write_whole_file(folder / kFile, text);
}

bool CellSeconds::knows(const std::string& scene, const std::string& engine) const {
  return seconds_.count({scene, engine}) > 0;
}

double CellSeconds::expected(const std::string& scene, const std::string& engine) const {
  if (const auto at = seconds_.find({scene, engine}); at != seconds_.end()) return at->second;
  if (const auto at = by_scene_.find(scene); at != by_scene_.end()) return at->second.seconds / at->second.cells;
  return all_.cells > 0.0 ? all_.seconds / all_.cells : 0.0;
}

Forecast::Forecast(const CellSeconds& known, const campaign::Manifest& manifest, const fs::path& folder)
    : known_(known) {
  for (const campaign::ManifestCell& cell : manifest.cells) {
    std::error_code ignored;
    if (!fs::exists(campaign::cell_folder(folder, cell.id), ignored))
      left_s_ += known_.expected(cell.work.scene, cell.work.engine);
  }
}

void Forecast::finish(const campaign::CellWork& work, double seconds) {
  const double expected = known_.expected(work.scene, work.engine);
  left_s_ = std::max(0.0, left_s_ - expected);
  expected_s_ += expected;
  taken_s_ += seconds;
}

double Forecast::left_s(std::uint32_t jobs) const {
  const double pace = expected_s_ > 0.0 ? taken_s_ / expected_s_ : 1.0;
  return left_s_ * pace / static_cast<double>(std::max(jobs, 1U));
}

std::string plan_text(const CellSeconds& known, const campaign::Manifest& manifest, std::uint32_t jobs) {
  struct Cost {
    double seconds;
    const campaign::CellWork* work;
  };
  std::vector<Cost> costs;
  std::size_t unknown = 0;
  double all = 0.0;
  for (const campaign::ManifestCell& cell : manifest.cells) {
    costs.push_back({known.expected(cell.work.scene, cell.work.engine), &cell.work});
    unknown += known.knows(cell.work.scene, cell.work.engine) ? 0 : 1;
    all += costs.back().seconds;
  }
  std::stable_sort(costs.begin(), costs.end(), [](const Cost& a, const Cost& b) { return a.seconds > b.seconds; });
  // A sum of mostly unknown times is no estimate.
  if (2 * unknown > costs.size())
    return fmt::format("{} cells, and seconds of {} of them are known: too few for an estimate.\n", costs.size(),
                       costs.size() - unknown);
  std::string text = fmt::format("{} cells, {:.0f} s of work: about {:.0f} min with --jobs {}.\n", costs.size(), all,
                                 all / 60.0 / static_cast<double>(std::max(jobs, 1U)), jobs);
  if (!known.origin().empty()) text += fmt::format("Measured: {}\n", known.origin());
  if (unknown > 0)
    text += fmt::format("{} cells have no known seconds: each counts as the mean of its scene.\n", unknown);
  text += "The dearest:\n";
  for (std::size_t k = 0; k < std::min(kShown, costs.size()); ++k)
    text += fmt::format("{:8.1f} s  {}  {}\n", costs[k].seconds, costs[k].work->scene, costs[k].work->engine);
  return text;
}

}  // namespace broadside::bench::contest
