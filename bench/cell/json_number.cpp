#include "bench/cell/json_number.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace broadside::bench {
namespace {

using Json = nlohmann::json;

std::string shown(const Json& value) {
  return value.is_number() ? value.dump() : std::string("a value of type ") + value.type_name();
}

}  // namespace

std::uint32_t whole_number(const Json& row, const char* key, std::uint32_t least, std::uint32_t most) {
  const Json& value = row.at(key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() < least || value.get<std::uint64_t>() > most)
    throw RefusedNumber{fmt::format("{} is {}, not a whole number from {} to {}", key, shown(value), least, most)};
  return value.get<std::uint32_t>();
}

double positive_number(const Json& row, const char* key, double most) {
  const Json& value = row.at(key);
  if (!value.is_number() || !(value.get<double>() > 0.0) || value.get<double>() > most)
    throw RefusedNumber{fmt::format("{} is {}, not a number above 0 and up to {:g}", key, shown(value), most)};
  return value.get<double>();
}

}  // namespace broadside::bench
