// Continuous collision on fibers of the host.
#include "gpu/stages/continuous/impact_stage.cuh"

namespace broadside::gpu {
namespace {

constexpr on_host::Launch kImpactLaunch{{3}, {64}, 7};

}  // namespace

core::Status launch_impacts(const ImpactView& view, std::uint32_t /*multiprocessors*/, StreamHandle /*stream*/) {
  using continuous::FeatureKind;
  view.counts->left = 0;
  const auto run = [&](auto work) { on_host::run(kImpactLaunch, 0, [&](unsigned char*) { work(); }); };
  if (view.kind == FeatureKind::kVertexFace) {
    run([&] { look_at_queries<FeatureKind::kVertexFace>(view); });
    run([&] { search_left<FeatureKind::kVertexFace>(view); });
  } else {
    run([&] { look_at_queries<FeatureKind::kEdgeEdge>(view); });
    run([&] { search_left<FeatureKind::kEdgeEdge>(view); });
  }
  return core::Done{};
}

core::Result<std::uint32_t> multiprocessor_count() {
  return std::uint32_t{1};
}

}  // namespace broadside::gpu
