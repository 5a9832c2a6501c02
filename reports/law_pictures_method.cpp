// Pictures of the laws of the published method.
#include "reports/law_pictures.hpp"

namespace broadside::reports {
namespace {

constexpr LawPicture kMethodPictures[] = {
    {"level-agreement",
     [] {
       // Boxes within boxes: the smallest that overlap confirm the pair.
       LawSketch s;
       s.box({14, 8}, 48, 48, Ink::kGhost).box({38, 32}, 24, 24, Ink::kGhost).box({50, 44}, 12, 12);
       return s.box({56, 38}, 48, 30, Ink::kGhost).box({56, 42}, 14, 14);
     }},
    {"proximity-bound",
     [] {
       // The nearest vertices are hardly farther apart than the surfaces.
       LawSketch s;
       s.shape({{12, 16}, {44, 28}, {44, 46}, {12, 60}}).shape({{108, 14}, {72, 24}, {72, 52}, {108, 62}});
       return s.dot({44, 28}).dot({72, 24}).line({44, 28}, {72, 24}, Ink::kForce).text({58, 18}, "d");
     }},
    {"contact-set",
     [] {
       // Bodies that touch have one contact, others none.
       LawSketch s;
       s.ball({30, 30}, 18).ball({62, 38}, 16).dot({47.5, 34.5});
       return s.box({86, 24}, 22, 22, Ink::kGhost).text({60, 68}, "1", Ink::kForce).text({97, 62}, "0", Ink::kLine);
     }},
    {"contact-normal",
     [] {
       // Along the axis of least overlap, from B to A.
       LawSketch s;
       s.box({34, 10}, 44, 26).box({24, 30}, 64, 28).arrow({60, 44}, {60, 18});
       return s.text({45, 24}, "A", Ink::kLine).text({34, 50}, "B", Ink::kLine).text({70, 24}, "n");
     }},
    {"contraction",
     [] {
       // The depth shrinks by one factor, never below the slop.
       LawSketch s;
       s.box({14, 12}, 20, 48).box({50, 30}, 20, 30).box({86, 41}, 20, 19);
       return s.line({8, 50}, {112, 50}, Ink::kForce).text({24, 70}, "d", Ink::kLine).text({114, 47}, "\xCE\xB4");
     }},
    {"center-of-mass",
     [] {
       // Both bodies move, their common center does not.
       LawSketch s;
       s.ball({34, 36}, 18).ball({78, 36}, 11).arrow({30, 60}, {20, 60}).arrow({82, 60}, {104, 60});
       return s.dot({52, 36}).line({52, 14}, {52, 58}, Ink::kForce);
     }},
    {"restitution",
     [] {
       // It leaves with e times the speed at which it came.
       LawSketch s;
       s.ground(58).ball({60, 46}, 12).arrow({36, 12}, {36, 50}).arrow({84, 50}, {84, 30});
       return s.text({24, 34}, "v").text({98, 44}, "e v");
     }},
    {"normal-energy",
     [] {
       // Not more after the impulse than before.
       LawSketch s;
       s.box({26, 14}, 22, 46).box({72, 28}, 22, 32).line({18, 60}, {102, 60});
       return s.arrow({60, 18}, {60, 28}).text({37, 70}, "before", Ink::kLine).text({83, 70}, "after", Ink::kLine);
     }},
    {"friction-energy",
     [] {
       // Against the sliding, and no more than mu times the normal impulse.
       LawSketch s;
       s.ground(56).box({38, 26}, 40, 30).arrow({82, 40}, {106, 40}, Ink::kLine).arrow({38, 50}, {14, 50});
       return s.text({96, 34}, "v", Ink::kLine).text({24, 44}, "J");
     }},
    {"energy",
     [] {
       // The parts add up to the change.
       LawSketch s;
       s.box({18, 18}, 24, 16).box({18, 34}, 24, 10).box({18, 44}, 24, 16).box({78, 18}, 24, 42);
       return s.text({60, 43}, "=", Ink::kForce);
     }},
    {"velocity-cap",
     [] {
       // No component beyond v_max.
       LawSketch s;
       s.box({34, 10}, 52, 52, Ink::kGhost).arrow({60, 36}, {78, 20}).arrow({60, 36}, {102, 50}, Ink::kWrong);
       return s.dot({60, 36}).text({48, 22}, "v max", Ink::kLine);
     }},
    {"stability",
     [] {
       // A body on a spring swings, and does not fly apart.
       LawSketch s;
       s.ground(62).path({{60, 62}, {52, 57}, {68, 51}, {52, 45}, {68, 39}, {60, 34}}, Ink::kLine);
       return s.box({48, 14}, 24, 20)
           .arrow({86, 34}, {86, 16})
           .arrow({86, 16}, {86, 34})
           .text({102, 29}, "h", Ink::kForce);
     }},
    {"octree-invariants",
     [] {
       // Children tile the parent; a body lies in the smallest that contains it.
       LawSketch s;
       s.box({34, 8}, 56, 56, Ink::kGhost).line({62, 8}, {62, 64}).line({34, 36}, {90, 36});
       return s.line({76, 8}, {76, 36}).line({62, 22}, {90, 22}).box({78, 11}, 9, 8).box({40, 42}, 16, 14);
     }},
};

}  // namespace

std::span<const LawPicture> pictures_of_the_method() {
  return kMethodPictures;
}

}  // namespace broadside::reports
