#include "bench/bisect/bisection.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace broadside::bench::bisect {
namespace {

using reports::Speed;
using reports::TimeRatio;

constexpr const char* kNoRows = "the command leaves no cells.json and no verdicts.json in {out}";

bool reads_rows(Quantity quantity) {
  return quantity != Quantity::kExit && quantity != Quantity::kTime;
}

// Why this observation says nothing about the quantity; empty when it does.
std::string silence(const Shown<Observation>& shown, Quantity quantity) {
  if (shown.what == nullptr) return shown.reason;
  if (reads_rows(quantity) && !shown.what->has_rows())
    return std::string(kNoRows) + " (it exits " + std::to_string(shown.what->exit_code) + ")";
  return {};
}

// How the times of this build look: only the scenes and engines count at which the bad build has another speed.
Look look_at_times(const std::vector<TimeRatio>& bad, const std::vector<TimeRatio>& build) {
  bool is_unknown = false;
  for (const TimeRatio& wanted : bad) {
    if (wanted.speed != Speed::kSlower && wanted.speed != Speed::kFaster) continue;
    const auto same = std::find_if(build.begin(), build.end(), [&](const TimeRatio& time) {
      return time.scene == wanted.scene && time.label == wanted.label;
    });
    if (same == build.end() || same->speed == Speed::kNotComparable || same->speed == Speed::kInconclusive)
      is_unknown = true;
    else if (same->speed == wanted.speed)
      return Look::kChanged;
  }
  return is_unknown ? Look::kUnknown : Look::kUnchanged;
}

class Search {
 public:
  Search(Builds& builds, Observer& observer) : last_(builds.list().size() - 1), observer_(observer) {}

  core::Result<Answer> of(Quantity quantity) {
    Answer answer;
    answer.quantity = quantity;
    const core::Status done = quantity == Quantity::kTime ? times(answer) : rows(answer);
    if (!done) return done.error();
    return answer;
  }

 private:
  core::Status rows(Answer& answer) {
    const Quantity quantity = answer.quantity;
    const auto untold = [&](const char* who, const std::string& why) {
      answer.ending = Ending::kUntold;
      answer.reason = std::string(who) + ": " + why;
      return core::Done{};
    };
    auto good = observer_.look(0);
    if (!good) return good.error();
    if (const std::string why = silence(good.value(), quantity); !why.empty()) return untold("the good build", why);
    auto bad = observer_.look(last_);
    if (!bad) return bad.error();
    if (const std::string why = silence(bad.value(), quantity); !why.empty()) return untold("the bad build", why);
    auto control = observer_.control();
    if (!control) return control.error();
    if (const std::string why = silence(control.value(), quantity); !why.empty())
      return untold("the good build, run again", why);
    const Observation& before = *good.value().what;
    auto own = differences(before, *control.value().what, quantity);
    if (!own) return own.error();
    if (!own.value().empty()) {
      answer.ending = Ending::kUnsteady;
      answer.differences = std::move(own).value();
      return core::Done{};
    }
    auto whole = differences(before, *bad.value().what, quantity);
    if (!whole) return whole.error();
    if (whole.value().empty()) return core::Done{};
    auto found = find_first_changed(last_ + 1, [&](std::size_t k) { return look(before, k, quantity); });
    if (!found) return found.error();
    answer.ending = Ending::kFound;
    answer.where = std::move(found).value();
    return prove(before, answer);
  }

  core::Result<Look> look(const Observation& before, std::size_t k, Quantity quantity) {
    auto shown = observer_.look(k);
    if (!shown) return shown.error();
    if (!silence(shown.value(), quantity).empty()) return Look::kUnknown;
    auto other = differences(before, *shown.value().what, quantity);
    if (!other) return other.error();
    return other.value().empty() ? Look::kUnchanged : Look::kChanged;
  }

  core::Status prove(const Observation& before, Answer& answer) {
    auto first = observer_.look(answer.where.first_changed);
    if (!first) return first.error();
    auto other = differences(before, *first.value().what, answer.quantity);
    if (!other) return other.error();
    answer.differences = std::move(other).value();
    if (answer.quantity != Quantity::kDigest && answer.quantity != Quantity::kContacts) return core::Done{};
    auto last = observer_.look(answer.where.last_unchanged);
    if (!last) return last.error();
    answer.traces = traces_apart(*last.value().what, *first.value().what);
    return core::Done{};
  }

  core::Status times(Answer& answer) {
    auto bad = observer_.times(last_);
    if (!bad) return bad.error();
    if (bad.value().what == nullptr) {
      answer.ending = Ending::kUntold;
      answer.reason = "the bad build: " + bad.value().reason;
      return core::Done{};
    }
    const std::vector<TimeRatio>& whole = *bad.value().what;
    if (time_differences(whole).empty()) {
      const auto vague = std::find_if(whole.begin(), whole.end(), [](const TimeRatio& time) {
        return time.speed == Speed::kInconclusive || time.speed == Speed::kNotComparable;
      });
      if (whole.empty() || vague != whole.end()) {
        answer.ending = Ending::kUntold;
        answer.reason =
            whole.empty() ? "no time was measured" : vague->scene + ", " + vague->label + ": " + vague->reason;
      }
      return core::Done{};
    }
    auto found = find_first_changed(last_ + 1, [&](std::size_t k) -> core::Result<Look> {
      auto shown = observer_.times(k);
      if (!shown) return shown.error();
      return shown.value().what == nullptr ? Look::kUnknown : look_at_times(whole, *shown.value().what);
    });
    if (!found) return found.error();
    answer.ending = Ending::kFound;
    answer.where = std::move(found).value();
    auto first = observer_.times(answer.where.first_changed);
    if (!first) return first.error();
    answer.differences = time_differences(*first.value().what);
    return core::Done{};
  }

  std::size_t last_;
  Observer& observer_;
};

}  // namespace

core::Exit Bisection::exit() const {
  bool is_missing = false;
  bool is_found = false;
  for (const Answer& answer : answers) {
    const bool is_certain = answer.ending == Ending::kFound && answer.where.unknown.empty();
    is_found = is_found || is_certain;
    is_missing = is_missing || (answer.ending != Ending::kSame && !is_certain);
  }
  return is_found ? core::Exit::kFailed : is_missing ? core::Exit::kMissing : core::Exit::kGood;
}

core::Result<Bisection> bisect(Builds& builds, const Question& question) {
  auto observer = Observer::begin(builds, question);
  if (!observer) return observer.error();
  Bisection result;
  Search search(builds, observer.value());
  for (const Quantity quantity : question.quantities) {
    auto answer = search.of(quantity);
    if (!answer) return answer.error();
    result.answers.push_back(std::move(answer).value());
  }
  result.skipped = observer.value().skipped();
  return result;
}

}  // namespace broadside::bench::bisect
