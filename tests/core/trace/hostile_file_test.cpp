// Files made to do harm: each is refused in one line, without more memory than its size explains, or is read correctly.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iostream>

#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_writer.hpp"
#include "tests/core/trace/random_frames.hpp"
#include "tests/core/trace/raw_file.hpp"

namespace broadside::tests {
namespace {

using namespace core;

// The memory that a process may take for opening a trace of some 100 KiB: enough for the largest honest content, which
// inflates a thousandfold, and for HDF5's own tables.
constexpr std::uint64_t kRoom = 512U << 20U;

// Under a sanitizer the address space is taken from the start, so a limit would mean nothing.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kHasLimit = false;
#else
constexpr bool kHasLimit = true;
#endif

class HostileFile : public testing::Test {
 protected:
  void SetUp() override {
    Bits bits(4);
    auto writer = TraceWriter::create(path_, header_of(tetrahedra_scene(4), kAllGroups));
    ASSERT_TRUE(writer.ok());
    for (std::uint64_t k = 0; k < 5; ++k) ASSERT_TRUE(writer.value().append(random_frame(bits, k, 4, kAllGroups)).ok());
    ASSERT_TRUE(writer.value().finish().ok());
  }

  // Opens it and reads all of it, in a process of limited memory; the error line, or "" when all is read.
  std::string fault() const {
    std::array<int, 2> ends{};
    EXPECT_EQ(pipe(ends.data()), 0);
    const pid_t child = fork();
    if (child == 0) {
      if (kHasLimit) limit_memory();
      const std::string line = read_all();
      const ssize_t told = ::write(ends[1], line.data(), line.size());
      _exit(told == static_cast<ssize_t>(line.size()) ? 0 : 1);
    }
    close(ends[1]);
    std::string line;
    std::array<char, 4096> buffer{};
    for (ssize_t got = 0; (got = read(ends[0], buffer.data(), buffer.size())) > 0;)
      line.append(buffer.data(), static_cast<std::size_t>(got));
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "it ended by signal " << WTERMSIG(status);
    return line;
  }

  std::string read_all() const {
    const auto trace = TraceReader::open(path_);
    if (!trace) return trace.error().line();
    for (std::uint64_t k = 0; k < trace.value().frame_count(); ++k)
      if (const auto frame = trace.value().read(k, kAllGroups); !frame) return frame.error().line();
    const auto rows = trace.value().statistics();
    return rows ? "" : rows.error().line();
  }

  void expect_refused(const std::vector<std::string>& words) const {
    const std::string line = fault();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_EQ(line.find("more memory"), std::string::npos) << "it was asked for before it was looked at: " << line;
    for (const std::string& word : words) EXPECT_NE(line.find(word), std::string::npos) << word << ": " << line;
  }

  // Puts a dataset of this type, space and creation properties in the place of another.
  void replace(const char* path, hid_t type, const Handle& space, const Handle& properties) const {
    raw_remove(path_, path);
    const Handle file = raw_open(path_);
    const Handle set(H5Dcreate2(file.get(), path, type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                     H5Dclose);
    ASSERT_TRUE(set) << path;
  }
  static Handle plain() { return {H5Pcreate(H5P_DATASET_CREATE), H5Pclose}; }
  static Handle extent(const std::vector<hsize_t>& dims) {
    return {H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose};
  }
  static Handle chunked(const std::vector<hsize_t>& chunk) {
    Handle properties = plain();
    H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
    return properties;
  }

  const Folder folder_;
  const std::filesystem::path path_ = folder_ / "t.h5";

 private:
  static void limit_memory() {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const std::uint64_t now = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    const rlimit limit{now + kRoom, now + kRoom};
    setrlimit(RLIMIT_AS, &limit);
  }
};

TEST_F(HostileFile, IsGoodBeforeItIsSpoiled) {
  EXPECT_EQ(fault(), "");
}

TEST_F(HostileFile, WithAGroupInsideItselfIsReadWhereThatDoesNotMatter) {
  {
    const Handle file = raw_open(path_);
    ASSERT_GE(H5Lcreate_hard(file.get(), "/trace", file.get(), "/trace/again", H5P_DEFAULT, H5P_DEFAULT), 0);
    ASSERT_GE(H5Lcreate_hard(file.get(), "/", file.get(), "/trace/body/root", H5P_DEFAULT, H5P_DEFAULT), 0);
  }
  EXPECT_EQ(fault(), "");
}

TEST_F(HostileFile, WhoseGroupIsAnAncestorIsRefused) {
  raw_remove(path_, "/scene/body");
  {
    const Handle file = raw_open(path_);
    ASSERT_GE(H5Lcreate_hard(file.get(), "/", file.get(), "/scene/body", H5P_DEFAULT, H5P_DEFAULT), 0);
  }
  expect_refused({"/scene/body/mesh", "missing"});
}

TEST_F(HostileFile, OfSoftLinksThatGoRoundInACircleIsRefused) {
  raw_remove(path_, "/trace/time");
  {
    const Handle file = raw_open(path_);
    ASSERT_GE(H5Lcreate_soft("/trace/other", file.get(), "/trace/time", H5P_DEFAULT, H5P_DEFAULT), 0);
    ASSERT_GE(H5Lcreate_soft("/trace/time", file.get(), "/trace/other", H5P_DEFAULT, H5P_DEFAULT), 0);
  }
  expect_refused({"/trace/time", "missing"});
}

// A link into another file would show that file's content as this one's. A group on the path is tested as well as its
// end.
TEST_F(HostileFile, WithLinksOutOfItselfIsRefused) {
  std::filesystem::copy_file(path_, folder_ / "other.h5");
  raw_remove(path_, "/scene");
  {
    const Handle file = raw_open(path_);
    ASSERT_GE(H5Lcreate_external("other.h5", "/scene", file.get(), "/scene", H5P_DEFAULT, H5P_DEFAULT), 0);
  }
  expect_refused({"/scene@name", "missing"});
}

TEST_F(HostileFile, WhoseValuesLieElsewhereIsRefused) {
  std::ofstream(folder_ / "values") << std::string(4096, 'x');
  const Handle outside = plain();
  H5Pset_external(outside.get(), (folder_ / "values").c_str(), 0, 40);
  replace("/trace/digest", H5T_STD_U64LE, extent({5}), outside);
  expect_refused({"/trace/digest", "another file"});
}

TEST_F(HostileFile, WhoseDatasetIsAViewOfAnotherFileIsRefused) {
  const Handle view = plain();
  const Handle space = extent({5});
  ASSERT_GE(H5Pset_virtual(view.get(), space.get(), "other.h5", "/trace/digest", space.get()), 0);
  replace("/trace/digest", H5T_STD_U64LE, space, view);
  expect_refused({"/trace/digest", "another file"});
}

TEST_F(HostileFile, OfHugeExtentIsRefused) {
  const std::string good = read_all();
  ASSERT_EQ(good, "");
  const std::filesystem::path copy = folder_ / "copy.h5";
  std::filesystem::copy_file(path_, copy);
  const auto again = [&] {
    std::filesystem::copy_file(copy, path_, std::filesystem::copy_options::overwrite_existing);
  };

  const hsize_t much = hsize_t{1} << 40U;
  replace("/trace/pairs/pairs", H5T_STD_U32LE, extent({much, 2}), chunked({1024, 2}));
  expect_refused({"/trace/pairs/pairs", "cannot come from a file of"});
  again();
  // Contiguous: the claimed values are not in the file.
  replace("/scene/body/position", H5T_IEEE_F32LE, extent({1U << 28U, 3}), plain());
  expect_refused({"/scene/body/position", "cannot come from a file of"});
  again();
  // The product of the dimensions wraps to a small number.
  replace("/trace/body/position", H5T_IEEE_F32LE, extent({hsize_t{1} << 62U, 4, 3}), chunked({1, 4, 3}));
  expect_refused({"/trace/body/position", "cannot come from a file of"});
  again();
  // One row, in a chunk of 4 GiB that HDF5 would hold in memory to give it.
  const hsize_t two = 2;
  const hsize_t any = H5S_UNLIMITED;
  replace("/scene/mesh/is_stand_in", H5T_STD_U8LE, {H5Screate_simple(1, &two, &any), H5Sclose},
          chunked({(hsize_t{1} << 32U) - 1}));
  expect_refused({"/scene/mesh/is_stand_in", "chunks are larger"});
  again();
  const Handle text(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(text.get(), 1U << 30U);
  replace("/scene/mesh/name", text.get(), extent({2}), chunked({1}));
  expect_refused({"/scene/mesh/name", "longer than 1 MiB"});
}

TEST_F(HostileFile, OfAnotherTypeIsRefused) {
  const Handle odd_float(H5Tcopy(H5T_IEEE_F32LE), H5Tclose);
  H5Tset_fields(odd_float.get(), 31, 20, 11, 0, 20);  // 32 bits, but not IEEE's
  const Handle narrow(H5Tcopy(H5T_STD_U32LE), H5Tclose);
  H5Tset_precision(narrow.get(), 7);
  const Handle text(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(text.get(), H5T_VARIABLE);
  const Handle compound(H5Tcreate(H5T_COMPOUND, 4), H5Tclose);
  H5Tinsert(compound.get(), "a", 0, H5T_STD_U32LE);
  const Handle list(H5Tvlen_create(H5T_STD_U32LE), H5Tclose);
  const Handle choice(H5Tenum_create(H5T_STD_U32LE), H5Tclose);
  const std::uint32_t one = 1;
  H5Tenum_insert(choice.get(), "one", &one);
  const hsize_t three = 3;
  const Handle array(H5Tarray_create2(H5T_IEEE_F32LE, 1, &three), H5Tclose);
  const Handle opaque(H5Tcreate(H5T_OPAQUE, 4), H5Tclose);
  const std::filesystem::path copy = folder_ / "copy.h5";
  std::filesystem::copy_file(path_, copy);
  for (const hid_t type :
       {odd_float.get(), narrow.get(), text.get(), compound.get(), list.get(), choice.get(), array.get(), opaque.get(),
        H5T_STD_REF_OBJ, H5T_STD_B32LE, H5T_STD_I32LE, H5T_STD_U16LE, H5T_IEEE_F64LE}) {
    for (const char* path : {"/scene/body/inverse_mass", "/trace/contact/a"}) {
      std::filesystem::copy_file(copy, path_, std::filesystem::copy_options::overwrite_existing);
      replace(path, type, extent({4}), chunked({4}));
      expect_refused({path, "elements are not"});
    }
  }
}

TEST_F(HostileFile, InTheOtherByteOrderIsRead) {
  const std::uint32_t meshes[4] = {0, 1, 0, 1};
  replace("/scene/body/mesh", H5T_STD_U32BE, extent({4}), plain());
  {
    const Handle file = raw_open(path_);
    const Handle set(H5Dopen2(file.get(), "/scene/body/mesh", H5P_DEFAULT), H5Dclose);
    ASSERT_GE(H5Dwrite(set.get(), H5T_NATIVE_UINT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, meshes), 0);
  }
  EXPECT_EQ(fault(), "");
}

TEST_F(HostileFile, OfNegativeOffsetsIsRefused) {
  const std::filesystem::path copy = folder_ / "copy.h5";
  std::filesystem::copy_file(path_, copy);
  replace("/trace/contact/offsets", H5T_STD_I64LE, extent({6}), plain());
  expect_refused({"/trace/contact/offsets", "elements are not u64"});
  std::filesystem::copy_file(copy, path_, std::filesystem::copy_options::overwrite_existing);
  const std::int64_t falls[3] = {0, -8, 4};
  raw_overwrite(path_, "/trace/contact/offsets", falls, sizeof falls);
  expect_refused({"/trace/contact/offsets", "they fall"});
  std::filesystem::copy_file(copy, path_, std::filesystem::copy_options::overwrite_existing);
  const std::int64_t start[1] = {-1};
  raw_overwrite(path_, "/scene/mesh/vertex_offsets", start, sizeof start);
  expect_refused({"/scene/mesh", "do not fit together"});
}

TEST_F(HostileFile, OfAnotherRankIsRefused) {
  const std::filesystem::path copy = folder_ / "copy.h5";
  std::filesystem::copy_file(path_, copy);
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle nothing(H5Screate(H5S_NULL), H5Sclose);
  const Handle deep = extent(std::vector<hsize_t>(32, 1));
  for (const Handle* space : {&scalar, &nothing, &deep}) {
    std::filesystem::copy_file(copy, path_, std::filesystem::copy_options::overwrite_existing);
    replace("/trace/step", H5T_STD_U64LE, *space, plain());
    expect_refused({"/trace/step", "dimensions"});
  }
  std::filesystem::copy_file(copy, path_, std::filesystem::copy_options::overwrite_existing);
  replace("/scene/mesh/name", H5T_C_S1, nothing, plain());
  expect_refused({"/scene/mesh/name", "list of fixed-length strings"});
}

// A filter of a third-party plugin.
TEST_F(HostileFile, ThroughAFilterThatIsNotHereIsRefused) {
  constexpr H5Z_filter_t kOwn = 40000;
  const H5Z_class2_t filter{
      H5Z_CLASS_T_VERS,
      kOwn,
      1,
      1,
      "own",
      nullptr,
      nullptr,
      [](unsigned, std::size_t, const unsigned*, std::size_t bytes, std::size_t*, void**) { return bytes; }};
  ASSERT_GE(H5Zregister(&filter), 0);
  const Handle filtered = chunked({5});
  H5Pset_filter(filtered.get(), kOwn, 0, 0, nullptr);
  replace("/trace/digest", H5T_STD_U64LE, extent({5}), filtered);
  ASSERT_GE(H5Zunregister(kOwn), 0);
  expect_refused({"/trace/digest", "filter"});
}

// A filter of HDF5's own that shrinks whole numbers to their significant bits. It has a decoder, which traces never
// need.
TEST_F(HostileFile, ThroughAnotherFilterOfHdf5IsRefused) {
  const Handle filtered = chunked({5});
  H5Pset_scaleoffset(filtered.get(), H5Z_SO_INT, 0);
  replace("/trace/digest", H5T_STD_U64LE, extent({5}), filtered);
  expect_refused({"/trace/digest", "filter"});
}

TEST_F(HostileFile, OfDeepNestingIsRead) {
  {
    const Handle file = raw_open(path_);
    std::vector<Handle> levels;
    hid_t parent = file.get();
    for (int k = 0; k < 300; ++k) {
      levels.emplace_back(H5Gcreate2(parent, "deeper", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
      parent = levels.back().get();
    }
  }
  EXPECT_EQ(fault(), "");
}

// A text attribute that claims a gigabyte in a header of bytes.
TEST_F(HostileFile, WhoseAttributesAreWrongIsRefused) {
  const std::filesystem::path copy = folder_ / "copy.h5";
  std::filesystem::copy_file(path_, copy);
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle nothing(H5Screate(H5S_NULL), H5Sclose);
  const Handle variable(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(variable.get(), H5T_VARIABLE);
  struct Case {
    const char* object;
    const char* name;
    hid_t type;
    hid_t space;
    const char* word;
  };
  for (const Case& c : {Case{"/scene", "name", variable.get(), scalar.get(), "not one fixed-length string"},
                        Case{"/scene", "name", H5T_STD_U8LE, scalar.get(), "not one fixed-length string"},
                        Case{"/scene", "name", H5T_C_S1, nothing.get(), "not one fixed-length string"},
                        Case{"/scene", "dt_s", H5T_IEEE_F64LE, scalar.get(), "not of type f32"},
                        Case{"/scene", "dt_s", H5T_IEEE_F32LE, nothing.get(), "does not hold 1 value"},
                        Case{"/scene", "domain", H5T_IEEE_F32LE, scalar.get(), "does not hold 6 value"}}) {
    std::filesystem::copy_file(copy, path_, std::filesystem::copy_options::overwrite_existing);
    raw_remove_attribute(path_, c.object, c.name);
    {
      const Handle file = raw_open(path_);
      const Handle object(H5Oopen(file.get(), c.object, H5P_DEFAULT), H5Oclose);
      const Handle a(H5Acreate2(object.get(), c.name, c.type, c.space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
      ASSERT_TRUE(a);
    }
    expect_refused({std::string(c.object) + "@" + c.name, c.word});
  }
}

}  // namespace
}  // namespace broadside::tests
