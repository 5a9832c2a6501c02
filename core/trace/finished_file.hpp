// Turns a closed part file with all frames into the file that gets the final name: without the waste of flushing, and
// with views for other programs. Private to core/trace/*.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/trace/part_file.hpp"

namespace broadside::core {

// Creates a new HDF5 file in the part file.
Handle create_hdf5(PartFile& part);

// Whether so much of the part is waste that a copy costs less than it saves. A flush in the middle of a chunk makes
// HDF5 write that chunk a second time elsewhere and leave the first as waste. stored: bytes of the datasets in /trace.
bool is_worth_compacting(const PartFile& part, std::uint64_t stored);

// Copies every object to the new file path + ".compact", chunk by chunk without decompression; the waste is not copied.
// Null when that failed (a disk without room for both): the part then becomes the trace.
std::unique_ptr<PartFile> compacted(PartFile& part, const std::filesystem::path& path);

// Adds /VTKHDF. When that fails, the file is unchanged: a trace without /VTKHDF is complete.
void add_views(PartFile& complete, std::uint64_t frames, std::uint64_t bodies);

}  // namespace broadside::core
