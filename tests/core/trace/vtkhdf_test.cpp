// /VTKHDF says the same as /trace: a hexahedron per body with the corners of its box, frame by frame.
#include <gtest/gtest.h>

#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_writer.hpp"
#include "core/trace/view_file.hpp"
#include "core/whole_file.hpp"
#include "tests/core/trace/random_frames.hpp"
#include "tests/core/trace/raw_file.hpp"

namespace broadside::tests {
namespace {

using namespace core;

constexpr std::uint32_t kViewedBodies = 5;
constexpr std::uint64_t kViewedFrames = 7;

// Body b of frame f has the box from (f, b, 0) to (f + 1, b + 2, 3), in numbers that floats hold exactly.
FrameRecord frame_of(std::uint64_t f) {
  FrameRecord frame;
  frame.step = f + 1;
  frame.time_s = 0.25 * static_cast<double>(f + 1);
  for (std::uint32_t b = 0; b < kViewedBodies; ++b) {
    const auto x = static_cast<float>(f);
    const auto y = static_cast<float>(b);
    frame.boxes.push_back({{x, y, 0.0F}, {x + 1.0F, y + 2.0F, 3.0F}});
    frame.detected_position.push_back({x + 0.5F, y + 1.0F, 1.5F});
    frame.detected_velocity.push_back({x, y, -1.0F});
  }
  return frame;
}

void write_trace(const std::filesystem::path& path, std::uint64_t frames) {
  auto writer = TraceWriter::create(path, header_of(tetrahedra_scene(kViewedBodies), bit(Group::kDetection)));
  ASSERT_TRUE(writer.ok());
  for (std::uint64_t f = 0; f < frames; ++f) ASSERT_TRUE(writer.value().append(frame_of(f)).ok());
  ASSERT_TRUE(writer.value().finish().ok());
}

template <typename T>
std::vector<T> values(const std::filesystem::path& file, const std::string& path, hid_t type) {
  const Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const Handle set(H5Dopen2(opened.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
  EXPECT_TRUE(set) << path;
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  std::vector<T> all(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
  EXPECT_GE(H5Dread(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), 0) << path;
  return all;
}

std::vector<std::int64_t> integers(const std::filesystem::path& file, const std::string& path) {
  return values<std::int64_t>(file, path, H5T_NATIVE_INT64);
}

// What VTK's reader does for step f, in a few lines: offsets, cells, points. Returns the bounds of each cell.
std::vector<Box> cells_of_step(const std::filesystem::path& file, std::uint64_t f) {
  const auto points = values<float>(file, "/VTKHDF/Points", H5T_NATIVE_FLOAT);
  const auto connectivity = integers(file, "/VTKHDF/Connectivity");
  const auto offsets = integers(file, "/VTKHDF/Offsets");
  const auto first = static_cast<std::uint64_t>(integers(file, "/VTKHDF/Steps/PointOffsets")[f]);
  const auto part = static_cast<std::uint64_t>(integers(file, "/VTKHDF/Steps/PartOffsets")[f]);
  const auto cells = static_cast<std::uint64_t>(integers(file, "/VTKHDF/NumberOfCells")[part]);
  EXPECT_EQ(integers(file, "/VTKHDF/Steps/CellOffsets")[f], 0);
  EXPECT_EQ(integers(file, "/VTKHDF/Steps/ConnectivityIdOffsets")[f], 0);
  std::vector<Box> boxes;
  for (std::uint64_t c = 0; c < cells; ++c) {
    Box box = empty_box();
    for (std::int64_t i = offsets[c]; i < offsets[c + 1]; ++i) {
      const std::uint64_t p = 3 * (first + static_cast<std::uint64_t>(connectivity[static_cast<std::size_t>(i)]));
      box = grown(box, {points[p], points[p + 1], points[p + 2]});
    }
    boxes.push_back(box);
  }
  return boxes;
}

TEST(Vtkhdf, EveryCellIsItsBodysBoxInEveryFrame) {
  const Folder folder;
  write_trace(folder / "t.h5", kViewedFrames);
  for (std::uint64_t f = 0; f < kViewedFrames; ++f)
    EXPECT_EQ(cells_of_step(folder / "t.h5", f), frame_of(f).boxes) << f;
  EXPECT_EQ(values<double>(folder / "t.h5", "/VTKHDF/Steps/Values", H5T_NATIVE_DOUBLE)[3], 1.0);
  const auto types = values<std::uint8_t>(folder / "t.h5", "/VTKHDF/Types", H5T_NATIVE_UINT8);
  EXPECT_EQ(types, (std::vector<std::uint8_t>(kViewedBodies, 12))) << "12 = VTK_HEXAHEDRON";
  const auto velocity = values<float>(folder / "t.h5", "/VTKHDF/CellData/velocity", H5T_NATIVE_FLOAT);
  const auto at = static_cast<std::size_t>(integers(folder / "t.h5", "/VTKHDF/Steps/CellDataOffsets/velocity")[2] + 4);
  EXPECT_EQ(velocity[3 * at], 2.0F);
  EXPECT_EQ(velocity[3 * at + 1], 4.0F);
}

// VTK's order of corners: bottom round, then top round; otherwise the hexahedron is twisted.
TEST(Vtkhdf, CornersGoRoundAsVtkWantsThem) {
  const Folder folder;
  write_trace(folder / "t.h5", 1);
  const auto points = values<float>(folder / "t.h5", "/VTKHDF/Points", H5T_NATIVE_FLOAT);
  const auto connectivity = integers(folder / "t.h5", "/VTKHDF/Connectivity");
  std::vector<Vec3> corners;
  for (std::size_t c = 0; c < 8; ++c) {
    const auto p = 3 * static_cast<std::size_t>(connectivity[c]);
    corners.push_back({points[p], points[p + 1], points[p + 2]});
  }
  EXPECT_EQ(corners, (std::vector<Vec3>{
                         {0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 3}, {1, 0, 3}, {1, 2, 3}, {0, 2, 3}}));
}

TEST(Vtkhdf, NothingIsStoredTwice) {
  const Folder folder;
  write_trace(folder / "t.h5", kViewedFrames);
  const Handle file = raw_open(folder / "t.h5");
  for (const char* path : {"/VTKHDF/Points", "/VTKHDF/CellData/velocity", "/VTKHDF/Steps/Values"}) {
    const Handle set(H5Dopen2(file.get(), path, H5P_DEFAULT), H5Dclose);
    const Handle properties(H5Dget_create_plist(set.get()), H5Pclose);
    EXPECT_EQ(H5Pget_layout(properties.get()), H5D_VIRTUAL) << path;
  }
}

TEST(Vtkhdf, ATraceWithoutFramesOrBoxesHasNone) {
  const Folder folder;
  write_trace(folder / "none.h5", 0);
  auto writer = TraceWriter::create(folder / "digests.h5", header_of(tetrahedra_scene(kViewedBodies), 0));
  ASSERT_TRUE(writer.value().finish().ok());
  for (const char* name : {"none.h5", "digests.h5"}) {
    auto trace = TraceReader::open(folder / name);
    ASSERT_TRUE(trace.ok()) << trace.error().line();
    const auto report = write_xdmf(trace.value(), folder / "t.xdmf");
    EXPECT_FALSE(report.ok()) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "t.xdmf"));
}

TEST(View, FramesAreChosenAndBoxesAreWrittenOut) {
  const Folder folder;
  write_trace(folder / "t.h5", kViewedFrames);
  auto trace = TraceReader::open(folder / "t.h5");
  ViewRequest request;
  request.first_step = 2;
  request.last_step = 6;
  request.every = 2;  // steps 2, 4, 6 are frames 1, 3, 5
  const auto report = write_view(trace.value(), request, folder / "v.vtkhdf");
  ASSERT_TRUE(report.ok()) << report.error().line();
  EXPECT_EQ(report.value().frames, 3U);
  EXPECT_EQ(report.value().cells, kViewedBodies);
  EXPECT_EQ(cells_of_step(folder / "v.vtkhdf", 0), frame_of(1).boxes);
  EXPECT_EQ(cells_of_step(folder / "v.vtkhdf", 2), frame_of(5).boxes);
  EXPECT_TRUE(std::filesystem::exists(folder / "v.xdmf"));
  EXPECT_FALSE(std::filesystem::exists(folder / "v.vtkhdf.part"));
  request.first_step = 100;
  request.last_step = 200;
  EXPECT_FALSE(write_view(trace.value(), request, folder / "w.vtkhdf").ok());
  EXPECT_FALSE(std::filesystem::exists(folder / "w.vtkhdf"));
}

// A mesh's cells are its triangles, at its body's place; a level's cells tile what the box of the body covers.
TEST(View, MeshesAndOctreeBoxesStandWhereTheirBodiesAre) {
  const Folder folder;
  write_trace(folder / "t.h5", kViewedFrames);
  auto trace = TraceReader::open(folder / "t.h5");
  const Scene& scene = trace.value().header().scene;
  for (const ViewOf of : {ViewOf::kMeshes, ViewOf::kLevel1, ViewOf::kLevel2}) {
    ViewRequest request;
    request.of = of;
    const auto report = write_view(trace.value(), request, folder / "v.vtkhdf");
    ASSERT_TRUE(report.ok()) << report.error().line();
    const auto body = integers(folder / "v.vtkhdf", "/VTKHDF/CellData/body");
    const std::vector<Box> cells = cells_of_step(folder / "v.vtkhdf", 4);
    ASSERT_EQ(body.size(), cells.size());
    if (of == ViewOf::kMeshes) {
      EXPECT_EQ(cells.size(), kViewedBodies * 4U) << "tetrahedra";
    }
    // Body 1 is not turned: mesh 1's vertices, moved to its position at detection.
    Box all = empty_box();
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (body[c] == 1) all = grown(grown(all, cells[c].min), cells[c].max);
    Box mesh = empty_box();
    for (std::size_t v = 0; v < 4; ++v)
      mesh = grown(mesh, scene.meshes[1]->vertices[v] + frame_of(4).detected_position[1]);
    EXPECT_EQ(all.max, mesh.max);
    EXPECT_LE(all.min.x, mesh.min.x);
  }
}

}  // namespace
}  // namespace broadside::tests
