#include "core/engine/declaration.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "core/nearest_name.hpp"

namespace broadside::core {
namespace {

using enum DeclaredValue;

const DeclarationKey* row_of(std::string_view key) {
  const auto rows = declaration_keys();
  const auto row = std::find_if(rows.begin(), rows.end(), [key](const DeclarationKey& r) { return r.key == key; });
  return row == rows.end() ? nullptr : &*row;
}

bool is_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(value) && !std::signbit(value);
}

bool is_count(std::string_view text) {
  return !text.empty() && text.size() <= 9 && text.front() != '0' &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Advice for a value that the key does not accept; empty when it accepts it.
std::string advice_for(const DeclarationKey& row, const std::string& text) {
  switch (row.kind) {
    case kWord:
      return std::find(row.allowed.begin(), row.allowed.end(), text) != row.allowed.end()
                 ? std::string()
                 : advise_name(text, row.allowed);
    case kText:
      return {};
    case kCount:
      return is_count(text) ? std::string() : "give a whole number of 1 or more";
    case kNumber:
      return is_number(text) ? std::string() : "give a finite number of 0 or more";
  }
  return {};
}

}  // namespace

std::span<const DeclarationKey> declaration_keys() {
  static const std::array<DeclarationKey, 18> kRows{{
      {"method", kWord, "none", {"none", kMethodName}, "whether the laws of METHOD apply to it"},
      {"twin_of", kText, "", {}, "the engine whose results it repeats bit by bit: determinism"},
      {"motion", kWord, "rigid", {"translate", "rigid"}, "whether bodies may turn"},
      {"detection_at",
       kWord,
       "end",
       {"start", "end", "midway", "within"},
       "the pose that boxes and gaps belong to: start or end of the step, or a recorded one in between; within: "
       "the start, and points found later in the step are given where their surfaces were at its start"},
      {"contacts",
       kWord,
       "none",
       {"none", "applications", "totals", "geometry"},
       "applications: one row for each application of the response; totals: one for each point and step; geometry: "
       "the same without impulses"},
      {"integrator", kText, "", {}, "its name, which no law reads"},
      {"order", kCount, "1", {}, "order of convergence in the step: closed-form"},
      {"substeps", kCount, "1", {}, "substeps of a step"},
      {"iterations", kCount, "1", {}, "how often a step applies each contact: the rounding of momentum"},
      {"friction",
       kWord,
       "cone",
       {"cone", "pyramid", "regularized"},
       "pyramid: up to sqrt 2 times the cone along its diagonals; regularized: sticking contacts creep"},
      {"contact_model", kWord, "rigid", {"rigid", "compliant"}, "compliant contacts store energy and sink in"},
      {"contact_time_s", kNumber, "0", {}, "time constant of compliant contacts, s: penetration, rest, energy"},
      {"contact_margin_m", kNumber, "0", {}, "gap up to which an impulse may act, m: unilateral"},
      {"correction",
       kWord,
       "none",
       {"none", "velocity", "position"},
       "how depth is corrected: through velocities, through positions alone, or not: energy"},
      {"correction_rate", kNumber, "1", {}, "share of the depth that a step corrects, 0 to 1: energy"},
      {"sleep_speed_m_s",
       kNumber,
       "0",
       {},
       "a body may be stopped and held while none of its points is faster, m/s; 0: no body sleeps: momentum, "
       "angular-momentum"},
      {"accuracy", kNumber, "0", {}, "relative error that a step's error control allows: energy"},
      {"precision",
       kWord,
       "f64",
       {"f32", "f64"},
       "of its arithmetic; limits take the rounding of this or of the trace, whichever is coarser"},
  }};
  return kRows;
}

Result<Declaration> Declaration::parse(const std::map<std::string, std::string>& given, const std::string& where) {
  Declaration declaration;
  for (const auto& [key, text] : given) {
    const DeclarationKey* row = row_of(key);
    if (row == nullptr) {
      std::vector<std::string_view> keys;
      for (const DeclarationKey& known : declaration_keys()) keys.push_back(known.key);
      return Error{"a declaration has no key '" + key + "'", where, advise_name(key, keys), Exit::kBadInput};
    }
    if (std::string advice = advice_for(*row, text); !advice.empty())
      return Error{"'" + key + "' cannot be declared as '" + text + "'", where, std::move(advice), Exit::kBadInput};
    declaration.declared_[key] = text;
  }
  return declaration;
}

Declaration Declaration::of(const std::map<std::string, std::string>& given) {
  auto parsed = parse(given, "a declaration in this program");
  if (parsed) return std::move(parsed).value();
  std::fprintf(stderr, "%s\n", parsed.error().what.c_str());
  std::abort();
}

std::string_view Declaration::text(std::string_view key) const {
  const auto found = declared_.find(key);
  if (found != declared_.end()) return found->second;
  const DeclarationKey* row = row_of(key);
  return row == nullptr ? std::string_view{} : row->default_value;
}

double Declaration::number(std::string_view key) const {
  return std::strtod(std::string(text(key)).c_str(), nullptr);
}

Declaration method_declaration(std::string_view twin_of) {
  std::map<std::string, std::string> given{{"method", std::string(kMethodName)},
                                           {"motion", "translate"},
                                           {"detection_at", "midway"},
                                           {"contacts", "applications"},
                                           {"integrator", "semi-implicit Euler"},
                                           {"correction", "position"},
                                           {"precision", "f32"}};
  if (!twin_of.empty()) given["twin_of"] = twin_of;
  return Declaration::of(given);
}

}  // namespace broadside::core
