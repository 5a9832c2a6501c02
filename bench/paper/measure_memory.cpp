#include "bench/paper/measure_memory.hpp"

#include <algorithm>

#include "bench/paper/memory_in_use.hpp"
#include "bench/process/interrupt.hpp"

namespace broadside::bench::paper {
namespace {

bool is_on_gpu(const CellSpec& spec) {
  return spec.row->id.ends_with("-gpu");
}

core::Result<std::uint64_t> in_use(const CellSpec& spec) {
  if (!is_on_gpu(spec)) return heap_bytes();
  const std::optional<std::uint64_t> bytes = device_bytes();
  if (!bytes)
    return core::Error{"the driver does not say how much device memory is in use", std::string(spec.row->id), "",
                       core::Exit::kMissing};
  return *bytes;
}

// Runs so many frames, and returns the mean of the bytes in use at the ends of the windows.
core::Result<double> sampled(const RunPlan& plan, const CellSpec& spec, std::uint64_t frames,
                             std::uint64_t window_frames) {
  auto settings = core::Settings::parse(spec.row->id, spec.row->settings, spec.settings);
  if (!settings) return settings.error();
  auto before = in_use(spec);
  if (!before) return before.error();
  auto engine = spec.row->create(settings.value());
  if (!engine) return engine.error();
  core::Dynamics& dynamics = *engine.value().dynamics;
  if (core::Status s = dynamics.load(plan.scene); !s) return s.error();
  double sum = 0.0;
  std::uint64_t samples = 0;
  for (std::uint64_t step = 1; step <= frames; ++step) {
    if (is_interrupted()) return core::Error{"interrupted", "memory", "", core::Exit::kMissing};
    if (core::Status s = dynamics.step(plan.scene.dt_s); !s) return s.error();
    if (step % window_frames != 0 && step != frames) continue;
    auto now = in_use(spec);
    if (!now) return now.error();
    sum += static_cast<double>(now.value()) - static_cast<double>(before.value());
    ++samples;
  }
  return sum / static_cast<double>(samples);
}

}  // namespace

const char* memory_kind(const CellSpec& spec) {
  return is_on_gpu(spec) ? "device memory, by the driver's count" : "heap of the process, by the allocator's count";
}

core::Result<double> memory_of_run(const RunPlan& plan, const CellSpec& spec, std::uint64_t window_frames) {
  // Memory that a first use leaves behind (code on the device, thread pools) does not belong to the engine.
  auto warm = sampled(plan, spec, std::min<std::uint64_t>(plan.frames, 2), 1);
  if (!warm) return warm.error();
  return sampled(plan, spec, plan.frames, window_frames);
}

}  // namespace broadside::bench::paper
