#include "bench/cell/trace_scene.hpp"

#include "core/trace/trace_reader.hpp"

namespace broadside::bench {

bool is_trace_file(std::string_view spec) {
  return spec.ends_with(".h5") || spec.ends_with(".h5.part");
}

core::Result<core::Scene> scene_of_trace(const std::filesystem::path& trace) {
  auto reader = core::TraceReader::open(trace);
  if (!reader) return reader.error();
  return reader.value().header().scene;
}

}  // namespace broadside::bench
