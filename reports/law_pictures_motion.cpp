// Pictures of the laws of mechanics that look at how bodies move.
#include "reports/law_pictures.hpp"

namespace broadside::reports {
namespace {

constexpr LawPicture kMotionPictures[] = {
    {"ballistic",
     [] {
       // Free flight is a parabola.
       LawSketch s;
       s.path({{8, 50}, {22, 33}, {36, 21}, {50, 14}, {64, 12}, {78, 15}, {92, 23}, {106, 36}}, Ink::kGhost);
       s.ball({22, 33}, 6, Ink::kGhost).ball({64, 12}, 6, Ink::kGhost).ball({106, 36}, 6);
       return s.arrow({64, 22}, {64, 48}).text({74, 44}, "g");
     }},
    {"turning",
     [] {
       // The body turns by h times its angular velocity.
       LawSketch s;
       s.box({34, 24}, 48, 22, Ink::kGhost).box({34, 24}, 48, 22, Ink::kBody, -35);
       return s.turn({58, 35}, 32, 0, -35).text({104, 18}, "h \xCF\x89");
     }},
    {"gyroscopic",
     [] {
       // Axis and angular velocity wander about an angular momentum that stays.
       LawSketch s;
       s.box({44, 20}, 18, 40, Ink::kBody, 28).arrow({53, 60}, {53, 6}).text({44, 10}, "L");
       return s.arrow({53, 40}, {80, 14}, Ink::kLine)
           .text({88, 14}, "\xCF\x89", Ink::kLine)
           .turn({53, 16}, 20, 20, -30, Ink::kLine);
     }},
    {"momentum",
     [] {
       // What one gains, the other loses.
       LawSketch s;
       s.ball({41, 30}, 16).ball({73, 30}, 16).dot({57, 30}).arrow({54, 62}, {18, 62}).arrow({60, 62}, {98, 62});
       return s.text({14, 56}, "-J").text({102, 56}, "J");
     }},
    {"angular-momentum",
     [] {
       // An impulse turns by its arm.
       LawSketch s;
       s.box({24, 26}, 64, 22)
           .dot({56, 37}, Ink::kLine)
           .line({56, 37}, {84, 37}, Ink::kForce)
           .arrow({84, 68}, {84, 48});
       return s.turn({56, 37}, 22, -20, -110).text({94, 64}, "J").text({76, 34}, "r");
     }},
    {"energy-growth",
     [] {
       // Without motors the energy goes down or stays.
       LawSketch s;
       s.line({14, 8}, {14, 62}).line({14, 62}, {110, 62});
       s.path({{14, 16}, {38, 16}, {38, 30}, {62, 30}, {62, 44}, {104, 44}}, Ink::kForce);
       return s.arrow({62, 44}, {96, 18}, Ink::kWrong).text({22, 10}, "E", Ink::kLine);
     }},
    {"rest",
     [] {
       // What stands by statics stays.
       LawSketch s;
       s.ground(62).box({44, 44}, 32, 18).box({44, 26}, 32, 18).box({44, 8}, 32, 18);
       return s.box({56, 8}, 32, 18, Ink::kGhost).no({98, 17});
     }},
    {"closed-form",
     [] {
       // The run lies on the curve of the exact answer.
       LawSketch s;
       s.line({12, 62}, {112, 62}).path({{12, 56}, {30, 50}, {48, 40}, {66, 27}, {84, 17}, {106, 11}}, Ink::kGhost);
       return s.dot({30, 49}).dot({48, 41}).dot({66, 26}).dot({84, 18}).text({34, 22}, "f(t)", Ink::kLine);
     }},
};

}  // namespace

std::span<const LawPicture> pictures_of_motion() {
  return kMotionPictures;
}

}  // namespace broadside::reports
