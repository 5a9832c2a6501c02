// /scene and /provenance: the two groups that say what was simulated and by which engine. Private to core/trace/*.cpp.
#pragma once

#include "core/trace/hdf5_sink.hpp"
#include "core/trace/hdf5_source.hpp"
#include "core/trace/trace_header.hpp"

namespace broadside::core {

void write_scene(Hdf5Sink& sink, const Scene& scene);
// The scene that is read passes check_scene, and its digest equals the one in the file (if there is one).
Scene read_scene(Hdf5Source& source);

void write_provenance(Hdf5Sink& sink, const TraceHeader& header);
// Everything of the header except scene and groups. Of the stamp only the engine is required.
void read_provenance(Hdf5Source& source, TraceHeader& header);

}  // namespace broadside::core
