#include "bench/agree/answers.hpp"

#include <utility>

#include "bench/agree/child.hpp"
#include "bench/process/shared_array.hpp"

namespace broadside::bench {

core::Result<Answers> ask(const CellSpec& cell, const PairSource& source, const std::vector<TestPair>& pairs,
                          const AskLimits& limits, const std::function<void(std::uint64_t)>& progress) {
  const auto said =
      said_by_child(cell.row->id, limits, [&](ChildReport& report) { return describe_engine(cell, source, report); });
  if (!said) return said.error();
  EngineWords words = engine_words(said.value());
  Answers out;
  out.build = std::move(words.build);
  out.notes = std::move(words.notes);
  SharedArray<PairAnswer> answers(pairs.size());
  const auto live = [&](ChildReport& report, std::size_t next, std::size_t last) {
    return ask_pairs(cell, source, pairs, next, last, answers.all(), report);
  };
  const auto on_death = [&](std::size_t at, Asked fate, const std::string& last_words) {
    ++out.words[last_words];
    answers[at].asked = fate;
  };
  if (core::Status s = ask_in_children(cell.row->id, pairs.size(), limits, live, on_death, progress); !s)
    return s.error();
  out.of_pair.assign(answers.all().begin(), answers.all().end());
  for (const PairAnswer& answer : out.of_pair)
    if (answer.asked == Asked::kThrew) ++out.words[answer.thrown.data()];
  return out;
}

}  // namespace broadside::bench
