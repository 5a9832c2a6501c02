#include "bench/converge/convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/trace/trace_reader.hpp"
#include "validation/mechanics/scene_answer.hpp"

namespace broadside::bench {
namespace {

using validation::ExactFigure;

// The figures of one run, by name and by step of the coarsest run.
struct Track {
  std::vector<std::string> names;  // in the answer's order
  std::map<std::string, std::map<std::uint64_t, ExactFigure>> figures;
};

core::Result<Track> follow(const core::TraceReader& trace, std::uint64_t stride) {
  const core::TraceHeader& header = trace.header();
  const validation::SceneAnswer* answer = validation::find_answer(header.scene.answer);
  if (answer == nullptr)
    return core::Error{"the scene's answer '" + header.scene.answer + "' is not one that is known here",
                       trace.path().string(), "use a scene of 'rigid:*'"};
  const double order = header.declaration.number("order");
  validation::MotionReader motions(header);
  Track track;
  std::optional<core::FrameRecord> previous;
  for (std::uint64_t k = 0; k < trace.frame_count(); ++k) {
    auto frame = trace.read(k, core::bit(core::Group::kBodies) | core::bit(core::Group::kWideBodies));
    if (!frame) return frame.error();
    const validation::Motion* m = motions.read(frame.value(), previous ? &*previous : nullptr);
    if (m != nullptr)
      for (const ExactFigure& f : answer->figures(header.scene, *m, order)) {
        if (m->step % stride != 0) continue;
        const std::string what(f.what);
        if (!track.figures.contains(what)) track.names.push_back(what);
        track.figures[what][m->step / stride] = f;
      }
    previous = std::move(frame).value();
  }
  return track;
}

}  // namespace

double observed_order(const FigureErrors& f, std::size_t finer) {
  const double from = f.error[finer - 1];
  const double to = f.error[finer];
  return from > 0.0 && to > 0.0 ? std::log2(from / to) : std::numeric_limits<double>::quiet_NaN();
}

core::Result<Convergence> measure_convergence(const std::vector<std::filesystem::path>& traces) {
  Convergence out;
  std::vector<Track> tracks;
  for (std::size_t k = 0; k < traces.size(); ++k) {
    auto trace = core::TraceReader::open(traces[k]);
    if (!trace) return trace.error();
    out.declared_order = trace.value().header().declaration.number("order");
    out.dt_s.push_back(trace.value().header().scene.dt_s);
    auto track = follow(trace.value(), std::uint64_t{1} << k);
    if (!track) return track.error();
    tracks.push_back(std::move(track).value());
  }
  for (const std::string& what : tracks.front().names) {
    const auto& coarse = tracks.front().figures.at(what);
    FigureErrors f;
    f.what = what;
    f.unit = coarse.begin()->second.unit;
    f.error.assign(traces.size(), 0.0);
    f.limit.assign(traces.size(), 0.0);
    bool has_common = false;
    for (const auto& [step, figure] : coarse) {
      const bool all_have = std::all_of(tracks.begin(), tracks.end(), [&, s = step](const Track& t) {
        const auto at = t.figures.find(what);
        return at != t.figures.end() && at->second.contains(s);
      });
      if (!all_have) continue;
      has_common = true;
      f.has_order = figure.has_order;
      f.is_first_order = figure.is_first_order;
      for (std::size_t k = 0; k < tracks.size(); ++k) {
        const ExactFigure& own = tracks[k].figures.at(what).at(step);
        const bool is_broken = own.error > own.limit;
        f.share = std::max(f.share, own.limit > 0.0 ? own.error / own.limit : (is_broken ? 2.0 : 0.0));
        if (own.error < f.error[k]) continue;
        f.error[k] = own.error;
        f.limit[k] = own.limit;
        if (k + 1 == tracks.size()) f.floor = own.floor;
      }
    }
    if (has_common) out.figures.push_back(std::move(f));
  }
  return out;
}

core::Verdict judge_convergence(const Convergence& c) {
  core::Verdict v;
  v.validator = "converge";
  v.origin = "p - 1/2, half way to the next lower order, from h to h/4; first order where contacts begin or end";
  v.outcome = core::Outcome::kInconclusive;
  v.explanation = "the scene's answer has no figures at common times";
  double least = std::numeric_limits<double>::infinity();
  for (const FigureErrors& f : c.figures) {
    ++v.checked;
    bool holds = true;
    std::string text;
    if (!f.has_order) {
      holds = f.share <= 1.0;
      text = fmt::format("{} has no order: at most {} of its limit", f.what, fmt::format("{:.3g}", f.share));
    } else if (f.error.back() <= f.floor) {
      text = fmt::format("{} is exact up to rounding and settling, {:.3g} {}", f.what, f.error.back(), f.unit);
    } else {
      const double wanted = (f.is_first_order ? std::min(1.0, c.declared_order) : c.declared_order) - 0.5;
      const double order = std::log2(f.error.front() / f.error.back()) / static_cast<double>(f.error.size() - 1);
      holds = order >= wanted;
      text = fmt::format("{} falls with order {:.2f}, declared {:g}", f.what, order, c.declared_order);
      if (order - wanted < least - v.limit || !std::isfinite(least))
        least = order, v.limit = wanted, v.measured = order;
    }
    if (!holds) ++v.violations;
    // The explanation is that of the first figure, or of the first figure that breaks the law.
    if (v.checked == 1 || (!holds && v.violations == 1)) v.explanation = text;
  }
  if (v.checked > 0) v.outcome = v.violations > 0 ? core::Outcome::kFail : core::Outcome::kPass;
  return v;
}

}  // namespace broadside::bench
