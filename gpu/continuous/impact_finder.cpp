#include "gpu/continuous/impact_finder.hpp"

#include <algorithm>
#include <bit>
#include <string>

namespace broadside::gpu {
namespace {

using continuous::FeatureKind;

constexpr const char* kWhat = "continuous collision";
constexpr std::uint64_t kMostPairs = kUnlooked - 1U;

}  // namespace

core::Status ImpactFinder::load(const continuous::MovingSurface& surface, const continuous::SurfaceFeatures& features,
                                const continuous::FeaturePairs& pairs) {
  if (std::max(pairs.vertex_face.size(), pairs.edge_edge.size()) > kMostPairs)
    return core::Error{std::to_string(pairs.count()) + " candidates", kWhat, "give fewer than 2^31 of a kind"};
  face_count_ = static_cast<std::uint32_t>(pairs.vertex_face.size());
  edge_count_ = static_cast<std::uint32_t>(pairs.edge_edge.size());
  BROADSIDE_TRY(paths_.upload(continuous::vertex_paths(surface), "moving vertices"));
  BROADSIDE_TRY(triangles_.upload(surface.triangles, "triangles"));
  BROADSIDE_TRY(edges_.upload(features.edges, "edges"));
  BROADSIDE_TRY(faces_.upload(pairs.vertex_face, "candidates"));
  BROADSIDE_TRY(edge_pairs_.upload(pairs.edge_edge, "candidates"));
  BROADSIDE_TRY(left_.reserve(std::min(options_.queries_a_launch, std::max(face_count_, edge_count_)), "candidates"));
  BROADSIDE_TRY(hits_.reserve(options_.hits, "touches"));
  return counts_.reserve(1, "counts");
}

core::Status ImpactFinder::run_kind(ImpactView& view, StreamHandle stream) {
  auto multiprocessors = multiprocessor_count();
  if (!multiprocessors.ok()) return multiprocessors.error();
  const std::uint32_t count = view.kind == FeatureKind::kVertexFace ? face_count_ : edge_count_;
  for (std::uint64_t first = 0; first < count; first += options_.queries_a_launch) {
    view.first = static_cast<std::uint32_t>(first);
    view.last = static_cast<std::uint32_t>(std::min<std::uint64_t>(count, first + options_.queries_a_launch));
    BROADSIDE_TRY(launch_impacts(view, multiprocessors.value(), stream));
  }
  return core::Done{};
}

core::Status ImpactFinder::run(bool finds_times) {
  const ImpactCounts none{0, 0, std::bit_cast<unsigned long long>(1.0)};
  BROADSIDE_TRY(copy_to_device(counts_.data(), &none, sizeof none));
  if (finds_times) {
    BROADSIDE_TRY(face_times_.reserve(face_count_, "times"));
    BROADSIDE_TRY(edge_times_.reserve(edge_count_, "times"));
  }
  auto stream = frame_stream();
  if (!stream.ok()) return stream.error();
  ImpactView view{};
  view.surface = {paths_.data(), triangles_.data()->data(), edges_.data()->data()};
  view.left = left_.data();
  view.hits = hits_.data();
  view.hit_capacity = options_.hits;
  view.counts = counts_.data();
  StreamTimer timer;
  BROADSIDE_TRY(timer.start(stream.value()));
  view.kind = FeatureKind::kVertexFace;
  view.pairs = faces_.data();
  view.times = finds_times ? face_times_.data() : nullptr;
  BROADSIDE_TRY(run_kind(view, stream.value()));
  view.kind = FeatureKind::kEdgeEdge;
  view.pairs = edge_pairs_.data();
  view.times = finds_times ? edge_times_.data() : nullptr;
  BROADSIDE_TRY(run_kind(view, stream.value()));
  BROADSIDE_TRY(timer.stop(stream.value()));
  BROADSIDE_TRY(wait_for_stream(stream.value(), kWhat));
  seconds_ = timer.elapsed_s();
  return core::Done{};
}

core::Status ImpactFinder::find_times() {
  return run(true);
}

core::Result<FirstHit> ImpactFinder::find_earliest() {
  BROADSIDE_TRY(run(false));
  std::vector<ImpactCounts> counts;
  BROADSIDE_TRY(counts_.download(counts, 1));
  if (counts[0].hits > options_.hits) {
    // There were more than there was room for: repeat with enough room.
    options_.hits = counts[0].hits + counts[0].hits / 2;
    BROADSIDE_TRY(hits_.reserve(options_.hits, "touches"));
    return find_earliest();
  }
  std::vector<ImpactHit> hits;
  BROADSIDE_TRY(hits_.download(hits, counts[0].hits));
  const double earliest = std::bit_cast<double>(counts[0].earliest_bits);
  FirstHit first;
  for (const ImpactHit& hit : hits) {
    if (hit.time != earliest) continue;
    const auto kind = static_cast<FeatureKind>(hit.kind);
    const auto& pairs = kind == FeatureKind::kVertexFace ? faces_ : edge_pairs_;
    FirstHit one{true, hit.time, kind, {}};
    BROADSIDE_TRY(copy_to_host(&one.pair, pairs.data() + hit.query, sizeof one.pair));
    const bool is_less = one.kind != first.kind ? one.kind < first.kind : one.pair < first.pair;
    if (!first.touches || is_less) first = one;
  }
  return first;
}

core::Result<ImpactTimes> ImpactFinder::read_back() const {
  ImpactTimes out;
  BROADSIDE_TRY(face_times_.download(out.vertex_face, face_count_));
  BROADSIDE_TRY(edge_times_.download(out.edge_edge, edge_count_));
  return out;
}

}  // namespace broadside::gpu
