#include "reference/continuous/find_candidates.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

#include "reference/worker_count.hpp"

namespace broadside::reference {
namespace {

// Pairs of triangles per task: some hundred microseconds of work.
constexpr std::size_t kCandidateGrain = 8192;

template <typename Part>
void append(Part& all, std::size_t& at, const Part& part) {
  std::copy(part.begin(), part.end(), all.begin() + static_cast<std::ptrdiff_t>(at));
  at += part.size();
}

}  // namespace

continuous::FeaturePairs find_candidates(const continuous::CandidateFinder& finder,
                                         std::span<const core::Pair> triangles, unsigned workers) {
  const std::size_t tasks = (triangles.size() + kCandidateGrain - 1) / kCandidateGrain;
  std::vector<continuous::FeaturePairs> found(tasks);
  tbb::task_arena arena(worker_count(workers));
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t k) {
      finder.add(
          triangles.subspan(k * kCandidateGrain, std::min(kCandidateGrain, triangles.size() - k * kCandidateGrain)),
          found[k]);
    });
  });
  std::size_t faces = 0;
  std::size_t edges = 0;
  for (const auto& part : found) {
    faces += part.vertex_face.size();
    edges += part.edge_edge.size();
  }
  continuous::FeaturePairs out;
  out.vertex_face.resize(faces);
  out.edge_edge.resize(edges);
  std::size_t face = 0;
  std::size_t edge = 0;
  for (const auto& part : found) {
    append(out.vertex_face, face, part.vertex_face);
    append(out.edge_edge, edge, part.edge_edge);
  }
  return out;
}

}  // namespace broadside::reference
