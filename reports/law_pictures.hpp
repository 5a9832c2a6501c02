// A small picture of what a law says, beside its sentence on the page.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "reports/law_sketch.hpp"

namespace broadside::reports {

struct LawPicture {
  std::string_view law;  // the validator's name
  LawSketch (*draw)();
};

// Laws of one kind, a file each.
std::span<const LawPicture> pictures_of_traces();
std::span<const LawPicture> pictures_of_the_method();
std::span<const LawPicture> pictures_of_motion();
std::span<const LawPicture> pictures_of_contacts();

// A law without a picture of its own has none: empty.
std::string law_picture(std::string_view law);

}  // namespace broadside::reports
