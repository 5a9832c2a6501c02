#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/bisect/bisection.hpp"

namespace broadside::bench::bisect {
namespace {

using Json = nlohmann::json;

// Where the results of a build lie.
std::string results(const Question& question, const Answer& answer, const Build& build) {
  return (question.folder / (answer.quantity == Quantity::kTime ? "times" : "builds") / build.name).string();
}

std::string subject(const Difference& d) {
  std::string text;
  for (const std::string& part : {d.scene, d.label})
    if (!part.empty()) text += part + ", ";
  return text + d.subject;
}

std::string headline(const Builds& builds, const Answer& answer) {
  const auto& list = builds.list();
  const std::string_view word = quantity_word(answer.quantity);
  switch (answer.ending) {
    case Ending::kFound:
      if (answer.where.unknown.empty())
        return fmt::format("{}: the first build that changes it is {}", word, list[answer.where.first_changed].title);
      return fmt::format(
          "{}: {} builds may be the first that changes it, because some builds between good and bad cannot be judged",
          word, answer.where.unknown.size() + 1);
    case Ending::kSame:
      return fmt::format("{}: no change from {} to {}", word, list.front().title, list.back().title);
    case Ending::kUnsteady:
      return fmt::format("{}: the good build differs from itself, so a difference says nothing about builds", word);
    case Ending::kUntold:
      return fmt::format("{}: cannot be decided: {}", word, answer.reason);
  }
  return {};
}

constexpr std::size_t kMostDifferences = 12;  // in text; the JSON has all

std::string body(const Builds& builds, const Question& question, const Answer& answer) {
  if (answer.ending != Ending::kFound && answer.ending != Ending::kUnsteady) return {};
  const auto& list = builds.list();
  std::string text;
  if (answer.ending == Ending::kFound) {
    const Build& before = list[answer.where.last_unchanged];
    const Build& after = list[answer.where.first_changed];
    text += fmt::format("  last unchanged: {}  ({})\n", before.title, results(question, answer, before));
    for (const std::size_t k : answer.where.unknown) text += fmt::format("  not judged:     {}\n", list[k].title);
    text += fmt::format("  first changed:  {}  ({})\n", after.title, results(question, answer, after));
  }
  for (std::size_t k = 0; k < answer.differences.size(); ++k) {
    const Difference& d = answer.differences[k];
    if (k == kMostDifferences) {
      text += fmt::format("  and {} more\n", answer.differences.size() - k);
      break;
    }
    text += fmt::format("  {}\n    before: {}\n    since:  {}\n", subject(d), d.was, d.is);
  }
  return text;
}

Json build_json(const Build& build) {
  return {{"name", build.name}, {"title", build.title}, {"identity", build.identity}};
}

Json answer_json(const Builds& builds, const Question& question, const Answer& answer) {
  constexpr std::string_view kEndings[] = {"found", "same", "unsteady", "untold"};
  Json row{{"quantity", quantity_word(answer.quantity)},
           {"ending", kEndings[static_cast<std::size_t>(answer.ending)]},
           {"reason", answer.reason},
           {"differences", Json::array()}};
  for (const Difference& d : answer.differences)
    row["differences"].push_back(
        {{"scene", d.scene}, {"label", d.label}, {"subject", d.subject}, {"was", d.was}, {"is", d.is}});
  if (answer.ending != Ending::kFound) return row;
  const Build& before = builds.list()[answer.where.last_unchanged];
  const Build& after = builds.list()[answer.where.first_changed];
  row["last_unchanged"] = build_json(before);
  row["first_changed"] = build_json(after);
  row["last_unchanged"]["results"] = results(question, answer, before);
  row["first_changed"]["results"] = results(question, answer, after);
  row["not_judged"] = Json::array();
  for (const std::size_t k : answer.where.unknown) row["not_judged"].push_back(build_json(builds.list()[k]));
  row["traces"] = answer.traces;
  return row;
}

}  // namespace

std::string bisection_text(const Builds& builds, const Question& question, const Bisection& bisection) {
  std::string text;
  for (const Answer& answer : bisection.answers)
    text += headline(builds, answer) + "\n" + body(builds, question, answer);
  for (const std::string& line : bisection.skipped) text += "skipped: " + line + "\n";
  return text;
}

std::string bisection_json(const Builds& builds, const Question& question, const Bisection& bisection) {
  Json document{{"format", "broadside-bisection-result"},
                {"version", 1},
                {"exit", static_cast<int>(bisection.exit())},
                {"command", question.command},
                {"builds", builds.list().size()},
                {"skipped", bisection.skipped},
                {"answers", Json::array()}};
  for (const Answer& answer : bisection.answers) document["answers"].push_back(answer_json(builds, question, answer));
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string bisection_markdown(const Builds& builds, const Question& question, const Bisection& bisection) {
  std::string text = fmt::format("# Bisection of {} builds\n\nThe command, on each build:\n\n    {}\n",
                                 builds.list().size(), question.command);
  for (const Answer& answer : bisection.answers) {
    text += fmt::format("\n## {}\n", headline(builds, answer));
    if (const std::string sides = body(builds, question, answer); !sides.empty()) text += "\n```\n" + sides + "```\n";
    if (!answer.traces.empty())
      text += "\nWhere the traces of both builds first differ (A: last unchanged, B: first changed):\n\n```\n" +
              answer.traces + "```\n";
  }
  if (!bisection.skipped.empty()) text += "\n## Builds that were skipped\n\n";
  for (const std::string& line : bisection.skipped) text += "- " + line + "\n";
  return text;
}

}  // namespace broadside::bench::bisect
