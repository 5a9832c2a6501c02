// Files of moving features, as CSV. A query has eight rows: its four points at the start, then at the end. A row has
// the numerators and denominators of x, y and z as integers of any length, and then 0 or 1: whether there is a touch.
#pragma once

#include <filesystem>
#include <vector>

#include "core/exact/feature_touch.hpp"
#include "core/result.hpp"

namespace broadside::bench {

struct FileQuery {
  exact::RationalFeatures features;
  bool touches = false;  // as the file says
};

// The four points are, for vertex-face, the vertex and the triangle's corners; for edge-edge, both ends of one edge,
// then those of the other. Errors name the line.
core::Result<std::vector<FileQuery>> read_query_file(const std::filesystem::path& file, continuous::FeatureKind kind);

core::Status write_query_file(const std::vector<FileQuery>& queries, const std::filesystem::path& file);

}  // namespace broadside::bench
