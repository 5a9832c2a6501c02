#include "bench/campaign/manifest.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/build_facts.hpp"
#include "bench/campaign/cell_id.hpp"
#include "bench/campaign/job.hpp"
#include "bench/cell/scene_arguments.hpp"
#include "bench/job_kinds.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench::campaign {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "broadside-campaign";
constexpr int kVersion = 2;

core::Result<std::uint64_t> digest_of_scene(const CellWork& work) {
  const SceneArguments arguments{work.scene, work.frames, work.stand_in};
  auto scene = arguments.make();
  if (!scene) return scene.error();
  return core::scene_digest(scene.value());
}

json to_json(const ManifestCell& cell) {
  return {{"id", cell.id},
          {"scene", cell.work.scene},
          {"engine", cell.work.engine},
          {"frames", cell.work.frames},
          {"repetitions", cell.work.repetitions},
          {"stand_in", cell.work.stand_in},
          {"time_limit_s", cell.work.time_limit_s},
          {"processes", cell.work.processes},
          {"against", cell.work.against},
          {"needs_gpu", cell.needs_gpu},
          {"turns", cell.turns}};
}

ManifestCell from_json(const json& row) {
  return {.id = row.at("id"),
          .work = {.scene = row.at("scene"),
                   .engine = row.at("engine"),
                   .frames = row.at("frames"),
                   .repetitions = row.at("repetitions"),
                   .processes = row.at("processes"),
                   .against = row.at("against"),
                   .stand_in = row.at("stand_in"),
                   .time_limit_s = row.at("time_limit_s")},
          .needs_gpu = row.at("needs_gpu"),
          .turns = row.at("turns")};
}

bool is_id(const std::string& text) {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

core::Result<Manifest> make_manifest(const CampaignFile& campaign) {
  Manifest manifest{campaign.name, build_line(), {}, campaign.job};
  if (campaign.job) {
    auto cells = campaign.job->plan();
    if (!cells) return cells.error();
    manifest.cells = std::move(cells).value();
    return manifest;
  }
  std::map<std::pair<std::string, std::uint32_t>, std::uint64_t> digests;
  std::set<std::string> ids;
  for (const CellWork& work : campaign.cells) {
    const auto key = std::make_pair(work.scene, work.frames);
    if (!digests.contains(key)) {
      auto digest = digest_of_scene(work);
      if (!digest) return digest.error();
      digests[key] = digest.value();
    }
    auto cell = identified(work, digests[key], fmt::format("{}|{}", work.processes, work.against));
    if (!cell) return cell.error();
    // Two spellings of one engine, or two names of one scene, are one cell.
    if (ids.insert(cell.value().id).second) manifest.cells.push_back(std::move(cell).value());
  }
  return manifest;
}

core::Status write_manifest(const std::filesystem::path& folder, const Manifest& manifest) {
  json rows = json::array();
  for (const ManifestCell& cell : manifest.cells) rows.push_back(to_json(cell));
  json document{
      {"format", kFormat}, {"version", kVersion}, {"name", manifest.name}, {"build", manifest.build}, {"cells", rows}};
  if (manifest.job) document[std::string(manifest.job->key())] = json::parse(manifest.job->text());
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
    Manifest manifest{document.at("name"), document.at("build"), {}, nullptr};
    for (const JobKind& kind : job_kinds()) {
      if (!document.contains(kind.key)) continue;
      auto job = kind.from_text(document.at(std::string(kind.key)).dump());
      if (!job) return job.error();
      manifest.job = std::move(job).value();
    }
    for (const json& row : document.at("cells")) {
      manifest.cells.push_back(from_json(row));
      if (!is_id(manifest.cells.back().id) || !is_id(manifest.cells.back().turns))
        return core::Error{"cell " + std::to_string(manifest.cells.size() - 1) + " has no proper id", file.string(),
                           "plan it again"};
    }
    return manifest;
  } catch (const json::exception& e) {
    return core::Error{std::string("it is damaged: ") + e.what(), file.string(), "plan it again"};
  }
}

std::vector<std::span<const ManifestCell>> groups_of(const Manifest& manifest) {
  const std::span<const ManifestCell> cells(manifest.cells);
  std::vector<std::span<const ManifestCell>> groups;
  for (std::size_t first = 0; first < cells.size();) {
    std::size_t end = first;
    while (end < cells.size() && cells[end].turns == cells[first].turns) ++end;
    groups.push_back(cells.subspan(first, end - first));
    first = end;
  }
  return groups;
}

std::filesystem::path cell_folder(const std::filesystem::path& folder, const std::string& id) {
  return folder / "cells" / id;
}

}  // namespace broadside::bench::campaign
