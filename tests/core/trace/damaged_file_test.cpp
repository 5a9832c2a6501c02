// A reader trusts nothing: each file that is no trace, or not a whole one, is refused with one line that says where.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_writer.hpp"
#include "tests/core/trace/random_frames.hpp"
#include "tests/core/trace/raw_file.hpp"

namespace broadside::tests {
namespace {

using namespace core;

class DamagedFile : public testing::Test {
 protected:
  void SetUp() override {
    Bits bits(9);
    auto writer = TraceWriter::create(path_, header_of(tetrahedra_scene(4), kAllGroups));
    ASSERT_TRUE(writer.ok());
    for (std::uint64_t k = 0; k < 20; ++k) {
      FrameRecord frame = random_frame(bits, k, 4, kAllGroups);
      if (k == 0) make_first(frame);
      ASSERT_TRUE(writer.value().append(frame).ok());
    }
    ASSERT_TRUE(writer.value().finish().ok());
    ASSERT_EQ(fault(), "") << "the file is good before it is damaged";
  }

  // The frame has a row of everything, so that the first row of each dataset belongs to the first frame.
  static void make_first(FrameRecord& f) {
    Bits bits(2);
    f.pairs = f.confirmed = f.measured = {{0, 1}};
    f.proximity = {{0.5F, 1, 2}};
    f.separations = {{0.25, false, {}, {}, {}}};
    f.contacts = {random_contact(bits, 4)};
  }

  // The error line of opening it or of reading any frame; "" when all can be read.
  std::string fault() const {
    const auto reader = TraceReader::open(path_);
    if (!reader) return reader.error().line();
    for (std::uint64_t k = 0; k < reader.value().frame_count(); ++k)
      if (const auto frame = reader.value().read(k, kAllGroups); !frame) return frame.error().line();
    if (const auto rows = reader.value().statistics(); !rows) return rows.error().line();
    return "";
  }

  void expect_fault(const std::vector<std::string>& words) const {
    const std::string line = fault();
    EXPECT_NE(line.find(path_.string()), std::string::npos) << line;
    for (const std::string& word : words) EXPECT_NE(line.find(word), std::string::npos) << word << ": " << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }

  // Datasets that a reader of traces reads: not the views for other programs.
  static bool is_read(const RawItem& item) {
    return item.path.find('@') == std::string::npos && item.path.rfind("/VTKHDF/", 0) != 0;
  }

  void write_bytes(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
  std::string bytes() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  const Folder folder_;
  const std::filesystem::path path_ = folder_ / "t.h5";
};

TEST_F(DamagedFile, ThatIsAbsentOrAFolder) {
  std::filesystem::remove(path_);
  expect_fault({"there is no such file"});
  std::filesystem::create_directory(path_);
  expect_fault({"it is not a file"});
}

TEST_F(DamagedFile, ThatIsNotHdf5) {
  write_bytes("");
  expect_fault({"not an HDF5 file"});
  write_bytes(std::string(100000, 'x'));
  expect_fault({"not an HDF5 file"});
}

TEST_F(DamagedFile, ThatWasCutShort) {
  const std::string whole = bytes();
  for (const double share : {0.999, 0.9, 0.5, 0.1, 0.01}) {
    write_bytes(whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    expect_fault({"damaged HDF5 file"});
  }
}

// Once, HDF5 retried such a superblock forever, as one that a writer is just changing.
TEST_F(DamagedFile, WhoseSuperblockIsSpoiled) {
  const std::string good = bytes();
  for (std::size_t at = 8; at < 48; ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    write_bytes(bad);
    EXPECT_NE(fault(), "") << "byte " << at;
  }
}

TEST_F(DamagedFile, ThatIsHdf5ButNoTrace) {
  raw_remove_attribute(path_, "/", "format");
  expect_fault({"/@format", "not a Broadside trace"});
}

TEST_F(DamagedFile, OfAnotherFormatVersion) {
  const std::uint32_t later = kTraceFormatVersion + 1;
  raw_set_attribute(path_, "/", "format_version", H5T_NATIVE_UINT32, &later);
  expect_fault({"/@format_version", "format " + std::to_string(later), "use a newer Broadside"});
  const std::uint32_t earlier = 0;
  raw_set_attribute(path_, "/", "format_version", H5T_NATIVE_UINT32, &earlier);
  expect_fault({"/@format_version", "format 0", "formats 1 to 2"});
}

TEST_F(DamagedFile, WithoutAnyOneOfItsDatasets) {
  // What a trace may leave out (SCHEMA.md): an engine's own names of its points, the number of parts of a step, and the
  // orientation at detection.
  const std::set<std::string> optional{"/trace/point/feature", "/trace/point/parts", "/trace/detection/orientation"};
  const std::string good = bytes();
  for (const RawItem& item : raw_items(path_)) {
    if (!is_read(item) || optional.contains(item.path)) continue;
    write_bytes(good);
    raw_remove(path_, item.path);
    expect_fault({item.path, "missing"});
  }
}

TEST_F(DamagedFile, WithAnyOneDatasetOfAnotherTypeOrRank) {
  const std::string good = bytes();
  for (const RawItem& item : raw_items(path_)) {
    if (!is_read(item)) continue;
    write_bytes(good);
    raw_replace(path_, item.path, H5T_STD_I16LE, item.shape);
    expect_fault({item.path});
    const std::string deeper = item.path;
    write_bytes(good);
    std::vector<std::uint64_t> shape = item.shape;
    shape.push_back(2);
    raw_replace(path_, item.path, item.type == "f32" ? H5T_IEEE_F32LE : H5T_STD_U32LE, shape);
    expect_fault({item.path});
  }
}

TEST_F(DamagedFile, ThatClaimsMoreThanItCanHold) {
  raw_replace(path_, "/trace/digest", H5T_STD_U64LE, {std::uint64_t{1} << 50U});
  expect_fault({"/trace/digest", "cannot come from a file of"});
}

TEST_F(DamagedFile, WhoseDatasetsEndAtDifferentFrames) {
  raw_replace(path_, "/trace/digest", H5T_STD_U64LE, {19});
  expect_fault({"/trace", "19 to 20"});
}

TEST_F(DamagedFile, WhoseOffsetsAreWrong) {
  const std::string good = bytes();
  const std::uint64_t start = 1;
  raw_overwrite(path_, "/trace/contact/offsets", &start, sizeof start);
  expect_fault({"/trace/contact/offsets", "do not start with 0"});
  for (const std::uint64_t wrong : {std::uint64_t{100000}, ~std::uint64_t{0}}) {
    write_bytes(good);
    const std::uint64_t list[2] = {0, wrong};
    raw_overwrite(path_, "/trace/pairs/offsets", list, sizeof list);
    expect_fault({"/trace/pairs/offsets", "they fall"});
  }
  write_bytes(good);
  const std::uint64_t list[2] = {0, 0};
  raw_overwrite(path_, "/trace/confirmed/offsets", list, sizeof list);
  expect_fault({"/trace/confirmed/proximity_offsets", "frame 0 has 1 proximities for 0 confirmed pairs"});
}

TEST_F(DamagedFile, WhoseStepsDoNotRise) {
  // The second frame is of step 1. With 7 in its place the steps decrease; with 1 the same step is there twice.
  for (const std::uint64_t step : {7U, 1U}) {
    raw_overwrite(path_, "/trace/step", &step, sizeof step);
    expect_fault({"/trace/step", "do not rise"});
  }
}

TEST_F(DamagedFile, ThatNamesBodiesOrVerticesThatDoNotExist) {
  const std::string good = bytes();
  const std::uint32_t four = 4;
  const std::uint32_t beyond_faces = kFirstFace + kFaceCount;
  const auto spoiled = [&](const char* set, const std::uint32_t& id) {
    write_bytes(good);
    raw_overwrite(path_, set, &id, sizeof id);
  };
  spoiled("/trace/pairs/pairs", four);
  expect_fault({"/trace/pairs/pairs", "step 0 names a body"});
  spoiled("/trace/confirmed/pairs", four);
  expect_fault({"/trace/confirmed/pairs", "step 0 names a body"});
  spoiled("/trace/narrow/pairs", four);
  expect_fault({"/trace/narrow/pairs", "step 0 names a body"});
  spoiled("/trace/contact/a", kFirstFace);
  expect_fault({"/trace/contact", "step 0 names a body"});
  spoiled("/trace/contact/b", beyond_faces);
  expect_fault({"/trace/contact", "step 0 names a body"});
  spoiled("/trace/confirmed/vertex_a", four);  // body 0 has the mesh with vertices 0 to 3
  expect_fault({"/trace/confirmed", "names a vertex"});
}

TEST_F(DamagedFile, WhoseSceneWasChanged) {
  const std::string good = bytes();
  const float position = 0.5F;
  raw_overwrite(path_, "/scene/body/position", &position, sizeof position);
  expect_fault({"/scene@digest", "not the digest of the scene"});
  write_bytes(good);
  const float dt = -1.0F;
  raw_set_attribute(path_, "/scene", "dt_s", H5T_NATIVE_FLOAT, &dt);
  expect_fault({"/scene", "dt_s"});
  write_bytes(good);
  const std::uint32_t mesh = 9;
  raw_overwrite(path_, "/scene/body/mesh", &mesh, sizeof mesh);
  expect_fault({"/scene", "mesh"});
  write_bytes(good);
  const std::uint64_t other = 1;
  raw_set_attribute(path_, "/provenance", "scene_digest", H5T_NATIVE_UINT64, &other);
  expect_fault({"/provenance@scene_digest", "another scene"});
}

TEST_F(DamagedFile, ThatLinksToAnotherFile) {
  std::filesystem::copy_file(path_, folder_ / "other.h5");
  raw_remove(path_, "/trace/digest");
  {
    const Handle opened = raw_open(path_);
    ASSERT_GE(H5Lcreate_external("other.h5", "/trace/digest", opened.get(), "/trace/digest", H5P_DEFAULT, H5P_DEFAULT),
              0);
  }
  expect_fault({"/trace/digest", "missing"});
}

// A trace from another program: no stamp but the engine, no digest of the scene, no statistics.
TEST_F(DamagedFile, OrOnlyForeignIsRead) {
  for (const RawItem& item : raw_items(path_)) {
    const bool is_stamp = item.path.rfind("/provenance@", 0) == 0 && item.path != "/provenance@engine";
    if (is_stamp) raw_remove_attribute(path_, "/provenance", item.path.substr(12));
  }
  raw_remove_attribute(path_, "/scene", "digest");
  raw_remove_attribute(path_, "/scene", "description");
  raw_remove(path_, "/trace/statistics");
  raw_remove(path_, "/trace/narrow");
  raw_remove(path_, "/provenance/notes");
  EXPECT_EQ(fault(), "");
  const auto reader = TraceReader::open(path_);
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(reader.value().header().groups, kAllGroups & ~bit(Group::kNarrow));
  EXPECT_EQ(reader.value().header().stamp.engine, "octree-cpu");
  EXPECT_EQ(reader.value().header().stamp.scene_digest, scene_digest(reader.value().header().scene));
}

}  // namespace
}  // namespace broadside::tests
