#include "reports/law_pictures.hpp"

namespace broadside::reports {

std::string law_picture(std::string_view law) {
  for (const auto& pictures :
       {pictures_of_traces(), pictures_of_the_method(), pictures_of_motion(), pictures_of_contacts()})
    for (const LawPicture& picture : pictures)
      if (picture.law == law) return picture.draw().svg();
  return "";
}

}  // namespace broadside::reports
