#include "bench/bisect/state_file.hpp"

#include <nlohmann/json.hpp>

#include "core/json_depth.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench::bisect {
namespace {

using Json = nlohmann::json;

constexpr const char* kFile = "bisect.json";
constexpr const char* kStateFormat = "broadside-bisection";
constexpr int kStateVersion = 1;
constexpr std::size_t kDeepest = 8;  // nested levels that are read; the file has 4

Json json_of_seen(const std::map<std::string, Seen>& all) {
  Json rows = Json::object();
  for (const auto& [name, seen] : all)
    rows[name] = {{"judged", seen.is_judged}, {"exit", seen.exit_code}, {"reason", seen.reason}};
  return rows;
}

std::map<std::string, Seen> seen_from_json(const Json& rows) {
  std::map<std::string, Seen> all;
  for (const auto& [name, row] : rows.items())
    all[name] = {.is_judged = row.at("judged"), .exit_code = row.at("exit"), .reason = row.at("reason")};
  return all;
}

}  // namespace

core::Result<State> read_state(const std::filesystem::path& folder, const std::string& question) {
  const std::filesystem::path file = folder / kFile;
  State state{question, {}, {}};
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return state;
  const auto text = core::read_whole_file(file);
  if (!text) return text.error();
  const std::string advice = "remove the folder, or give another --out";
  if (core::json_depth(text.value()) > kDeepest)
    return core::Error{"it is damaged: it nests too deep", file.string(), advice};
  try {
    const Json document = Json::parse(text.value());
    if (document.at("format") != kStateFormat || document.at("version") != kStateVersion)
      return core::Error{"it is not a bisection of this version", file.string(), advice};
    if (document.at("question") != question)
      return core::Error{"it holds a bisection of other builds, or of another command", file.string(), advice};
    state.seen = seen_from_json(document.at("seen"));
    state.timed = seen_from_json(document.at("timed"));
  } catch (const Json::exception& e) {
    return core::Error{std::string("it is damaged: ") + e.what(), file.string(), advice};
  }
  return state;
}

core::Status write_state(const std::filesystem::path& folder, const State& state) {
  const Json document{{"format", kStateFormat},
                      {"version", kStateVersion},
                      {"question", state.question},
                      {"seen", json_of_seen(state.seen)},
                      {"timed", json_of_seen(state.timed)}};
  return core::write_whole_file(folder / kFile, document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace broadside::bench::bisect
