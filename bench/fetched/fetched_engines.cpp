#include "bench/fetched/fetched_engines.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>
#include <vector>

#include "bench/fetched/program_files.hpp"
#include "bench/process/program.hpp"
#include "core/nearest_name.hpp"
#include "core/whole_file.hpp"
#include "datasets/mesh/acquire_mesh.hpp"

namespace broadside::bench {
namespace {

namespace fs = std::filesystem;

struct FetchedEngine {
  std::string_view id;
  std::string_view what;
};

// To add one: a folder in reference/programs with the program, package.json and package-lock.json, and a line here.
constexpr std::array kFetchedTable{
    FetchedEngine{"jolt", "Jolt Physics under Node"},
    FetchedEngine{"rapier", "Rapier 3-D, its deterministic build, under Node"},
    FetchedEngine{"mujoco3", "MuJoCo 3 under Node"},
    FetchedEngine{"cannon", "cannon-es under Node"},
    FetchedEngine{"physx", "PhysX 5 under Node"},
};

// Empty where neither HOME nor XDG_CACHE_HOME is set.
fs::path root_of_all() {
  const fs::path cache = datasets::MeshOptions::from_environment().cache_dir;
  return cache.empty() ? fs::path() : cache / "engines";
}

// The path of "jolt.mjs" below a folder that is laid out like this tree.
fs::path program_in(const fs::path& folder, std::string_view id) {
  return folder / "reference" / "programs" / id / (std::string(id) + ".mjs");
}

// Whether a program needs this file: those of its folder, those that all programs share, and the client.
bool belongs_to(std::string_view path, std::string_view id) {
  constexpr std::string_view kPrograms = "reference/programs/";
  if (!path.starts_with(kPrograms)) return true;
  const std::string_view rest = path.substr(kPrograms.size());
  return rest.find('/') == std::string_view::npos || rest.starts_with(std::string(id) + "/");
}

// Whether the installed program is that of this version: its files are compared.
bool is_current(const fs::path& folder, std::string_view id) {
  const auto files = program_files();
  return std::all_of(files.begin(), files.end(), [&](const ProgramFile& file) {
    if (!belongs_to(file.path, id)) return true;
    const auto there = core::read_whole_file(folder / file.path);
    return there.ok() && there.value() == file.text;
  });
}

bool is_installed(std::string_view id) {
  const fs::path root = root_of_all();
  if (root.empty()) return false;
  std::error_code ignored;
  const fs::path package = program_in(root / id, id).parent_path() / "node_modules";
  return fs::is_directory(package, ignored) && is_current(root / id, id);
}

template <std::size_t kPlace>
std::string why_not_here() {
  const std::string id(kFetchedTable[kPlace].id);
  return is_installed(id) ? "" : "not installed: broadside fetch-engine " + id;
}

template <std::size_t... kPlaces>
std::vector<core::EngineRow> rows_of(std::index_sequence<kPlaces...>) {
  std::vector<core::EngineRow> rows;
  (rows.push_back({.id = kFetchedTable[kPlaces].id,
                   .capabilities = "dynamics",
                   .what = kFetchedTable[kPlaces].what,
                   .absent = why_not_here<kPlaces>}),
   ...);
  return rows;
}

core::Status write_files(const fs::path& folder, std::string_view id) {
  for (const ProgramFile& file : program_files()) {
    if (!belongs_to(file.path, id)) continue;
    std::error_code failed;
    fs::create_directories((folder / file.path).parent_path(), failed);
    if (failed) return core::Error{"cannot write there: " + failed.message(), folder.string(), "check the folder"};
    if (core::Status s = core::write_whole_file(folder / file.path, std::string(file.text)); !s) return s;
  }
  return core::Done{};
}

}  // namespace

std::span<const core::EngineRow> fetched_engine_rows() {
  static const std::vector<core::EngineRow> kRows = rows_of(std::make_index_sequence<kFetchedTable.size()>{});
  return kRows;
}

std::string fetched_command(std::string_view id) {
  const bool is_known =
      std::any_of(kFetchedTable.begin(), kFetchedTable.end(), [id](const FetchedEngine& e) { return e.id == id; });
  return is_known && is_installed(id) ? "node '" + program_in(root_of_all() / id, id).string() + "'" : std::string();
}

fs::path fetched_folder(std::string_view id) {
  return program_in(root_of_all() / id, id).parent_path();
}

core::Status fetch_engine(std::string_view id, const std::function<void(std::string_view)>& say) {
  std::vector<std::string_view> ids;
  ids.reserve(std::size(kFetchedTable));
  for (const FetchedEngine& e : kFetchedTable) ids.push_back(e.id);
  if (std::find(ids.begin(), ids.end(), id) == ids.end())
    return core::Error{"no engine '" + std::string(id) + "' can be fetched", "fetch-engine",
                       core::advise_name(id, ids)};
  const fs::path root = root_of_all();
  if (root.empty())
    return core::Error{"neither HOME nor XDG_CACHE_HOME is set", "fetch-engine", "set one: engines are kept under it"};
  if (is_installed(id)) return core::Done{};
  const fs::path part = root / (std::string(id) + ".part" + std::to_string(getpid()));
  std::error_code failed;
  fs::remove_all(part, failed);
  if (core::Status s = write_files(part, id); !s) return s;
  const fs::path package = program_in(part, id).parent_path();
  say("installing its package with npm");
  const fs::path log = part / "npm.log";
  auto ended = run_program("npm",
                           {"ci", "--prefix", package.string(), "--ignore-scripts", "--no-audit", "--no-fund",
                            "--fetch-retries=1", "--fetch-timeout=60000", "--loglevel=error"},
                           log);
  if (!ended || ended.value() != 0) {
    const std::string why = ended ? last_line(log) : ended.error().what;
    fs::remove_all(part, failed);
    return core::Error{"npm could not install it: " + why, std::string(id),
                       "it needs Node, npm and the network once; try again", core::Exit::kMissing};
  }
  fs::remove_all(root / id, failed);
  fs::rename(part, root / id, failed);
  if (failed) return core::Error{"cannot rename it: " + failed.message(), part.string(), "check the folder"};
  return core::Done{};
}

}  // namespace broadside::bench
