#include "bench/campaign/campaign_file.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <utility>

#include "datasets/scene_file/document.hpp"
#include "datasets/scene_file/table_reader.hpp"

namespace broadside::bench::campaign {
namespace {

using datasets::FileErrors;
using datasets::Node;
using datasets::TableReader;

using Values = std::map<std::string, std::vector<std::string>>;
using Choice = std::map<std::string, std::string>;

bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
}

Values read_values(const Node* vary, FileErrors& errors) {
  Values values;
  if (vary == nullptr) return values;
  for (const auto& [key, node] : vary->members) {
    std::vector<std::string>& list = values[key];
    for (const Node& item : node.items) {
      if (item.kind == Node::Kind::kText) list.push_back(item.text);
      if (item.kind == Node::Kind::kWhole) list.push_back(std::to_string(item.whole));
    }
    if (node.kind != Node::Kind::kArray || list.empty() || list.size() != node.items.size())
      errors.add(node.line, "[vary] " + key + " is not a list of texts or whole numbers",
                 "give for example n = [50, 100]");
  }
  return values;
}

// Every combination, the first key changing slowest.
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

// 0 when it is no count of bodies.
std::uint32_t count_of(const std::string& text) {
  std::uint32_t count = 0;
  const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), count);
  return bad == std::errc() && end == text.data() + text.size() ? count : 0;
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

// The remaining keys of a file that names experiments of the paper.
core::Status read_paper(TableReader& table, paper::PaperRequest& request, FileErrors& errors) {
  std::string engine;
  table.text("engine", engine);
  table.whole("frames", 1U, 1'000'000U, request.plan.frames);
  table.whole("repetitions", 1U, 10'000U, request.plan.runs);
  table.flag("stand_in", request.allow_stand_in);
  table.positive("limit_s", request.plan.limit_s);
  for (const auto& [key, list] : read_values(table.table("vary"), errors)) {
    if (key == "models") request.plan.models = list;
    if (key == "counts")
      for (const std::string& text : list) request.plan.counts.push_back(count_of(text));
    if (key != "models" && key != "counts")
      errors.add(table.line(), "[vary] " + key + " is nothing that the paper varies", "vary models and counts");
  }
  if (std::count(request.plan.counts.begin(), request.plan.counts.end(), 0U) > 0)
    errors.add(table.line(), "[vary] counts has an entry that is not a whole number above 0",
               "give for example counts = [50]");
  if (errors.first) return *errors.first;
  auto device = paper::choose_device(engine);
  if (!device) return device.error();
  request.device = std::move(device).value();
  return core::Done{};
}

}  // namespace

core::Result<CampaignFile> read_campaign_file(const std::filesystem::path& file) {
  auto document = datasets::parse_toml(file);
  if (!document) return document.error();
  FileErrors errors{file.string(), std::nullopt};
  TableReader table(document.value(), "the campaign", errors);
  CampaignFile campaign;
  Wanted wanted;
  table.text("name", campaign.name);
  if (!is_name(campaign.name))
    errors.add(table.line(), "name is not 1 to 64 letters, digits, - and _", "give for example name = \"nightly\"");
  if (table.has("paper")) {
    campaign.paper.emplace();
    table.texts("paper", campaign.paper->experiments);
    if (core::Status s = read_paper(table, *campaign.paper, errors); !s) return s.error();
    table.finish();
    if (errors.first) return *errors.first;
    return campaign;
  }
  table.texts("scenes", wanted.scenes);
  table.texts("engines", wanted.engines);
  table.whole("frames", 1U, 1'000'000'000U, wanted.each.frames);
  table.whole("repetitions", 0U, 10'000U, wanted.each.repetitions);
  table.whole("processes", 1U, 10'000U, wanted.each.processes);
  table.text("against", wanted.each.against);
  table.flag("stand_in", wanted.each.stand_in);
  table.positive("time_limit_s", wanted.each.time_limit_s);
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
