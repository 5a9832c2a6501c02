#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/agree/motion/query_file.hpp"
#include "bench/candidates/candidate_race.hpp"
#include "bench/cell/scene_arguments.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/limit_arguments.hpp"
#include "bench/process/process_limits.hpp"
#include "bench/record/run_plan.hpp"
#include "core/exact/feature_touch.hpp"
#include "datasets/motions/motions.hpp"

namespace broadside::bench {
namespace {

struct CandidatesArguments {
  MotionSource source;
  EngineArguments engines;
  std::string queries;
  bool tries_all = false;
  bool finds_impacts = false;
  bool as_json = false;
  ChildLimits limits;
  bool is_in_process = false;
};

void print_candidates(const std::vector<CandidateRow>& rows) {
  fmt::print("{:<28} {:>12} {:>12} {:>12} {:>12} {:>18} {:>12} {:>14}\n", "engine", "triangles", "pairs", "vertex-face",
             "edge-edge", "digest", "pairs ms", "candidates ms");
  for (const CandidateRow& r : rows) {
    if (!r.absent.empty())
      fmt::print("{:<28} {}: {}\n{:<28} repeat: {}\n", r.label, r.verdict, r.absent, "", r.repeat);
    else
      fmt::print("{:<28} {:>12} {:>12} {:>12} {:>12} {:#018x} {:>12.3f} {:>14.3f}\n", r.label, r.triangles, r.pairs,
                 r.vertex_face, r.edge_edge, r.digest, r.pairs_s * 1e3, r.candidates_s * 1e3);
  }
}

// The engines that answered must agree. Exit code 3 when an engine did not answer.
core::Exit verdict_on_candidates(const std::vector<CandidateRow>& rows) {
  const CandidateRow* first = nullptr;
  core::Exit exit = core::Exit::kGood;
  for (const CandidateRow& r : rows) {
    if (!r.absent.empty()) {
      exit = core::Exit::kMissing;
      continue;
    }
    if (first == nullptr) first = &r;
    if (r.digest == first->digest) continue;
    fmt::print(stderr, "broadside: {} and {} found different candidates\n", first->label, r.label);
    return core::Exit::kFailed;
  }
  return exit;
}

// The candidates that the twin found; one engine is enough, since all engines agree.
struct Found {
  continuous::MovingSurface surface;
  continuous::SurfaceFeatures features;
  continuous::FeaturePairs pairs;
  CandidateRow row;
};

core::Result<Found> candidates_of(const MotionSource& source) {
  const auto cell = parse_cell_spec("octree-cpu");
  if (!cell) return cell.error();
  auto surface = make_surface(source);
  if (!surface) return surface.error();
  Found out;
  out.surface = std::move(surface).value();
  out.features = continuous::features_of(out.surface);
  auto pairs = candidates_by(cell.value(), out.surface, out.features, out.row);
  if (!pairs) return pairs.error();
  out.pairs = std::move(pairs).value();
  return out;
}

// Writes the candidates and the arbiter's answers in the format that agree --motion reads.
core::Status write_queries(const Found& found, const std::string& folder) {
  if (core::Status s = prepare_folder(folder); !s) return s;
  for (const auto kind : {continuous::FeatureKind::kVertexFace, continuous::FeatureKind::kEdgeEdge}) {
    const bool is_face = kind == continuous::FeatureKind::kVertexFace;
    std::vector<FileQuery> queries;
    for (const auto pair : is_face ? found.pairs.vertex_face : found.pairs.edge_edge) {
      const auto moving = continuous::moving_features(found.surface, found.features, kind, pair);
      queries.push_back({exact::to_rational(moving), exact::first_touch(moving).touches});
    }
    const auto file = std::filesystem::path(folder) / (is_face ? "vertex-face.csv" : "edge-edge.csv");
    if (core::Status s = write_query_file(queries, file); !s) return s;
    fmt::print(stderr, "{} queries in {}\n", queries.size(), file.string());
  }
  return core::Done{};
}

void print_impacts(const CandidateRow& r) {
  const double count = static_cast<double>(r.vertex_face + r.edge_edge);
  fmt::print("first touches: {} of {:.0f} candidates touch, the first at {} of the step; digest {:#018x}\n", r.touching,
             count, r.touching > 0 ? fmt::format("{:.17g}", r.first_touch) : std::string("no time"), r.impacts);
  fmt::print("  all times {:.3f} ms, {:.1f} million candidates/s; the earliest alone {:.3f} ms, {:.1f} million/s\n",
             r.impacts_s * 1e3, 1e-6 * count / r.impacts_s, r.earliest_s * 1e3, 1e-6 * count / r.earliest_s);
}

core::Exit candidates(const CandidatesArguments& a) {
  if (a.is_in_process) limit_this_process(a.limits.memory_mib);
  auto cells = a.engines.make();
  if (!cells) return complain(cells.error());
  auto rows = race_candidates(a.source, cells.value(), a.tries_all, a.limits, a.is_in_process);
  if (!rows) return complain(rows.error());
  if (!a.as_json) print_candidates(rows.value());
  if (a.finds_impacts || !a.queries.empty()) {
    auto found = candidates_of(a.source);
    if (!found) return complain(found.error());
    CandidateRow& row = found.value().row;
    if (a.finds_impacts)
      if (core::Status s = time_impacts(found.value().surface, found.value().features, found.value().pairs, row); !s)
        return complain(s.error());
    if (a.finds_impacts && !a.as_json) print_impacts(row);
    if (a.finds_impacts) rows.value().push_back(row);
    if (!a.queries.empty())
      if (core::Status s = write_queries(found.value(), a.queries); !s) return complain(s.error());
  }
  if (a.as_json) fmt::print("{}\n", candidates_json(rows.value()));
  return verdict_on_candidates(rows.value());
}

std::string motions_text() {
  std::string text = "Motions:\n";
  for (const datasets::MotionRow& row : datasets::motion_table())
    text += fmt::format("  {:<20} {}\n", row.pattern, row.what);
  return text;
}

}  // namespace

void add_candidates(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<CandidatesArguments>();
  CLI::App* command = program.add_subcommand(
      "candidates",
      "Find candidates of continuous collision on a moving surface: pairs of a vertex and a face, and of two edges, "
      "whose boxes, swept over the step, overlap. Engines find pairs of triangles and must agree (exit 1 if they do "
      "not); times are of this one call");
  command
      ->add_option("MOTION", a->source.start,
                   "A motion from the list below; with --to, the mesh file at the start of the step")
      ->required();
  command->add_option("--to", a->source.end, "The same mesh at the end of the step, with triangles in the same order");
  a->engines.add_to(*command);
  command->add_flag("--try-all", a->tries_all, "Also try every pair of features, without a broad phase");
  command->add_flag("--impacts", a->finds_impacts,
                    "Also find the first touches of the candidates, with our own continuous collision on every core");
  command->add_option("--queries", a->queries,
                      "A folder for vertex-face.csv and edge-edge.csv, which 'agree --motion KIND --case FILE' reads");
  command->add_flag("--json", a->as_json, "As JSON");
  add_limits(*command, a->limits);
  command->add_flag("--in-process", a->is_in_process, "Run references in this process")->group("");
  command->footer(motions_text());
  command->callback([a, &exit] { exit = candidates(*a); });
}

}  // namespace broadside::bench
