// The shared library that an address really came from, for the build stamp.
#pragma once

#include <string>

namespace broadside::reference {

// File name after links are followed: "libfcl.so.0.7.0". "static" when the address is in this program itself,
// "unknown" when the loader cannot tell.
std::string loaded_library(const void* address);

}  // namespace broadside::reference
