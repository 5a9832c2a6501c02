#include "datasets/scene_file/table_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/nearest_name.hpp"

namespace broadside::datasets {
namespace {

std::string_view kind_name(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kTable:
      return "a table";
    case Node::Kind::kArray:
      return "a list";
    case Node::Kind::kText:
      return "a text";
    case Node::Kind::kWhole:
      return "a whole number";
    case Node::Kind::kNumber:
      return "a number";
    case Node::Kind::kFlag:
      return "true or false";
    case Node::Kind::kOther:
      break;
  }
  return "a date or time";
}

bool is_number(const Node& node) {
  return node.kind == Node::Kind::kNumber || node.kind == Node::Kind::kWhole;
}

const Node* member(const Node& table, std::string_view key) {
  for (const auto& [name, node] : table.members)
    if (name == key) return &node;
  return nullptr;
}

}  // namespace

void FileErrors::add(std::uint32_t line, std::string what, std::string advice) {
  if (first) return;
  first = core::Error{std::move(what), file + ":" + std::to_string(line), std::move(advice)};
}

TableReader::TableReader(const Node& table, std::string what, FileErrors& errors)
    : table_(table), what_(std::move(what)), errors_(errors) {}

const Node* TableReader::find(std::string_view key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.push_back(key);
  return member(table_, key);
}

bool TableReader::has(std::string_view key) const {
  return member(table_, key) != nullptr;
}

bool TableReader::is_text(std::string_view key) const {
  const Node* node = member(table_, key);
  return node != nullptr && node->kind == Node::Kind::kText;
}

std::uint32_t TableReader::line_of(std::string_view key) const {
  const Node* node = member(table_, key);
  return node == nullptr ? table_.line : node->line;
}

void TableReader::fail(std::string_view key, std::string what, std::string advice) {
  errors_.add(line_of(key), std::move(what), std::move(advice));
}

bool TableReader::text(std::string_view key, std::string& out) {
  const Node* node = find(key);
  if (node == nullptr) return false;
  if (node->kind != Node::Kind::kText)
    return fail(key, std::string(key) + " is " + std::string(kind_name(*node)), "give a text in quotes"), false;
  out = node->text;
  return true;
}

bool TableReader::flag(std::string_view key, bool& out) {
  const Node* node = find(key);
  if (node == nullptr) return false;
  if (node->kind != Node::Kind::kFlag)
    return fail(key, std::string(key) + " is " + std::string(kind_name(*node)), "give true or false"), false;
  out = node->flag;
  return true;
}

bool TableReader::whole(std::string_view key, std::uint64_t low, std::uint64_t high, std::uint64_t& out) {
  const Node* node = find(key);
  if (node == nullptr) return false;
  const std::string range = "give a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  if (node->kind != Node::Kind::kWhole)
    return fail(key, std::string(key) + " is " + std::string(kind_name(*node)), range), false;
  if (node->whole < 0 || static_cast<std::uint64_t>(node->whole) < low ||
      static_cast<std::uint64_t>(node->whole) > high)
    return fail(key, std::string(key) + " is " + std::to_string(node->whole), range), false;
  out = static_cast<std::uint64_t>(node->whole);
  return true;
}

bool TableReader::whole(std::string_view key, std::uint32_t low, std::uint32_t high, std::uint32_t& out) {
  std::uint64_t wide = out;
  if (!whole(key, std::uint64_t{low}, std::uint64_t{high}, wide)) return false;
  out = static_cast<std::uint32_t>(wide);
  return true;
}

bool TableReader::number(std::string_view key, double& out) {
  const Node* node = find(key);
  if (node == nullptr) return false;
  if (!is_number(*node))
    return fail(key, std::string(key) + " is " + std::string(kind_name(*node)), "give a number"), false;
  if (!std::isfinite(node->number))
    return fail(key, std::string(key) + " is NaN or infinite", "give a finite number"), false;
  out = node->number;
  return true;
}

bool TableReader::finite_float(std::string_view key, double value, float& out) {
  const auto narrowed = static_cast<float>(value);
  if (!std::isfinite(narrowed))
    return fail(key, std::string(key) + " is too large for a 32-bit float", "give a number below 3.4e38"), false;
  out = narrowed;
  return true;
}

bool TableReader::number(std::string_view key, float& out) {
  double wide = 0.0;
  return number(key, wide) && finite_float(key, wide, out);
}

bool TableReader::positive(std::string_view key, double& out) {
  double value = 0.0;
  if (!number(key, value)) return false;
  if (!(value > 0.0)) return fail(key, std::string(key) + " is zero or negative", "give a number above zero"), false;
  out = value;
  return true;
}

bool TableReader::numbers(std::string_view key, std::size_t count, std::vector<double>& out) {
  const Node* node = find(key);
  if (node == nullptr) return false;
  const std::string advice = "give " + std::to_string(count) + " finite numbers in brackets";
  if (node->kind != Node::Kind::kArray)
    return fail(key, std::string(key) + " is " + std::string(kind_name(*node)), advice), false;
  if (node->items.size() != count)
    return fail(key, std::string(key) + " has " + std::to_string(node->items.size()) + " entries", advice), false;
  std::vector<double> values;
  for (const Node& item : node->items) {
    if (!is_number(item))
      return fail(key, std::string(key) + " contains " + std::string(kind_name(item)), advice), false;
    if (!std::isfinite(item.number)) return fail(key, std::string(key) + " is NaN or infinite", advice), false;
    values.push_back(item.number);
  }
  out = std::move(values);
  return true;
}

bool TableReader::texts(std::string_view key, std::vector<std::string>& out) {
  const Node* node = find(key);
  if (node == nullptr) return false;
  const std::string advice = "give texts in brackets";
  if (node->kind != Node::Kind::kArray)
    return fail(key, std::string(key) + " is " + std::string(kind_name(*node)), advice), false;
  std::vector<std::string> values;
  for (const Node& item : node->items) {
    if (item.kind != Node::Kind::kText)
      return fail(key, std::string(key) + " contains " + std::string(kind_name(item)), advice), false;
    values.push_back(item.text);
  }
  out = std::move(values);
  return true;
}

bool TableReader::vec3(std::string_view key, core::Vec3& out) {
  std::vector<double> values;
  if (!numbers(key, 3, values)) return false;
  core::Vec3 v;
  for (int k = 0; k < 3; ++k)
    if (!finite_float(key, values[k], v[k])) return false;
  out = v;
  return true;
}

const Node* TableReader::table(std::string_view key) {
  const Node* node = find(key);
  if (node == nullptr) return nullptr;
  if (node->kind != Node::Kind::kTable)
    return fail(key, std::string(key) + " is " + std::string(kind_name(*node)),
                "write it as a table, [" + std::string(key) + "]"),
           nullptr;
  return node;
}

std::vector<const Node*> TableReader::tables(std::string_view key) {
  const Node* node = find(key);
  std::vector<const Node*> found;
  if (node == nullptr) return found;
  const std::string advice = "write each as a table, [[" + std::string(key) + "]]";
  if (node->kind != Node::Kind::kArray)
    return fail(key, std::string(key) + " is " + std::string(kind_name(*node)), advice), found;
  for (const Node& item : node->items) {
    if (item.kind != Node::Kind::kTable)
      return errors_.add(item.line, std::string(key) + " contains " + std::string(kind_name(item)), advice), found;
    found.push_back(&item);
  }
  return found;
}

void TableReader::finish() {
  for (const auto& [key, node] : table_.members)
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
      errors_.add(node.line, "unknown key '" + key + "' in " + what_, core::advise_name(key, asked_));
}

}  // namespace broadside::datasets
