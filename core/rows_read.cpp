// JSON to rows, trusting nothing in the file. The writer of the same files is rows_write.cpp.
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/coverage.hpp"
#include "core/rows.hpp"
#include "core/whole_file.hpp"

namespace broadside::core {
namespace {

using Json = nlohmann::json;

constexpr std::array kCellStates{CellState::kRecorded, CellState::kNotMeasured, CellState::kUnsupported,
                                 CellState::kCrashed,  CellState::kTimedOut,    CellState::kInterrupted,
                                 CellState::kFailed};
constexpr std::array kOutcomes{Outcome::kPass, Outcome::kFail, Outcome::kInconclusive, Outcome::kNotApplicable};

// Never leaves this file: thrown for a field that differs from the schema, and caught here.
struct Malformed {
  std::string where;
  std::string what;
};

// A value of the document with the path to it, for errors that name the field.
class Node {
 public:
  Node(const Json& json, std::string path) : json_(json), path_(std::move(path)) {}

  [[noreturn]] void reject(const std::string& what) const { throw Malformed{path_, what}; }

  [[nodiscard]] Node at(const char* key) const {
    if (!json_.is_object()) reject("is not an object");
    const auto found = json_.find(key);
    if (found == json_.end()) throw Malformed{path_, std::string("lacks '") + key + "'"};
    return {*found, path_ + "." + key};
  }

  [[nodiscard]] bool has(const char* key) const { return json_.is_object() && json_.contains(key); }

  [[nodiscard]] std::string text() const {
    if (!json_.is_string()) reject("is not text");
    return json_.get<std::string>();
  }

  [[nodiscard]] bool flag() const {
    if (!json_.is_boolean()) reject("is neither true nor false");
    return json_.get<bool>();
  }

  [[nodiscard]] std::uint64_t count() const {
    if (!json_.is_number_unsigned()) reject("is not a whole number of zero or more");
    return json_.get<std::uint64_t>();
  }

  [[nodiscard]] std::uint32_t count32() const {
    const std::uint64_t value = count();
    if (value > std::numeric_limits<std::uint32_t>::max()) reject("is too large");
    return static_cast<std::uint32_t>(value);
  }

  [[nodiscard]] std::int64_t step() const {
    if (!json_.is_number_integer()) reject("is not a whole number");
    if (json_.is_number_unsigned() && json_.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max())
      reject("is too large");
    return json_.get<std::int64_t>();
  }

  [[nodiscard]] double number() const {
    if (json_.is_number()) return json_.get<double>();
    if (json_ == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (json_ == "inf") return std::numeric_limits<double>::infinity();
    if (json_ == "-inf") return -std::numeric_limits<double>::infinity();
    reject("is not a number, \"nan\", \"inf\" or \"-inf\"");
  }

  [[nodiscard]] std::uint64_t digest() const {
    const std::string value = text();
    std::uint64_t digest = 0;
    const char* end = value.data() + value.size();
    if (value.size() != 18 || !value.starts_with("0x") || std::from_chars(value.data() + 2, end, digest, 16).ptr != end)
      reject("is not \"0x\" and 16 hexadecimal digits");
    return digest;
  }

  [[nodiscard]] std::vector<Node> items() const {
    if (!json_.is_array()) reject("is not an array");
    std::vector<Node> nodes;
    nodes.reserve(json_.size());
    for (std::size_t k = 0; k < json_.size(); ++k) nodes.push_back({json_[k], path_ + "[" + std::to_string(k) + "]"});
    return nodes;
  }

  [[nodiscard]] std::vector<double> numbers() const {
    if (!json_.is_array()) reject("is not an array");
    std::vector<double> values;
    values.reserve(json_.size());
    for (const Json& item : json_) values.push_back(Node(item, path_).number());
    return values;
  }

  [[nodiscard]] std::vector<std::pair<std::string, Node>> members() const {
    if (!json_.is_object()) reject("is not an object");
    std::vector<std::pair<std::string, Node>> nodes;
    for (const auto& [key, value] : json_.items()) nodes.emplace_back(key, Node(value, path_ + "." + key));
    return nodes;
  }

 private:
  const Json& json_;
  std::string path_;
};

// The enumerator with this name.
template <typename Enum, std::size_t N>
Enum word_of(const Node& node, const std::array<Enum, N>& values, std::string_view (*word)(Enum)) {
  const std::string text = node.text();
  std::string known;
  for (const Enum value : values) {
    if (word(value) == text) return value;
    known += (known.empty() ? "'" : ", '") + std::string(word(value)) + "'";
  }
  node.reject("is '" + text + "', not one of " + known);
}

void read(const Node& node, Stamp& stamp) {
  stamp.scene_name = node.at("scene_name").text();
  stamp.scene_digest = node.at("scene_digest").digest();
  stamp.engine = node.at("engine").text();
  stamp.settings = node.at("settings").text();
  stamp.settings_short = node.at("settings_short").text();
  stamp.engine_build = node.at("engine_build").text();
  stamp.broadside_build = node.at("broadside_build").text();
  stamp.machine = node.at("machine").text();
}

void read(const Node& node, Cell& cell) {
  read(node.at("stamp"), cell.stamp);
  cell.state = word_of(node.at("state"), kCellStates, cell_state_word);
  cell.reason = node.at("reason").text();
  cell.trace_file = node.at("trace_file").text();
  cell.frames = node.at("frames").count();
  cell.wall_s = node.at("wall_s").number();
  for (const auto& [key, value] : node.at("digests").members()) {
    std::uint64_t step = 0;
    const char* end = key.data() + key.size();
    if (key.empty() || std::from_chars(key.data(), end, step).ptr != end) value.reject("has a step that is no number");
    cell.digests[step] = value.digest();
  }
  // Rows of earlier builds have no counters.
  if (node.has("counters"))
    for (const auto& [key, value] : node.at("counters").members()) cell.counters[key] = value.count();
  for (const auto& [key, value] : node.at("notes").members()) cell.notes[key] = value.text();
}

// Parts have no parts, so a file cannot nest them deeper than the program writes them.
enum class Depth { kWhole, kPart };

void read(const Node& node, Verdict& verdict, Depth depth = Depth::kWhole) {
  verdict.validator = node.at("validator").text();
  verdict.outcome = word_of<Outcome>(node.at("outcome"), kOutcomes, [](Outcome o) { return outcome_word(o); });
  verdict.measured = node.at("measured").number();
  verdict.limit = node.at("limit").number();
  verdict.unit = node.at("unit").text();
  verdict.origin = node.at("origin").text();
  verdict.explanation = node.at("explanation").text();
  const Node worst = node.at("worst");
  verdict.worst.step = worst.at("step").step();
  for (const Node& body : worst.at("bodies").items()) verdict.worst.bodies.push_back(body.count32());
  verdict.worst.field = worst.at("field").text();
  verdict.checked = node.at("checked").count();
  verdict.violations = node.at("violations").count();
  verdict.baseline = node.at("baseline").text();
  // Rows of earlier builds end before this field.
  if (node.has("law")) verdict.law = node.at("law").text();
  if (node.has("kind"))
    verdict.kind = word_of<LawKind>(node.at("kind"), kLawKinds, [](LawKind k) { return law_kind_word(k); });
  if (node.has("ties_motion_to_forces")) verdict.ties_motion_to_forces = node.at("ties_motion_to_forces").flag();
  if (node.has("moved")) verdict.moved = node.at("moved").count();
  if (depth == Depth::kWhole && node.has("parts"))
    for (const Node& part : node.at("parts").items()) read(part, verdict.parts.emplace_back(), Depth::kPart);
}

void read(const Node& node, CellVerdicts& cell) {
  cell.trace_file = node.at("trace_file").text();
  read(node.at("stamp"), cell.stamp);
  for (const Node& item : node.at("verdicts").items()) read(item, cell.verdicts.emplace_back());
  if (node.has("is_simulation")) cell.is_simulation = node.at("is_simulation").flag();
  if (node.has("declaration"))
    for (const auto& [key, value] : node.at("declaration").members()) cell.declaration[key] = value.text();
}

void read(const Node& node, Sample& sample) {
  read(node.at("stamp"), sample.stamp);
  sample.repetition = node.at("repetition").count32();
  if (node.has("process")) sample.process = node.at("process").digest();
  sample.warm_up_frames = node.at("warm_up_frames").count32();
  for (const Node& item : node.at("stages").items())
    sample.stages.push_back({item.at("stage").text(), item.at("seconds").numbers()});
  sample.final_digest = node.at("final_digest").digest();
  sample.final_step = node.at("final_step").count();
}

template <typename Row>
Status read_file(const std::filesystem::path& file, const std::string& format, std::vector<Row>& rows) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return Done{};
  const Result<std::string> content = read_whole_file(file);
  if (!content) return content.error();
  try {
    const Json document = Json::parse(content.value());
    const Node root(document, "");
    if (root.at("format").text() != format) root.at("format").reject("is not \"" + format + "\"");
    if (root.at("version").count() != 1) root.at("version").reject("is not 1, the version that this build reads");
    for (const Node& item : root.at("rows").items()) read(item, rows.emplace_back());
  } catch (const Malformed& malformed) {
    const std::string field = malformed.where.empty() ? "" : ": " + malformed.where.substr(1);
    return Error{
        .what = malformed.what, .where = file.string() + field, .advice = "write the file again, or remove it"};
  } catch (const Json::exception& exception) {
    // nlohmann's "[json.exception.parse_error.101] parse error at line 1, column 3: ..." without its tag.
    std::string what = exception.what();
    if (const std::size_t tag = what.find("] "); tag != std::string::npos) what.erase(0, tag + 2);
    return Error{
        .what = "is not JSON: " + what, .where = file.string(), .advice = "write the file again, or remove it"};
  }
  return Done{};
}

}  // namespace

Result<std::vector<Sample>> read_samples(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    return Error{.what = "no such file", .where = file.string(), .advice = "name a file that time wrote"};
  std::vector<Sample> samples;
  if (Status s = read_file(file, "broadside-samples", samples); !s) return s.error();
  return samples;
}

Result<RunRows> read_rows(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    return Error{.what = "is not a folder", .where = folder.string(), .advice = "give the output folder of a run"};
  RunRows rows;
  if (Status s = read_file(folder / "cells.json", "broadside-cells", rows.cells); !s) return s.error();
  if (Status s = read_file(folder / "verdicts.json", "broadside-verdicts", rows.verdicts); !s) return s.error();
  if (Status s = read_file(folder / "samples.json", "broadside-samples", rows.samples); !s) return s.error();
  return rows;
}

}  // namespace broadside::core
