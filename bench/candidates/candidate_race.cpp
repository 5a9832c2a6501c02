#include "bench/candidates/candidate_race.hpp"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/process/broad_phase_cell.hpp"
#include "core/continuous/feature_candidates.hpp"
#include "core/mesh/load_mesh.hpp"
#include "datasets/motions/motions.hpp"
#include "reference/continuous/find_candidates.hpp"

namespace broadside::bench {
namespace {

using Clock = std::chrono::steady_clock;

double candidate_seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

core::Result<std::vector<core::Pair>> pairs_by(const CellSpec& cell, const std::vector<core::Box>& boxes,
                                               double& seconds) {
  auto engine = make_broad_phase_of(cell);
  if (!engine) return engine.error();
  core::BroadPhase* broad = engine.value().broad_phase.get();
  const std::vector<std::uint8_t> is_static(boxes.size());
  const auto start = Clock::now();
  if (core::Status s = broad->load(boxes, is_static); !s) return s.error();
  if (core::Status s = broad->find(); !s) return s.error();
  auto found = broad->read_back();
  seconds = candidate_seconds_since(start);
  if (!found) return found.error();
  return std::move(found.value().pairs);
}

core::Result<CandidateRow> row_of(const CellSpec& cell, const continuous::MovingSurface& surface,
                                  const continuous::SurfaceFeatures& features) {
  CandidateRow row;
  auto found = candidates_by(cell, surface, features, row);
  if (!found) return found.error();
  return row;
}

void fill(CandidateRow& row, const continuous::FeaturePairs& found) {
  row.vertex_face = found.vertex_face.size();
  row.edge_edge = found.edge_edge.size();
  row.digest = continuous::digest_of(found);
}

core::Result<CandidateRow> candidate_row_of(const std::string& text) {
  try {
    const auto out = nlohmann::json::parse(text).at(0);
    CandidateRow row;
    row.label = out.at("engine");
    row.triangles = out.at("triangles");
    row.pairs = out.at("pairs");
    row.vertex_face = out.at("vertex_face");
    row.edge_edge = out.at("edge_edge");
    row.digest = std::stoull(out.at("digest").get<std::string>(), nullptr, 16);
    row.pairs_s = out.at("pairs_s");
    row.candidates_s = out.at("candidates_s");
    return row;
  } catch (const std::exception& e) {
    return core::Error{std::string("its answer cannot be read: ") + e.what(), "child process", "",
                       core::Exit::kInternal};
  }
}

core::Result<CandidateRow> row_of_child(const MotionSource& source, const CellSpec& cell, const ChildLimits& limits) {
  std::vector<std::string> args{"candidates", source.start};
  if (!source.end.empty()) args.insert(args.end(), {"--to", source.end});
  auto answer = ask_child(std::move(args), cell, limits);
  if (!answer) return answer.error();
  if (answer.value().absent.empty()) return candidate_row_of(answer.value().output);
  CandidateRow row;
  row.label = label_of(cell);
  row.absent = std::move(answer.value().absent);
  row.verdict = std::move(answer.value().verdict);
  row.repeat = std::move(answer.value().repeat);
  return row;
}

}  // namespace

core::Result<continuous::MovingSurface> make_surface(const MotionSource& source) {
  if (source.end.empty()) return datasets::make_motion(source.start);
  auto start = core::load_mesh(source.start);
  if (!start) return start.error();
  auto end = core::load_mesh(source.end);
  if (!end) return end.error();
  return continuous::surface_between(start.value().mesh, end.value().mesh);
}

core::Result<continuous::FeaturePairs> candidates_by(const CellSpec& cell, const continuous::MovingSurface& surface,
                                                     const continuous::SurfaceFeatures& features, CandidateRow& row) {
  row.label = label_of(cell);
  row.triangles = surface.triangles.size();
  auto pairs = pairs_by(cell, continuous::swept_boxes(surface), row.pairs_s);
  if (!pairs) return pairs.error();
  row.pairs = pairs.value().size();
  const auto start = Clock::now();
  const continuous::CandidateFinder finder(surface, features);
  continuous::FeaturePairs found = reference::find_candidates(finder, pairs.value());
  row.candidates_s = candidate_seconds_since(start);
  fill(row, found);
  return found;
}

core::Result<std::vector<CandidateRow>> race_candidates(const MotionSource& source, const std::vector<CellSpec>& cells,
                                                        bool try_all, const ChildLimits& limits, bool here) {
  auto surface = make_surface(source);
  if (!surface) return surface.error();
  const continuous::SurfaceFeatures features = continuous::features_of(surface.value());
  std::vector<CandidateRow> rows;
  for (const CellSpec& cell : cells) {
    const bool is_apart = !here && runs_apart(cell, limits);
    auto row = is_apart ? row_of_child(source, cell, limits) : row_of(cell, surface.value(), features);
    if (!row) return row.error();
    rows.push_back(std::move(row).value());
  }
  if (try_all) {
    CandidateRow row;
    row.label = "every pair of features";
    row.triangles = surface.value().triangles.size();
    const auto start = Clock::now();
    const auto found = continuous::CandidateFinder(surface.value(), features).try_all();
    row.candidates_s = candidate_seconds_since(start);
    fill(row, found);
    rows.push_back(row);
  }
  return rows;
}

std::string candidates_json(const std::vector<CandidateRow>& rows) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const CandidateRow& r : rows) {
    if (!r.absent.empty()) {
      out.push_back({{"engine", r.label}, {"absent", r.absent}, {"verdict", r.verdict}, {"repeat", r.repeat}});
      continue;
    }
    out.push_back({{"engine", r.label},
                   {"triangles", r.triangles},
                   {"pairs", r.pairs},
                   {"vertex_face", r.vertex_face},
                   {"edge_edge", r.edge_edge},
                   {"digest", fmt::format("{:#018x}", r.digest)},
                   {"pairs_s", r.pairs_s},
                   {"candidates_s", r.candidates_s}});
    if (r.impacts_s > 0.0)
      out.back()["impacts"] = {{"touching", r.touching},
                               {"digest", fmt::format("{:#018x}", r.impacts)},
                               {"first_touch", r.first_touch},
                               {"all_s", r.impacts_s},
                               {"earliest_s", r.earliest_s}};
  }
  return out.dump(2);
}

}  // namespace broadside::bench
