// A check of option values with a clear message: the option library's own prints the largest double, all 309 digits.
#pragma once

#include <string>

namespace broadside::bench {

// Empty when the text is a number above zero, else what is wrong with it. For CLI::Option::check.
std::string more_than_zero(const std::string& text);

}  // namespace broadside::bench
