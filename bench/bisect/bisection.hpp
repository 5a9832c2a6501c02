// Which build is the first that changes a verdict, contacts, a digest, a counter, a time or an exit code.
#pragma once

#include <string>
#include <vector>

#include "bench/bisect/builds.hpp"
#include "bench/bisect/first_changed.hpp"
#include "bench/bisect/observer.hpp"
#include "bench/bisect/quantity.hpp"
#include "core/result.hpp"

namespace broadside::bench::bisect {

enum class Ending {
  kFound,
  kSame,      // the bad build does not differ from the good one in this quantity
  kUnsteady,  // the good build differs from itself, so a difference says nothing about builds
  kUntold,    // one of the two ends cannot be judged
};

struct Answer {
  Quantity quantity = Quantity::kVerdict;
  Ending ending = Ending::kSame;
  FirstChanged where;                   // of kFound
  std::vector<Difference> differences;  // kFound: of the first changed build against the good one; kUnsteady: of the
                                        // good build against itself
  std::string traces;                   // kFound: where their traces first differ, in the words of 'diff'; may be empty
  std::string reason;                   // of kUntold
};

struct Bisection {
  std::vector<Answer> answers;  // one for each quantity that was asked for
  std::vector<std::string> skipped;

  // kFailed when a change was found; otherwise kMissing when something could not be decided; otherwise kGood. A change
  // whose build is not certain, because neighboring builds cannot be judged, is kMissing.
  [[nodiscard]] core::Exit exit() const;
};

// One search for each quantity; the searches share what is observed of each build. The good build is observed twice, so
// that a result that changes from run to run is not blamed on a build.
core::Result<Bisection> bisect(Builds& builds, const Question& question);

// As text: one paragraph for each quantity, with both sides of each change. Ends with a newline.
std::string bisection_text(const Builds& builds, const Question& question, const Bisection& bisection);
// {"format": "broadside-bisection-result", "version": 1, "exit": 1, "answers": [...]}.
std::string bisection_json(const Builds& builds, const Question& question, const Bisection& bisection);
// The page in the bisection's folder, as Markdown: the same, with the first difference of the traces.
std::string bisection_markdown(const Builds& builds, const Question& question, const Bisection& bisection);

}  // namespace broadside::bench::bisect
