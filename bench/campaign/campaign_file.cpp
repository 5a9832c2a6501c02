#include "bench/campaign/campaign_file.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "bench/campaign/job.hpp"
#include "bench/campaign/varied_values.hpp"
#include "bench/job_kinds.hpp"
#include "datasets/scene_file/document.hpp"
#include "datasets/scene_file/table_reader.hpp"

namespace broadside::bench::campaign {
namespace {

using datasets::FileErrors;
using datasets::Node;
using datasets::TableReader;

using Choice = std::map<std::string, std::string>;

bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
}

// Every combination of values; the first key changes slowest.
std::vector<Choice> choices(const Values& values) {
  std::vector<Choice> all{{}};
  for (const auto& [key, list] : values) {
    std::vector<Choice> next;
    for (const Choice& choice : all)
      for (const std::string& value : list) {
        next.push_back(choice);
        next.back()[key] = value;
      }
    all = std::move(next);
  }
  return all;
}

// The keys between braces, in a text such as "freefall:cube:{n}".
std::set<std::string> placeholders(const std::string& text) {
  std::set<std::string> found;
  for (std::size_t at = 0; (at = text.find('{', at)) != std::string::npos; ++at) {
    const std::size_t end = text.find('}', at);
    if (end == std::string::npos) break;
    found.insert(text.substr(at + 1, end - at - 1));
  }
  return found;
}

std::string replaced(std::string text, const Choice& choice) {
  for (const auto& [key, value] : choice) {
    const std::string mark = "{" + key + "}";
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += value.size())
      text.replace(at, mark.size(), value);
  }
  return text;
}

struct Wanted {
  std::vector<std::string> scenes;
  std::vector<std::string> engines;
  Values values;
  CellWork each;
};

void check_placeholders(const Wanted& wanted, const TableReader& table, FileErrors& errors) {
  std::set<std::string> used;
  for (const auto* list : {&wanted.scenes, &wanted.engines})
    for (const std::string& text : *list) used.merge(placeholders(text));
  for (const std::string& key : used)
    if (!wanted.values.contains(key))
      errors.add(table.line(), "{" + key + "} has no values", "add " + key + " = [...] under [vary]");
  for (const auto& [key, list] : wanted.values)
    if (!used.contains(key))
      errors.add(table.line(), "[vary] " + key + " is used by no scene and no engine",
                 "write {" + key + "} where it belongs");
}

std::vector<CellWork> expanded(const Wanted& wanted) {
  std::vector<CellWork> cells;
  for (const std::string& scene : wanted.scenes)
    for (const Choice& choice : choices(wanted.values))
      for (const std::string& engine : wanted.engines) {
        CellWork work = wanted.each;
        work.scene = replaced(scene, choice);
        work.engine = replaced(engine, choice);
        // A value that this scene and engine do not use would give the same cell twice.
        if (std::find(cells.begin(), cells.end(), work) == cells.end()) cells.push_back(work);
      }
  return cells;
}

}  // namespace

core::Result<CampaignFile> read_campaign_file(const std::filesystem::path& file) {
  auto document = datasets::parse_toml(file, "campaign file");
  if (!document) return document.error();
  FileErrors errors{file.string(), std::nullopt};
  TableReader table(document.value(), "the campaign", errors);
  CampaignFile campaign;
  Wanted wanted;
  table.text("name", campaign.name);
  if (!is_name(campaign.name))
    errors.add(table.line(), "name is not 1 to 64 letters, digits, - and _", "give for example name = \"nightly\"");
  for (const JobKind& kind : job_kinds()) {
    if (!table.has(kind.key)) continue;
    auto job = kind.read(table, errors);
    if (!job) return job.error();
    campaign.job = std::move(job).value();
    table.finish();
    if (errors.first) return *errors.first;
    return campaign;
  }
  table.texts("scenes", wanted.scenes);
  table.texts("engines", wanted.engines);
  table.whole("frames", 1U, kMostFrames, wanted.each.frames);
  table.whole("repetitions", 0U, kMostRepetitions, wanted.each.repetitions);
  table.whole("processes", 1U, kMostRepetitions, wanted.each.processes);
  table.text("against", wanted.each.against);
  table.flag("stand_in", wanted.each.stand_in);
  table.positive("time_limit_s", wanted.each.time_limit_s);
  if (wanted.each.time_limit_s > kLongestLimit_s)
    errors.add(table.line(), "time_limit_s is longer than 1e7 seconds",
               "give the seconds that a part of a cell may take");
  wanted.values = read_values(table.table("vary"), errors);
  table.finish();
  if (wanted.scenes.empty()) errors.add(table.line(), "there is no scene", "add scenes = [\"freefall:cube:50\"]");
  if (wanted.engines.empty()) errors.add(table.line(), "there is no engine", "add engines = [\"octree-cpu\"]");
  check_placeholders(wanted, table, errors);
  if (errors.first) return *errors.first;
  campaign.cells = expanded(wanted);
  return campaign;
}

}  // namespace broadside::bench::campaign
