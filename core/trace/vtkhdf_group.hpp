// /VTKHDF: a trace's frames as an UnstructuredGrid over time, in the form that VTK 9.3 and ParaView 5.12 read. Private
// to core/trace/*.cpp. Format: docs.vtk.org, "VTKHDF format specification", version 2.0.
#pragma once

#include <cstdint>
#include <vector>

#include "core/trace/hdf5_sink.hpp"

namespace broadside::core {

// VTK's numbers for cell types.
enum class VtkCell : std::uint8_t { kTriangle = 5, kHexahedron = 12 };

constexpr std::uint64_t points_per_cell(VtkCell c) {
  return c == VtkCell::kTriangle ? 3 : 8;
}

// What all frames share: the same cells on points that move.
struct VtkTopology {
  VtkCell cell = VtkCell::kHexahedron;
  std::uint64_t points = 0;                // points of one frame
  std::vector<std::int64_t> connectivity;  // points_per_cell() point numbers per cell
  std::vector<std::uint32_t> body;         // body of each cell

  [[nodiscard]] std::uint64_t cells() const { return body.size(); }
};

// One hexahedron per body. Point c * bodies + b is corner c of body b. Points are numbered corner by corner, so that a
// frame's points are a few regular blocks of its boxes.
VtkTopology box_topology(std::uint64_t bodies);

// Whether corner c of a VTK hexahedron has the min (0) or max (1) on each axis.
constexpr std::uint8_t kHexahedronCorners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

// Writes everything but Points, Steps/Values and CellData/velocity. One offset per frame says where its points begin;
// offsets into CellData/velocity are written when has_velocity is set.
void write_vtk_topology(Hdf5Sink& sink, std::uint64_t frames, const VtkTopology& topology, bool has_velocity);

// The group over /trace/time and /trace/detection of the same file: Points, Values and velocity are virtual datasets,
// so nothing is stored twice. frames and bodies are not 0.
void write_vtkhdf_group(Hdf5Sink& sink, std::uint64_t frames, std::uint64_t bodies);

}  // namespace broadside::core
