// A small picture of a law, shown beside the sentence that explains it.
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

// The laws of one kind; each kind has a file.
std::span<const LawPicture> pictures_of_traces();
std::span<const LawPicture> pictures_of_the_method();
std::span<const LawPicture> pictures_of_motion();
std::span<const LawPicture> pictures_of_contacts();

// The picture of a law; empty when there is none.
std::string law_picture(std::string_view law);

}  // namespace broadside::reports
