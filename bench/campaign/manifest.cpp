#include "bench/campaign/manifest.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/build_facts.hpp"
#include "bench/campaign/cell_id.hpp"
#include "bench/campaign/job.hpp"
#include "bench/cell/cell_spec.hpp"
#include "bench/cell/json_number.hpp"
#include "bench/cell/scene_arguments.hpp"
#include "bench/job_kinds.hpp"
#include "core/json_depth.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench::campaign {
namespace {

using Json = nlohmann::json;

constexpr const char* kFormat = "broadside-campaign";
constexpr int kVersion = 2;
constexpr std::size_t kDeepestManifest = 16;  // it has 4 levels; each level takes stack when it is written

core::Result<std::uint64_t> digest_of_scene(const CellWork& work) {
  const SceneArguments arguments{work.scene, work.frames, work.stand_in};
  auto scene = arguments.make();
  if (!scene) return scene.error();
  return core::scene_digest(scene.value());
}

Json to_json(const ManifestCell& cell) {
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

ManifestCell from_json(const Json& row) {
  return {.id = row.at("id"),
          .work = {.scene = row.at("scene"),
                   .engine = row.at("engine"),
                   .frames = whole_number(row, "frames", 0, kMostFrames),
                   .repetitions = whole_number(row, "repetitions", 0, kMostRepetitions),
                   .processes = whole_number(row, "processes", 1, kMostRepetitions),
                   .against = row.at("against"),
                   .stand_in = row.at("stand_in"),
                   .time_limit_s = positive_number(row, "time_limit_s", kLongestLimit_s)},
          .needs_gpu = row.at("needs_gpu"),
          .turns = row.at("turns")};
}

bool is_id(const std::string& text) {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

core::Status read_cells(const Json& rows, const std::filesystem::path& file, Manifest& manifest) {
  std::set<std::string> ids;
  for (const Json& row : rows) {
    const auto bad = [&](const std::string& what) {
      return core::Error{"cell " + std::to_string(manifest.cells.size()) + what, file.string(), "plan it again"};
    };
    ManifestCell cell;
    try {
      cell = from_json(row);
    } catch (const RefusedNumber& refused) {
      return bad(": " + refused.what);
    }
    if (!is_id(cell.id) || !is_id(cell.turns)) return bad(" has no valid id");
    // Two experiments of the paper may show one measurement.
    if (!ids.insert(cell.id).second && manifest.job == nullptr) return bad(" has the id of an earlier one, " + cell.id);
    manifest.cells.push_back(std::move(cell));
  }
  return core::Done{};
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
    // Two spellings of one engine, or two names of one scene, give the same cell.
    if (ids.insert(cell.value().id).second) manifest.cells.push_back(std::move(cell).value());
  }
  return manifest;
}

core::Status write_manifest(const std::filesystem::path& folder, const Manifest& manifest) {
  Json rows = Json::array();
  for (const ManifestCell& cell : manifest.cells) rows.push_back(to_json(cell));
  Json document{
      {"format", kFormat}, {"version", kVersion}, {"name", manifest.name}, {"build", manifest.build}, {"cells", rows}};
  if (manifest.job) document[std::string(manifest.job->key())] = Json::parse(manifest.job->text());
  return core::write_whole_file(folder / "manifest.json", document.dump(1) + "\n");
}

core::Result<Manifest> read_manifest(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "manifest.json";
  auto text = core::read_whole_file(file);
  if (!text)
    return core::Error{"there is no manifest", folder.string(), "make one: broadside plan CAMPAIGN.toml --out DIR"};
  if (core::json_depth(text.value()) > kDeepestManifest)
    return core::Error{"it is damaged: it nests more than " + std::to_string(kDeepestManifest) + " levels deep",
                       file.string(), "plan it again"};
  try {
    const Json document = Json::parse(text.value());
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
    if (core::Status s = read_cells(document.at("cells"), file, manifest); !s) return s.error();
    return manifest;
  } catch (const Json::exception& e) {
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
