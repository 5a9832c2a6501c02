#include "bench/campaign/cell_id.hpp"

#include <fmt/format.h>

#include "bench/build_facts.hpp"
#include "bench/cell/cell_spec.hpp"
#include "core/pair.hpp"

namespace broadside::bench::campaign {

std::uint64_t hashed(std::string_view text) {
  std::uint64_t h = core::splitmix64(text.size());
  for (const char c : text) h = core::splitmix64(h ^ static_cast<unsigned char>(c));
  return h;
}

std::string id_of(std::string_view text) {
  return fmt::format("{:016x}", hashed(text));
}

core::Result<ManifestCell> identified(const CellWork& work, std::uint64_t scene_digest, const std::string& beside) {
  auto spec = parse_cell_spec(work.engine);
  if (!spec) return spec.error();
  auto settings = core::Settings::parse(spec.value().row->id, spec.value().row->settings, spec.value().settings);
  if (!settings) return settings.error();
  if (!work.against.empty())
    if (auto baseline = parse_cell_spec(work.against); !baseline) return baseline.error();
  ManifestCell cell;
  cell.work = work;
  cell.needs_gpu = spec.value().row->id.ends_with("-gpu");
  cell.id = id_of(fmt::format("{:016x}|{}|{}|{}|{}|{}|{}", scene_digest, spec.value().row->id,
                              settings.value().canonical(), work.frames, work.repetitions, build_line(), beside));
  cell.turns = cell.id;
  return cell;
}

}  // namespace broadside::bench::campaign
