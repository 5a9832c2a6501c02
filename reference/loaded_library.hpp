// The shared library that an address really came from, for the build stamp.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace broadside::reference {

// File name after links are followed: "libfcl.so.0.7.0". "static" when the address is in this program itself,
// "unknown" when the loader cannot tell.
std::string loaded_library(const void* address);

// Whether that library's file contains this text, such as the name of a symbol that it imports. Nothing when the file
// cannot be read.
std::optional<bool> library_mentions(const void* address, std::string_view text);

}  // namespace broadside::reference
