#include "bench/cell/more_than_zero.hpp"

#include <charconv>

namespace broadside::bench {

std::string more_than_zero(const std::string& text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  const bool is_number = read.ec == std::errc() && read.ptr == end;
  return is_number && value > 0.0 ? std::string() : text + " is not a number above zero";
}

}  // namespace broadside::bench
