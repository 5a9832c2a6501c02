#include <array>
#include <optional>
#include <string_view>

#include "core/trace/scene_group.hpp"

namespace broadside::core {
namespace {

constexpr const char* kProvenance = "/provenance";
constexpr const char* kNotes = "/provenance/notes";

struct StampField {
  const char* name;
  std::string Stamp::*member;
};
constexpr std::array kStampFields{
    StampField{"scene_name", &Stamp::scene_name},     StampField{"engine", &Stamp::engine},
    StampField{"settings", &Stamp::settings},         StampField{"settings_short", &Stamp::settings_short},
    StampField{"engine_build", &Stamp::engine_build}, StampField{"broadside_build", &Stamp::broadside_build},
    StampField{"machine", &Stamp::machine},
};

struct LevelRow {
  const char* name;
  RecordLevel level;
};
constexpr std::array kLevels{LevelRow{"full", RecordLevel::kFull}, LevelRow{"digest", RecordLevel::kDigest},
                             LevelRow{"none", RecordLevel::kNone}};

const char* name_of(RecordLevel level) {
  for (const LevelRow& row : kLevels)
    if (row.level == level) return row.name;
  return "full";
}

std::optional<RecordLevel> level_named(std::string_view name) {
  for (const LevelRow& row : kLevels)
    if (row.name == name) return row.level;
  return std::nullopt;
}

void read_level(Hdf5Source& source, TraceHeader& header) {
  const std::string name = source.text(kProvenance, "level");
  if (!source.ok()) return;
  if (const auto level = level_named(name))
    header.level = *level;
  else
    source.fail("/provenance@level", "there is no recording level \"" + name + "\"", "give full, digest or none");
}

}  // namespace

void write_provenance(Hdf5Sink& sink, const TraceHeader& header) {
  sink.group(kProvenance);
  for (const StampField& f : kStampFields) sink.text(kProvenance, f.name, header.stamp.*f.member);
  sink.number(kProvenance, "scene_digest", Element::kU64, &header.stamp.scene_digest);
  sink.text(kProvenance, "level", name_of(header.level));
  sink.number(kProvenance, "every", Element::kU32, &header.every);
  const std::uint8_t exact = header.broad_is_exact ? 1 : 0;
  sink.number(kProvenance, "broad_is_exact", Element::kU8, &exact);
  sink.number(kProvenance, "broad_margin_m", Element::kF64, &header.broad_margin_m);
  sink.text(kProvenance, "driver", header.driver);
  sink.group(kNotes);
  for (const auto& [name, value] : header.notes) sink.text(kNotes, name, value);
}

void read_provenance(Hdf5Source& source, TraceHeader& header) {
  const auto has = [&source](const char* name) { return source.has_attribute(kProvenance, name); };
  header.stamp.engine = source.text(kProvenance, "engine");
  for (const StampField& f : kStampFields)
    if (has(f.name)) header.stamp.*f.member = source.text(kProvenance, f.name);
  if (has("scene_digest")) header.stamp.scene_digest = source.number<std::uint64_t>(kProvenance, "scene_digest");
  if (has("level")) read_level(source, header);
  if (has("every")) header.every = source.number<std::uint32_t>(kProvenance, "every");
  if (header.every == 0) source.fail("/provenance@every", "it is 0", "give 1 for every frame, k for every k-th");
  if (has("broad_is_exact")) header.broad_is_exact = source.number<std::uint8_t>(kProvenance, "broad_is_exact") != 0;
  if (has("broad_margin_m")) header.broad_margin_m = source.number<double>(kProvenance, "broad_margin_m");
  if (has("driver")) header.driver = source.text(kProvenance, "driver");
  if (source.has(kNotes))
    for (const std::string& name : source.attribute_names(kNotes)) header.notes[name] = source.text(kNotes, name);
}

}  // namespace broadside::core
