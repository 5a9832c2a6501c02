#include "bench/campaign/manifest.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/cell/cell_spec.hpp"
#include "bench/cell/scene_arguments.hpp"
#include "bench/paper/paper_scene.hpp"
#include "bench/process/build_facts.hpp"
#include "core/pair.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench::campaign {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "broadside-campaign";
constexpr int kVersion = 2;

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

// `beside`: other facts that make two such cells different.
core::Result<ManifestCell> planned(const CellWork& work, std::uint64_t scene_digest, const std::string& beside) {
  auto spec = parse_cell_spec(work.engine);
  if (!spec) return spec.error();
  auto settings = core::Settings::parse(spec.value().row->id, spec.value().row->settings, spec.value().settings);
  if (!settings) return settings.error();
  if (!work.against.empty())
    if (auto baseline = parse_cell_spec(work.against); !baseline) return baseline.error();
  ManifestCell cell;
  cell.work = work;
  cell.needs_gpu = spec.value().row->id.ends_with("-gpu");
  cell.id = fmt::format("{:016x}", hashed(fmt::format("{:016x}|{}|{}|{}|{}|{}|{}", scene_digest, spec.value().row->id,
                                                      settings.value().canonical(), work.frames, work.repetitions,
                                                      build_line(), beside)));
  cell.turns = cell.id;
  return cell;
}

// A scene that cannot be made here has no digest: its name takes that place, and its cells will say why.
std::uint64_t digest_of_paper_scene(const paper::PaperCell& cell, bool allow_stand_in) {
  const auto scene = paper::make_paper_scene(cell, allow_stand_in);
  return scene ? core::scene_digest(scene.value()) : hashed(cell.scene);
}

core::Status add_paper_cells(const paper::PaperRequest& request, Manifest& manifest) {
  auto cells = paper::plan_cells(request.experiments, request.plan, request.device);
  if (!cells) return cells.error();
  const paper::PaperCell* last = nullptr;
  std::uint64_t digest = 0;
  for (const paper::PaperCell& cell : cells.value()) {
    if (last == nullptr || !paper::takes_turns(*last, cell))
      digest = digest_of_paper_scene(cell, request.allow_stand_in);
    last = &cell;
    const CellWork work{.scene = cell.scene,
                        .engine = cell.engine,
                        .frames = static_cast<std::uint32_t>(cell.frames),
                        .repetitions = cell.is_timed ? request.plan.runs : 0,
                        .stand_in = request.allow_stand_in};
    auto made = planned(work, digest,
                        fmt::format("{}|{}|{}|{}", cell.every, cell.wants_memory, cell.left_out, request.machine));
    if (!made) return made.error();
    made.value().turns = fmt::format("{:016x}", hashed(fmt::format("{:016x}|{}|{}|{}|{}", digest, cell.frames,
                                                                   cell.every, build_line(), request.machine)));
    manifest.cells.push_back(std::move(made).value());
  }
  return core::Done{};
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
  Manifest manifest{campaign.name, build_line(), {}, campaign.paper};
  if (campaign.paper) {
    if (core::Status s = add_paper_cells(*campaign.paper, manifest); !s) return s.error();
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
    auto cell = planned(work, digests[key], fmt::format("{}|{}", work.processes, work.against));
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
  if (manifest.paper) document["paper"] = json::parse(paper::text_of(*manifest.paper));
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
    Manifest manifest{document.at("name"), document.at("build"), {}, std::nullopt};
    if (document.contains("paper")) {
      auto request = paper::request_from(document.at("paper").dump());
      if (!request) return request.error();
      manifest.paper = std::move(request).value();
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

core::Result<std::vector<paper::PaperCell>> paper_cells(const Manifest& manifest) {
  auto cells = paper::plan_cells(manifest.paper->experiments, manifest.paper->plan, manifest.paper->device);
  if (!cells) return cells.error();
  if (cells.value().size() != manifest.cells.size())
    return core::Error{"its cells are not those that the paper's experiments need", "manifest.json", "plan it again"};
  for (std::size_t k = 0; k < manifest.cells.size(); ++k) {
    cells.value()[k].id = manifest.cells[k].id;
    cells.value()[k].turns = manifest.cells[k].turns;
  }
  return cells;
}

std::filesystem::path cell_folder(const std::filesystem::path& folder, const std::string& id) {
  return folder / "cells" / id;
}

}  // namespace broadside::bench::campaign
