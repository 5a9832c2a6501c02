// Do an HDF5 file's attributes fit where they are stored? Asked before HDF5 opens it: release 1.10 takes the lengths
// inside an attribute's message at their word, and reads and copies past the message's end.
#pragma once

#include <filesystem>

#include "core/result.hpp"

namespace broadside::core {

// Walks every object that can be reached from the root in the format that HDF5 writes by default, as h5py does: symbol
// tables and object headers of version 1, with addresses and lengths of 8 bytes. For each attribute its name, type,
// shape and values must lie inside its message, and its type have the numbers that its class needs. Files in the newer
// format, where every header has a checksum, and structures that HDF5 itself refuses, pass. Error: where an attribute
// does not fit, in one line.
Status check_attributes(const std::filesystem::path& path);

}  // namespace broadside::core
