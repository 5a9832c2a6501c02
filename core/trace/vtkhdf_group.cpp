#include "core/trace/vtkhdf_group.hpp"

#include <array>
#include <numeric>
#include <string>

namespace broadside::core {
namespace {

constexpr const char* kThisFile = ".";  // HDF5's name for the file itself, in a virtual dataset

Handle space_of(const std::vector<hsize_t>& dims) {
  return {H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose};
}

void create_virtual(Hdf5Sink& sink, const std::string& path, Element element, const Handle& space,
                    const Handle& properties, const std::string& unit) {
  const Handle set(H5Dcreate2(sink.file(), path.c_str(), hdf5_type(element), space.get(), H5P_DEFAULT, properties.get(),
                              H5P_DEFAULT),
                   H5Dclose);
  if (sink.note(static_cast<bool>(set), path)) sink.text(path, "unit", unit);
}

Handle virtual_properties() {
  Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  return properties;
}

// A virtual dataset that shows the same values in another shape.
void reshaped(Hdf5Sink& sink, const std::string& path, const std::vector<hsize_t>& shape, const char* source,
              const std::vector<hsize_t>& source_shape, Element element, const std::string& unit) {
  if (!sink.ok()) return;
  const Handle properties = virtual_properties();
  const Handle here = space_of(shape);
  const Handle there = space_of(source_shape);
  if (sink.note(H5Pset_virtual(properties.get(), here.get(), kThisFile, source, there.get()) >= 0, path))
    create_virtual(sink, path, element, here, properties, unit);
}

// Corner c of body b of frame f is row (8 f + c) bodies + b; its axes come from the min or the max of the body's box.
void virtual_corners(Hdf5Sink& sink, const std::string& path, hsize_t frames, hsize_t bodies) {
  if (!sink.ok()) return;
  const Handle properties = virtual_properties();
  const Handle here = space_of({frames * 8 * bodies, 3});
  const Handle there = space_of({frames, bodies, 6});
  bool good = true;
  // Maps columns axis .. axis + width - 1 of corner c, from column `from` of the boxes on.
  const auto map = [&](hsize_t c, hsize_t axis, hsize_t width, hsize_t from) {
    const std::array<hsize_t, 2> start{c * bodies, axis}, stride{8 * bodies, 1}, count{frames, 1}, block{bodies, width};
    const std::array<hsize_t, 3> source_start{0, 0, from}, source_count{frames, bodies, width};
    good =
        good &&
        H5Sselect_hyperslab(here.get(), H5S_SELECT_SET, start.data(), stride.data(), count.data(), block.data()) >= 0 &&
        H5Sselect_hyperslab(there.get(), H5S_SELECT_SET, source_start.data(), nullptr, source_count.data(), nullptr) >=
            0 &&
        H5Pset_virtual(properties.get(), here.get(), kThisFile, "/trace/detection/boxes", there.get()) >= 0;
  };
  for (hsize_t c = 0; c < 8; ++c) {
    const auto& corner = kHexahedronCorners[c];
    if (corner[0] == corner[1] && corner[1] == corner[2]) {
      map(c, 0, 3, corner[0] * hsize_t{3});
      continue;
    }
    for (hsize_t axis = 0; axis < 3; ++axis) map(c, axis, 1, axis + corner[axis] * hsize_t{3});
  }
  H5Sselect_all(here.get());
  if (sink.note(good, path)) create_virtual(sink, path, Element::kF32, here, properties, "m");
}

// step, 2 step ... : where each frame's rows begin.
std::vector<std::int64_t> rhythm(std::uint64_t frames, std::uint64_t step) {
  std::vector<std::int64_t> offsets(frames);
  for (std::uint64_t f = 0; f < frames; ++f) offsets[f] = static_cast<std::int64_t>(f * step);
  return offsets;
}

}  // namespace

VtkTopology box_topology(std::uint64_t bodies) {
  VtkTopology t;
  t.points = 8 * bodies;
  for (std::uint64_t b = 0; b < bodies; ++b)
    for (std::uint64_t c = 0; c < 8; ++c) t.connectivity.push_back(static_cast<std::int64_t>(c * bodies + b));
  t.body.resize(bodies);
  std::iota(t.body.begin(), t.body.end(), 0U);
  return t;
}

void write_vtk_topology(Hdf5Sink& sink, std::uint64_t frames, const VtkTopology& topology, bool has_velocity) {
  const std::int64_t version[2] = {2, 0};
  sink.group("/VTKHDF");
  sink.number("/VTKHDF", "Version", Element::kI64, version, 2);
  sink.ascii("/VTKHDF", "Type", "UnstructuredGrid");

  const auto points = static_cast<std::int64_t>(topology.points);
  const auto cells = static_cast<std::int64_t>(topology.cells());
  const auto ids = static_cast<std::int64_t>(topology.connectivity.size());
  sink.constant("/VTKHDF/NumberOfPoints", Element::kI64, frames, &points, "1");
  sink.constant("/VTKHDF/NumberOfCells", Element::kI64, frames, &cells, "1");
  sink.constant("/VTKHDF/NumberOfConnectivityIds", Element::kI64, frames, &ids, "1");
  const auto rows = [&sink](const std::string& path, const std::vector<std::int64_t>& values) {
    sink.array(path, Element::kI64, 1, values.size(), values.data(), "1");
  };
  rows("/VTKHDF/Connectivity", topology.connectivity);
  rows("/VTKHDF/Offsets", rhythm(topology.cells() + 1, points_per_cell(topology.cell)));
  const auto type = static_cast<std::uint8_t>(topology.cell);
  sink.constant("/VTKHDF/Types", Element::kU8, topology.cells(), &type, "1");
  sink.group("/VTKHDF/CellData");
  sink.array("/VTKHDF/CellData/body", Element::kU32, 1, topology.body.size(), topology.body.data(), "1");

  const auto frame_count = static_cast<std::int64_t>(frames);
  const std::int64_t zero = 0;
  const std::int64_t one = 1;
  sink.group("/VTKHDF/Steps");
  sink.number("/VTKHDF/Steps", "NSteps", Element::kI64, &frame_count);
  rows("/VTKHDF/Steps/PartOffsets", rhythm(frames, 1));
  sink.constant("/VTKHDF/Steps/NumberOfParts", Element::kI64, frames, &one, "1");
  rows("/VTKHDF/Steps/PointOffsets", rhythm(frames, topology.points));
  sink.constant("/VTKHDF/Steps/CellOffsets", Element::kI64, frames, &zero, "1");
  sink.constant("/VTKHDF/Steps/ConnectivityIdOffsets", Element::kI64, frames, &zero, "1");
  sink.group("/VTKHDF/Steps/CellDataOffsets");
  sink.constant("/VTKHDF/Steps/CellDataOffsets/body", Element::kI64, frames, &zero, "1");
  if (has_velocity) rows("/VTKHDF/Steps/CellDataOffsets/velocity", rhythm(frames, topology.cells()));
}

void write_vtkhdf_group(Hdf5Sink& sink, std::uint64_t frames, std::uint64_t bodies) {
  write_vtk_topology(sink, frames, box_topology(bodies), true);
  virtual_corners(sink, "/VTKHDF/Points", frames, bodies);
  reshaped(sink, "/VTKHDF/Steps/Values", {frames}, "/trace/time", {frames}, Element::kF64, "s");
  reshaped(sink, "/VTKHDF/CellData/velocity", {frames * bodies, 3}, "/trace/detection/velocity", {frames, bodies, 3},
           Element::kF32, "m/s");
}

}  // namespace broadside::core
