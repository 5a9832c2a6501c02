// Pictures of the laws of mechanics that look at contacts and shapes.
#include "reports/law_pictures.hpp"

namespace broadside::reports {
namespace {

constexpr LawPicture kContactsPictures[] = {
    {"friction-cone",
     [] {
       // The impulse lies in the cone about the normal.
       LawSketch s;
       s.ground(60).shape({{60, 60}, {38, 14}, {82, 14}}, Ink::kBody).line({60, 60}, {60, 8}, Ink::kGhost);
       return s.arrow({60, 60}, {70, 20}).arrow({60, 60}, {100, 36}, Ink::kWrong).text({58, 12}, "n", Ink::kLine);
     }},
    {"unilateral",
     [] {
       // No impulse across a gap.
       LawSketch s;
       s.ground(60).ball({60, 26}, 15).line({60, 41}, {60, 60}, Ink::kGhost).arrow({84, 60}, {84, 40}, Ink::kWrong);
       return s.no({84, 50}).text({48, 54}, "gap", Ink::kLine);
     }},
    {"contact-truth",
     [] {
       // Overlapping shapes have a point, with the true depth and normal.
       LawSketch s;
       s.ball({44, 40}, 24).ball({80, 40}, 20).dot({64, 40}).arrow({64, 40}, {34, 40});
       return s.line({60, 12}, {68, 12}, Ink::kForce)
           .line({60, 9}, {60, 15}, Ink::kForce)
           .line({68, 9}, {68, 15}, Ink::kForce)
           .text({34, 34}, "n");
     }},
    {"penetration",
     [] {
       // How deep a body sits in the ground or in another.
       LawSketch s;
       s.box({34, 18}, 44, 44).ground(50);
       return s.arrow({92, 34}, {92, 49})
           .line({78, 62}, {98, 62}, Ink::kGhost)
           .arrow({92, 78}, {92, 63})
           .text({106, 60}, "d");
     }},
    {"passage",
     [] {
       // Nothing goes through a wall between two frames.
       LawSketch s;
       s.box({56, 6}, 8, 60).ball({24, 36}, 9).ball({98, 36}, 9, Ink::kGhost).arrow({34, 36}, {86, 36}, Ink::kWrong);
       return s.no({60, 14});
     }},
    {"box-contains",
     [] {
       // The box of a turned body still contains it.
       LawSketch s;
       s.box({30, 25}, 60, 22, Ink::kBody, 25);
       return s.box({28, 11}, 64, 50, Ink::kGhost);
     }},
};

}  // namespace

std::span<const LawPicture> pictures_of_contacts() {
  return kContactsPictures;
}

}  // namespace broadside::reports
