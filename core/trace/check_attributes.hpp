// Do an HDF5 file's attributes fit where they are stored? Checked before HDF5 opens it: release 1.10 trusts the lengths
// inside an attribute's message, and reads and copies past the message's end.
#pragma once

#include <filesystem>

#include "core/result.hpp"

namespace broadside::core {

// Walks every object that can be reached from the root, in the format that HDF5 and h5py write by default: symbol
// tables and object headers of version 1, with addresses and lengths of 8 bytes. For each attribute, its name, type,
// shape and values must lie inside its message, and its type must have the numbers that its class needs. Files in the
// newer format, where every header has a checksum, and structures that HDF5 itself refuses are accepted here. Error:
// where an attribute does not fit, in one line.
Status check_attributes(const std::filesystem::path& path);

}  // namespace broadside::core
