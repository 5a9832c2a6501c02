#include "core/trace/declaration_group.hpp"

#include <map>
#include <string>

namespace broadside::core {
namespace {

constexpr const char* kPath = "/declaration";

}  // namespace

void write_declaration(Hdf5Sink& sink, const Declaration& declaration) {
  sink.group(kPath);
  for (const auto& [key, text] : declaration.declared()) sink.text(kPath, key, text);
}

Declaration read_declaration(Hdf5Source& source) {
  if (!source.has(kPath)) return {};
  std::map<std::string, std::string> given;
  for (const std::string& key : source.attribute_names(kPath)) given[key] = source.text(kPath, key);
  if (!source.ok()) return {};
  auto parsed = Declaration::parse(given, kPath);
  if (parsed) return std::move(parsed).value();
  source.fail(kPath, parsed.error().what, parsed.error().advice);
  return {};
}

}  // namespace broadside::core
