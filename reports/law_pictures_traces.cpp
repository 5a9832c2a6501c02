// Pictures of the laws of a trace: pairs, states, digests, repetition.
#include "reports/law_pictures.hpp"

namespace broadside::reports {
namespace {

constexpr LawPicture kTracesPictures[] = {
    {"candidate-set",
     [] {
       // Two boxes that overlap are a pair; a box apart is in none.
       LawSketch s;
       s.box({12, 14}, 34, 26).box({34, 28}, 30, 28).box({82, 20}, 26, 26, Ink::kGhost);
       return s.arrow({30, 64}, {30, 44}).arrow({50, 64}, {50, 59}).line({30, 64}, {50, 64}, Ink::kForce);
     }},
    {"capacity",
     [] {
       // A list with room left.
       LawSketch s;
       for (int k = 0; k < 6; ++k) s.box({12.0 + 16 * k, 26}, 16, 18, k < 4 ? Ink::kBody : Ink::kGhost);
       return s.line({12, 54}, {76, 54}, Ink::kForce).text({44, 66}, "demanded").text({92, 20}, "stored", Ink::kLine);
     }},
    {"state-sanity",
     [] {
       // A state follows from the one before; it cannot be no number.
       LawSketch s;
       s.box({8, 22}, 26, 26).arrow({38, 35}, {56, 35}).box({60, 22}, 26, 26).text({103, 54}, "NaN", Ink::kLine);
       return s.text({21, 62}, "k", Ink::kLine).text({73, 62}, "k + 1", Ink::kLine).no({103, 34});
     }},
    {"recording",
     [] {
       // A strip of frames with none left out.
       LawSketch s;
       s.box({8, 20}, 104, 32, Ink::kGhost);
       for (int k = 0; k < 4; ++k) s.box({13.0 + 25 * k, 25}, 20, 22);
       return s.text({23, 64}, "1", Ink::kLine)
           .text({48, 64}, "2", Ink::kLine)
           .text({73, 64}, "3", Ink::kLine)
           .text({98, 64}, "4", Ink::kLine);
     }},
    {"frame-digest",
     [] {
       // A frame, and the number computed from it.
       LawSketch s;
       s.box({10, 16}, 40, 40, Ink::kGhost).ball({24, 42}, 7).box({30, 26}, 14, 14).arrow({56, 36}, {72, 36});
       return s.text({94, 40}, "0x3f9a");
     }},
    {"determinism",
     [] {
       // Two runs, one path.
       LawSketch s;
       s.path({{10, 52}, {30, 24}, {50, 46}, {70, 20}, {90, 40}, {108, 30}}, Ink::kForce);
       return s.path({{10, 56}, {30, 28}, {50, 50}, {70, 24}, {90, 44}, {108, 34}}, Ink::kGhost)
           .text({60, 66}, "1 = 2", Ink::kLine);
     }},
    {"metamorphic",
     [] {
       // A scene and its mirror image have mirrored outcomes.
       LawSketch s;
       s.line({60, 6}, {60, 66}, Ink::kGhost);
       s.shape({{14, 50}, {48, 50}, {22, 20}}).shape({{106, 50}, {72, 50}, {98, 20}}, Ink::kGhost);
       return s.arrow({22, 14}, {46, 14}).arrow({98, 14}, {74, 14});
     }},
};

}  // namespace

std::span<const LawPicture> pictures_of_traces() {
  return kTracesPictures;
}

}  // namespace broadside::reports
