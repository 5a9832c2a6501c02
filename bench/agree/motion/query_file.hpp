// Files of moving features: csv, eight rows a query (four points at the start, four at the end), each row the
// numerators and denominators of x, y and z as integers of any length, and then whether there is a touch, 0 or 1.
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

// Of vertex-face: the vertex and the triangle's corners. Of edge-edge: both ends of one edge, then of the other.
// Errors name the line.
core::Result<std::vector<FileQuery>> read_query_file(const std::filesystem::path& file, continuous::FeatureKind kind);

core::Status write_query_file(const std::vector<FileQuery>& queries, const std::filesystem::path& file);

}  // namespace broadside::bench
