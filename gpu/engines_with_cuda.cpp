#include <cuda_runtime_api.h>

#include <memory>
#include <string>
#include <utility>

#include "core/method/rigid/refuse_method_settings.hpp"
#include "gpu/broad/kept_finder.hpp"
#include "gpu/broad/pair_finder.hpp"
#include "gpu/broad/spread_finder.hpp"
#include "gpu/engines_on_cuda.hpp"
#include "gpu/frame/pipeline.hpp"
#include "gpu/pipeline_by_motion.hpp"

namespace broadside::gpu {
namespace {

std::string version_text(int version) {
  return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
}

core::Result<core::Engine> engine_of(std::string_view id, std::string_view twin_of, const core::Settings& settings,
                                     std::unique_ptr<core::Dynamics> dynamics,
                                     std::unique_ptr<core::BroadPhase> alone) {
  if (const std::string why = gpu_absent(); !why.empty())
    return core::Error{why, std::string(id), "run on a machine with an NVIDIA GPU", core::Exit::kMissing};
  core::Engine engine;
  engine.id = id;
  engine.build = "Broadside, float32, CUDA " + version_text(CUDART_VERSION) + ", " + device_name();
  engine.settings = settings;
  engine.declaration = core::method_declaration(twin_of);
  engine.broad_phase = std::move(alone);
  engine.dynamics = std::move(dynamics);
  return engine;
}

// The broad phase of boxes alone, without a simulation.
core::Result<std::unique_ptr<core::BroadPhase>> broad_phase_of(const core::Settings& settings,
                                                               const PairFinderOptions& options) {
  const bool is_kept = settings.text("broad") == "kept";
  PairFinderOptions own = options;
  own.pairs_at_once = settings.number("pairs_at_once");
  const SpreadOptions spread{static_cast<std::uint32_t>(settings.number("parts")),
                             static_cast<std::uint32_t>(settings.number("devices")), own.pairs_at_once};
  const bool is_spread = spread.parts > 1 || spread.devices != 1;
  const bool is_fast = settings.text("broad") == "tree" && options.variant == core::Variant::kSound;
  if (!is_fast && (is_spread || own.pairs_at_once != 0))
    return core::Error{"pairs_at_once, parts and devices do not go together with broad=" + settings.text("broad") +
                           ",variant=" + settings.text("variant"),
                       "octree-gpu", "give them with broad=tree and variant=sound"};
  std::unique_ptr<core::BroadPhase> made;
  if (is_spread)
    made = std::make_unique<SpreadFinder>(spread);
  else if (is_kept)
    made = std::make_unique<KeptFinder>(own);
  else
    made = std::make_unique<PairFinder>(own);
  return made;
}

}  // namespace

std::string gpu_absent() {
  int count = 0;
  const cudaError_t code = cudaGetDeviceCount(&count);
  if (code == cudaSuccess && count > 0) return {};
  (void)cudaGetLastError();  // clear the error, so that the next call gives the same answer
  if (code == cudaErrorInsufficientDriver) return "no device: the CUDA driver is absent or older than this build needs";
  return "no device";
}

core::Result<core::Engine> create_octree_gpu(const core::Settings& settings) {
  PipelineOptions options;
  const std::string& broad = settings.text("broad");
  if (broad == "octree") options.broad = Broad::kOctree;
  if (broad == "brute") options.broad = Broad::kBrute;
  options.levels = *core::levels_named(settings.text("levels"));
  options.variant = *core::variant_named(settings.text("variant"));
  const std::string& solver = settings.text("solver");
  if (solver == "jacobi") options.solver = Solver::kJacobi;
  if (solver == "printed-E8" || options.variant == core::Variant::kE8) options.solver = Solver::kRacing;
  options.has_vertex_stage = settings.text("vertex_stage") == "on";
  RigidPipelineOptions turning;
  turning.broad = options.broad;
  turning.levels = options.levels;
  turning.solver = core::soft_settings_of(settings);
  turning.has_fixed_thresholds = settings.text("thresholds") == "fixed";
  turning.swept = core::swept_named(settings.text("sweep"));
  turning.sleeps = settings.text("sleep") == "on";
  auto dynamics = std::make_unique<PipelineByMotion>(options, turning, "octree-cpu",
                                                     core::refuse_method_settings("octree-gpu", settings));
  auto alone = broad_phase_of(settings, {options.broad, options.variant});
  if (!alone.ok()) return alone.error();
  return engine_of("octree-gpu", "octree-cpu", settings, std::move(dynamics), std::move(alone).value());
}

core::Result<core::Engine> create_hash_gpu(const core::Settings& settings) {
  PipelineOptions options;
  options.broad = Broad::kHash;
  options.hash_cell_m = static_cast<float>(settings.number("cell_mm")) / 1000.0F;
  options.levels = *core::levels_named(settings.text("levels"));
  options.has_vertex_stage = settings.text("vertex_stage") == "on";
  const float alone_m = options.hash_cell_m > 0.0F ? options.hash_cell_m : core::Parameters{}.hash_cell_m;
  return engine_of("hash-gpu", "hash-cpu", settings, std::make_unique<Pipeline>(options),
                   std::make_unique<PairFinder>(PairFinderOptions{Broad::kHash, core::Variant::kSound, alone_m}));
}

std::string device_name() {
  int device = 0;
  cudaDeviceProp properties;
  int driver = 0;
  if (!gpu_absent().empty() || cudaGetDevice(&device) != cudaSuccess ||
      cudaGetDeviceProperties(&properties, device) != cudaSuccess || cudaDriverGetVersion(&driver) != cudaSuccess)
    return "no device";
  return std::string(properties.name) + ", driver for CUDA " + version_text(driver);
}

}  // namespace broadside::gpu
