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
  kSame,      // the bad build is as the good one in this
  kUnsteady,  // the good build differs from itself, so a difference says nothing about builds
  kUntold,    // one of the two ends cannot be judged
};

struct Answer {
  Quantity quantity = Quantity::kVerdict;
  Ending ending = Ending::kSame;
  FirstChanged where;                   // of kFound
  std::vector<Difference> differences;  // kFound: of the first changed build against the good one; kUnsteady: of the
                                        // good build against itself
  std::string traces;                   // kFound: where their traces part, in the words of 'diff'; may be empty
  std::string reason;                   // of kUntold
};

struct Bisection {
  std::vector<Answer> answers;  // one a quantity that was asked for
  std::vector<std::string> skipped;

  // kFailed when a change was found; otherwise kMissing when something could not be told; otherwise kGood. A change
  // whose place is not certain, because builds beside it cannot be judged, is kMissing.
  [[nodiscard]] core::Exit exit() const;
};

// One search a quantity; they share what each build shows. The good build is observed twice, so that what changes by
// itself is not blamed on a build.
core::Result<Bisection> bisect(Builds& builds, const Question& question);

// In words: one paragraph a quantity, with both sides of each change. Ends with a newline.
std::string bisection_text(const Builds& builds, const Question& question, const Bisection& bisection);
// {"format": "broadside-bisection-result", "version": 1, "exit": 1, "answers": [...]}.
std::string bisection_json(const Builds& builds, const Question& question, const Bisection& bisection);
// The page that goes with the folder: the same with the first divergence of the traces, as Markdown.
std::string bisection_markdown(const Builds& builds, const Question& question, const Bisection& bisection);

}  // namespace broadside::bench::bisect
