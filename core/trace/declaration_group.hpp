// The group /declaration of a trace: one text attribute per declared key. Private to core/trace/*.cpp.
#pragma once

#include "core/engine/declaration.hpp"
#include "core/trace/hdf5_sink.hpp"
#include "core/trace/hdf5_source.hpp"

namespace broadside::core {

void write_declaration(Hdf5Sink& sink, const Declaration& declaration);
// Without the group nothing is declared. An unknown key or word is reported to source.
Declaration read_declaration(Hdf5Source& source);

}  // namespace broadside::core
