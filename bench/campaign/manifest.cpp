#include "bench/campaign/manifest.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/build_facts.hpp"
#include "bench/cell_spec.hpp"
#include "bench/scene_arguments.hpp"
#include "core/pair.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench::campaign {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "broadside-campaign";
constexpr int kVersion = 1;

std::uint64_t hashed(std::string_view text) {
  std::uint64_t h = core::splitmix64(text.size());
  for (const char c : text) h = core::splitmix64(h ^ static_cast<unsigned char>(c));
  return h;
}

core::Result<std::uint64_t> digest_of_scene(const CellWork& work) {
  const SceneArguments arguments{work.scene, work.frames, work.stand_in};
  auto scene = arguments.make();
  if (!scene) return scene.error();
  return core::scene_digest(scene.value());
}

core::Result<ManifestCell> planned(const CellWork& work, std::uint64_t scene_digest) {
  auto spec = parse_cell_spec(work.engine);
  if (!spec) return spec.error();
  auto settings = core::Settings::parse(spec.value().row->id, spec.value().row->settings, spec.value().settings);
  if (!settings) return settings.error();
  ManifestCell cell;
  cell.work = work;
  cell.needs_gpu = spec.value().row->id.ends_with("-gpu");
  cell.id = fmt::format("{:016x}",
                        hashed(fmt::format("{:016x}|{}|{}|{}|{}|{}", scene_digest, spec.value().row->id,
                                           settings.value().canonical(), work.frames, work.repetitions, build_line())));
  return cell;
}

json to_json(const ManifestCell& cell) {
  return {{"id", cell.id},
          {"scene", cell.work.scene},
          {"engine", cell.work.engine},
          {"frames", cell.work.frames},
          {"repetitions", cell.work.repetitions},
          {"stand_in", cell.work.stand_in},
          {"time_limit_s", cell.work.time_limit_s},
          {"needs_gpu", cell.needs_gpu}};
}

ManifestCell from_json(const json& row) {
  return {.id = row.at("id"),
          .work = {.scene = row.at("scene"),
                   .engine = row.at("engine"),
                   .frames = row.at("frames"),
                   .repetitions = row.at("repetitions"),
                   .stand_in = row.at("stand_in"),
                   .time_limit_s = row.at("time_limit_s")},
          .needs_gpu = row.at("needs_gpu")};
}

bool is_id(const std::string& text) {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

core::Result<Manifest> make_manifest(const CampaignFile& campaign) {
  Manifest manifest{campaign.name, build_line(), {}};
  std::map<std::pair<std::string, std::uint32_t>, std::uint64_t> digests;
  std::set<std::string> ids;
  for (const CellWork& work : campaign.cells) {
    const auto key = std::make_pair(work.scene, work.frames);
    if (!digests.contains(key)) {
      auto digest = digest_of_scene(work);
      if (!digest) return digest.error();
      digests[key] = digest.value();
    }
    auto cell = planned(work, digests[key]);
    if (!cell) return cell.error();
    // Two spellings of one engine, or two names of one scene, are one cell.
    if (ids.insert(cell.value().id).second) manifest.cells.push_back(std::move(cell).value());
  }
  return manifest;
}

core::Status write_manifest(const std::filesystem::path& folder, const Manifest& manifest) {
  json rows = json::array();
  for (const ManifestCell& cell : manifest.cells) rows.push_back(to_json(cell));
  const json document{
      {"format", kFormat}, {"version", kVersion}, {"name", manifest.name}, {"build", manifest.build}, {"cells", rows}};
  return core::write_whole_file(folder / "manifest.json", document.dump(1) + "\n");
}

core::Result<Manifest> read_manifest(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "manifest.json";
  auto text = core::read_whole_file(file);
  if (!text)
    return core::Error{"there is no manifest", folder.string(), "make one: broadside plan CAMPAIGN.toml --out DIR"};
  try {
    const json document = json::parse(text.value());
    if (document.at("format") != kFormat)
      return core::Error{"it is no campaign's manifest", file.string(), "check the path"};
    if (document.at("version") != kVersion)
      return core::Error{
          "it has version " + document.at("version").dump() + ", and this program knows " + std::to_string(kVersion),
          file.string(), "use the program that planned it"};
    Manifest manifest{document.at("name"), document.at("build"), {}};
    for (const json& row : document.at("cells")) {
      manifest.cells.push_back(from_json(row));
      if (!is_id(manifest.cells.back().id))
        return core::Error{"cell " + std::to_string(manifest.cells.size() - 1) + " has no proper id", file.string(),
                           "plan it again"};
    }
    return manifest;
  } catch (const json::exception& e) {
    return core::Error{std::string("it is damaged: ") + e.what(), file.string(), "plan it again"};
  }
}

std::filesystem::path cell_folder(const std::filesystem::path& folder, const std::string& id) {
  return folder / "cells" / id;
}

}  // namespace broadside::bench::campaign
