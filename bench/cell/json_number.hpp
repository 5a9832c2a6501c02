// Numbers from a JSON file that may be damaged. The JSON library's own conversions turn -5 into 4,294,967,291 and
// truncate 1e30.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace broadside::bench {

// Thrown by the functions below, and caught by the reader of the file.
struct RefusedNumber {
  std::string what;  // "frames is -5, not a whole number from 0 to 1000000000"
};

// Both throw json::exception where the key is missing.
std::uint32_t whole_number(const nlohmann::json& row, const char* key, std::uint32_t least, std::uint32_t most);
double positive_number(const nlohmann::json& row, const char* key, double most);

}  // namespace broadside::bench
