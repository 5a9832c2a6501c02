// The digest of a frame's records: expected numbers are worked out from SCHEMA.md's definition, and every field changes
// the digest.
#include "core/method/frame_digest.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <set>
#include <vector>

namespace broadside::tests {
namespace {

using namespace core;

// Fields in the order of the definition are 1, 2, 3, ... 21.
Contact numbered() {
  Contact c;
  c.a = 2;
  c.b = 9;
  c.color = 4;
  c.normal = {1, 2, 3};
  c.depth_m = 4;
  c.tangent = {5, 6, 7};
  c.tangent_impulse_n_s = 8;
  c.post_a.x = {9, 10, 11};
  c.normal_impulse_n_s = 12;
  c.post_a.v = {13, 14, 15};
  c.post_b.x = {16, 17, 18};
  c.post_b.v = {19, 20, 21};
  return c;
}

// Computed in Python, with integers of any size, from the page's definition.
TEST(FrameDigest, IsThatOfItsDefinition) {
  EXPECT_EQ(body_digest(7, {1.5F, -2, 0.25F}, {1, 0, 0, 0}, {3, 4, -5}, {}), 0xa7621c9b7f6e8e4cU);
  EXPECT_EQ(body_digest(3, {1, 2, 3}, {0.5F, -0.5F, 0.5F, 0.5F}, {4, 5, 6}, {1, 2, 3}), 0x6604740b3e8adb30U);
  EXPECT_EQ(confirmed_digest({2, 9}), 0xcec61f61f41900cbU);
  EXPECT_EQ(contact_digest(numbered()), 0xb8eae15373234e33U);
}

TEST(FrameDigest, EveryNumberOfAContactCounts) {
  const std::vector<float Contact::*> numbers{&Contact::depth_m, &Contact::normal_impulse_n_s,
                                              &Contact::tangent_impulse_n_s};
  std::set<std::uint64_t> digests{contact_digest(numbered())};
  const auto add = [&](const Contact& c) { EXPECT_TRUE(digests.insert(contact_digest(c)).second) << digests.size(); };
  for (const auto number : numbers) {
    Contact c = numbered();
    c.*number += 0.5F;
    add(c);
  }
  for (const auto vector : {&Contact::normal, &Contact::tangent})
    for (int k = 0; k < 3; ++k) {
      Contact c = numbered();
      (c.*vector)[k] += 0.25F;
      add(c);
    }
  for (const auto state : {&Contact::post_a, &Contact::post_b})
    for (const auto part : {&Kinematics::x, &Kinematics::v})
      for (int k = 0; k < 3; ++k) {
        Contact c = numbered();
        (c.*state.*part)[k] += 0.125F;
        add(c);
      }
  for (const auto id : {&Contact::a, &Contact::b, &Contact::color}) {
    Contact c = numbered();
    c.*id += 1;
    add(c);
  }
}

// States before an application repeat what earlier records hold, so they do not count.
TEST(FrameDigest, StatesBeforeAContactDoNot) {
  Contact c = numbered();
  c.pre_a.x.x = c.pre_b.v.z = 1;
  EXPECT_EQ(contact_digest(c), contact_digest(numbered()));
}

TEST(FrameDigest, EveryNumberOfABodyCounts) {
  std::set<std::uint64_t> digests;
  for (int changed = -1; changed < 13; ++changed) {
    float n[13] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13};
    if (changed >= 0) n[changed] += 0.5F;
    digests.insert(
        body_digest(5, {n[0], n[1], n[2]}, {n[3], n[4], n[5], n[6]}, {n[7], n[8], n[9]}, {n[10], n[11], n[12]}));
  }
  digests.insert(body_digest(6, {1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10}, {11, 12, 13}));
  EXPECT_EQ(digests.size(), 15U);
}

TEST(FrameDigest, ABodyThatStandsStillIsHashedInTwoParts) {
  const Quat q{0.5F, -0.5F, 0.5F, 0.5F};
  EXPECT_EQ(body_digest(still_body_digest(3, q, {1, 2, 3}), {1, 2, 3}, {4, 5, 6}),
            body_digest(3, {1, 2, 3}, q, {4, 5, 6}, {1, 2, 3}));
}

TEST(FrameDigest, PairsAndTheirOrderCount) {
  EXPECT_NE(confirmed_digest({2, 9}), confirmed_digest({9, 2}));
  EXPECT_NE(confirmed_digest({2, 9}), confirmed_digest({2, 8}));
}

}  // namespace
}  // namespace broadside::tests
