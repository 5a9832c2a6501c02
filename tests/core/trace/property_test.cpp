// Properties of every frame, on frames that rapidcheck draws and shrinks: what is written is what is read, bit by bit.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <cstdlib>

#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_stream.hpp"
#include "core/trace/trace_writer.hpp"
#include "tests/core/trace/random_frames.hpp"
#include "tests/core/trace/raw_file.hpp"

namespace broadside::tests {
namespace {

using namespace core;

constexpr std::uint32_t kQuietNan = 0x7FC0BEEFU;      // with a payload
constexpr std::uint32_t kSignalingNan = 0xFF812345U;  // negative, with a payload
constexpr std::uint32_t kMinusZero = 0x80000000U;
constexpr std::uint32_t kSubnormal = 0x00000001U;

// Any 32 bits; special values often.
rc::Gen<float> any_float() {
  return rc::gen::map(
      rc::gen::oneOf(rc::gen::arbitrary<std::uint32_t>(),
                     rc::gen::element(kQuietNan, kSignalingNan, kMinusZero, kSubnormal, 0x7F800000U, 0xFF800000U)),
      [](std::uint32_t bits) { return std::bit_cast<float>(bits); });
}

Vec3 any_vec() {
  return {*any_float(), *any_float(), *any_float()};
}

Kinematics any_kinematics() {
  return {any_vec(), any_vec()};
}

Contact any_contact(std::uint32_t bodies) {
  Contact c;
  c.a = *rc::gen::inRange(0U, bodies);
  c.b = *rc::gen::oneOf(rc::gen::inRange(0U, bodies), rc::gen::inRange(kFirstFace, kFirstFace + kFaceCount));
  c.color = *rc::gen::arbitrary<std::uint32_t>();
  c.depth_m = *any_float();
  c.normal = any_vec();
  c.normal_impulse_n_s = *any_float();
  c.tangent = any_vec();
  c.tangent_impulse_n_s = *any_float();
  c.pre_a = any_kinematics();
  c.pre_b = any_kinematics();
  c.post_a = any_kinematics();
  c.post_b = any_kinematics();
  return c;
}

// Bodies and contacts; of both there may be none.
FrameRecord any_frame(std::uint64_t step, std::uint32_t bodies) {
  FrameRecord f;
  f.step = step;
  f.time_s = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
  f.digest = *rc::gen::arbitrary<std::uint64_t>();
  for (std::uint32_t i = 0; i < bodies; ++i) {
    f.position.push_back(any_vec());
    f.orientation.push_back({*any_float(), *any_float(), *any_float(), *any_float()});
    f.velocity.push_back(any_vec());
    f.angular_velocity.push_back(any_vec());
  }
  const int contacts = bodies == 0 ? 0 : *rc::gen::inRange(0, 4);
  for (int k = 0; k < contacts; ++k) f.contacts.push_back(any_contact(bodies));
  return f;
}

constexpr std::uint32_t kStatesAndContacts = bit(Group::kBodies) | bit(Group::kContacts);

std::vector<FrameRecord> any_frames(std::uint32_t bodies) {
  std::vector<FrameRecord> frames;
  const int count = *rc::gen::inRange(0, 8);
  std::uint64_t step = 0;
  for (int k = 0; k < count; ++k) {
    step += *rc::gen::inRange<std::uint64_t>(1, 200);  // windows of the statistics open and close
    frames.push_back(any_frame(step, bodies));
  }
  return frames;
}

void expect_frames(const std::filesystem::path& path, const std::vector<FrameRecord>& wrote) {
  auto reader = TraceReader::open(path);
  RC_ASSERT(reader.ok());
  RC_ASSERT(reader.value().frame_count() == wrote.size());
  for (std::uint64_t k = 0; k < wrote.size(); ++k) {
    auto frame = reader.value().read(k, kStatesAndContacts);
    RC_ASSERT(frame.ok());
    RC_ASSERT(first_difference(wrote[k], frame.value()) == "");
  }
}

// Fewer cases than rapidcheck's 100: each writes and reads a file. RC_PARAMS, if set, says otherwise, or gives the seed
// of a failure again.
template <typename Law>
bool holds(const char* what, Law law) {
  setenv("RC_PARAMS", "max_success=40", 0);
  return rc::check(what, law);
}

TEST(Property, WhatIsWrittenIsWhatIsRead) {
  EXPECT_TRUE(holds("frames come back bit by bit", [] {
    const Folder folder;
    const std::uint32_t bodies = *rc::gen::inRange(0U, 4U);
    const std::vector<FrameRecord> frames = any_frames(bodies);
    auto writer = TraceWriter::create(folder / "t.h5", header_of(tetrahedra_scene(bodies), kStatesAndContacts));
    RC_ASSERT(writer.ok());
    for (const FrameRecord& f : frames) {
      // Whole chunks that skip the filters, or rows that go through the filters: no reader sees a difference.
      writer.value().hurry(*rc::gen::arbitrary<bool>());
      RC_ASSERT(writer.value().append(f).ok());
      if (*rc::gen::inRange(0, 3) == 0) RC_ASSERT(writer.value().flush().ok());
    }
    RC_ASSERT(writer.value().finish().ok());
    expect_frames(folder / "t.h5", frames);
  }));
}

TEST(Property, AStreamWithAQueueOfAnySizeWritesTheSame) {
  EXPECT_TRUE(holds("a bounded queue loses and reorders nothing", [] {
    const Folder folder;
    const std::vector<FrameRecord> frames = any_frames(2);
    auto stream = TraceStream::create(folder / "t.h5", header_of(tetrahedra_scene(2), kStatesAndContacts),
                                      *rc::gen::inRange<std::size_t>(0, 4000));
    RC_ASSERT(stream.ok());
    for (const FrameRecord& f : frames) RC_ASSERT(stream.value().append(f).ok());
    RC_ASSERT(stream.value().finish().ok());
    expect_frames(folder / "t.h5", frames);
  }));
}

// As a big-endian reader sees it: the file is marked as little-endian, and its bytes are in that order.
TEST(Property, NumbersLieLittleEndianInTheFile) {
  const Folder folder;
  auto writer = TraceWriter::create(folder / "t.h5", header_of(tetrahedra_scene(1), bit(Group::kBodies)));
  ASSERT_TRUE(writer.ok());
  FrameRecord f;
  f.step = 0x0102030405060708U;
  f.position = {{std::bit_cast<float>(kQuietNan), -0.0F, 1.0F}};
  f.orientation = {{}};
  f.velocity = f.angular_velocity = {{}};
  ASSERT_TRUE(writer.value().append(f).ok());
  ASSERT_TRUE(writer.value().finish().ok());

  const Handle file = raw_open(folder / "t.h5");
  const auto bytes_as = [&file](const char* path, hid_t type, std::size_t size) {
    const Handle set(H5Dopen2(file.get(), path, H5P_DEFAULT), H5Dclose);
    const Handle stored(H5Dget_type(set.get()), H5Tclose);
    EXPECT_EQ(H5Tget_order(stored.get()), H5T_ORDER_LE) << path;
    std::vector<unsigned char> bytes(size);
    EXPECT_GE(H5Dread(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), 0) << path;
    return bytes;
  };
  using Bytes = std::vector<unsigned char>;
  EXPECT_EQ(bytes_as("/trace/step", H5T_STD_U64LE, 8), (Bytes{8, 7, 6, 5, 4, 3, 2, 1}));
  EXPECT_EQ(bytes_as("/trace/step", H5T_STD_U64BE, 8), (Bytes{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(bytes_as("/trace/body/position", H5T_IEEE_F32LE, 12),
            (Bytes{0xEF, 0xBE, 0xC0, 0x7F, 0, 0, 0, 0x80, 0, 0, 0x80, 0x3F}));
}

}  // namespace
}  // namespace broadside::tests
