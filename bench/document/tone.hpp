// The color by which a cell shows its meaning.
#pragma once

#include <string_view>

namespace broadside::bench {

// A color on the page, nothing elsewhere.
enum class Tone { kPlain, kGood, kBad, kAbsent };

// As element() takes it: ".good"; "" for a plain one.
constexpr std::string_view class_of(Tone tone) {
  switch (tone) {
    case Tone::kGood:
      return ".good";
    case Tone::kBad:
      return ".bad";
    case Tone::kAbsent:
      return ".away";
    case Tone::kPlain:
      break;
  }
  return "";
}

}  // namespace broadside::bench
