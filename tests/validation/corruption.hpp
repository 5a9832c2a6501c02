// Sound recordings of the CPU twin, spoiled one field at a time, and the law that must name each.
#pragma once

#include <gtest/gtest.h>

#include <iostream>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "bench/mutants/specimen_parts.hpp"
#include "tests/validation/engine_recording.hpp"

namespace broadside::tests {

using bench::contact_that;

// The digests are computed anew after a corruption, as a forger would, unless the corruption is one of digests.
enum class Digests { kRecomputed, kKept };

struct Corruption {
  const char* what;
  const char* scene;
  const char* law;
  void (*apply)(Recording&);
  Digests digests = Digests::kRecomputed;
};

// One recording per scene, "NAME" or "NAME key=value". Long scenes are cut to some frames.
inline const Recording& sound_run(const std::string& text) {
  static std::map<std::string, Recording> known;
  const auto found = known.find(text);
  if (found != known.end()) return found->second;
  const std::size_t space = text.find(' ');
  auto scene = bench::specimen_scene(text.substr(0, space));
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().line());
  core::Scene taken = scene.ok() ? std::move(scene).value() : core::Scene{};
  EngineSettings settings;
  if (space != std::string::npos) {
    const std::size_t equals = text.find('=', space);
    settings[text.substr(space + 1, equals - space - 1)] = text.substr(equals + 1);
  }
  return known.emplace(text, record(taken, settings)).first->second;
}

// Removes the frames of all steps after this one.
inline void cut_after(Recording& r, std::uint64_t step) {
  std::erase_if(r.frames, [step](const FrameRecord& f) { return f.step > step; });
}

inline FrameRecord& middle(Recording& r) {
  return r.frames[r.frames.size() / 2];
}

// The first frame with a contact that fits; the recording notes it when there is none.
template <typename Fits>
FrameRecord& frame_with(Recording& r, Fits fits) {
  for (FrameRecord& frame : r.frames)
    for (const Contact& c : frame.contacts)
      if (fits(c)) return frame;
  r.is_spoilable = false;
  return r.frames.front();
}

template <typename Fits>
void erase_contact(Recording& r, Fits fits) {
  FrameRecord& frame = frame_with(r, fits);
  for (auto c = frame.contacts.begin(); c != frame.contacts.end(); ++c)
    if (fits(*c)) {
      frame.contacts.erase(c);
      return;
    }
}

inline bool is_any(const Contact&) {
  return true;
}
// A contact that changes nothing: its bodies are within the slop and separate.
inline bool is_idle(const Contact& c) {
  return c.pre_a == c.post_a && c.pre_b == c.post_b;
}
inline bool is_idle_pair(const Contact& c) {
  return is_idle(c) && !core::is_face(c.b);
}
inline bool is_idle_face(const Contact& c) {
  return is_idle(c) && core::is_face(c.b);
}
inline bool is_pair(const Contact& c) {
  return !core::is_face(c.b);
}
inline bool is_pushing(const Contact& c) {
  return c.normal_impulse_n_s > 0.0F;
}

inline void expect_rejected(std::span<const Corruption> table) {
  std::size_t rejected = 0;
  for (const Corruption& c : table) {
    SCOPED_TRACE(std::string(c.scene) + ": " + c.what);
    const Recording& sound = sound_run(c.scene);
    const core::Verdict before = verdict_of(c.law, sound);
    EXPECT_EQ(before.outcome, core::Outcome::kPass) << line(before);
    Recording spoiled = sound;
    c.apply(spoiled);
    if (!spoiled.is_spoilable) {
      ADD_FAILURE() << "nothing of the kind that it changes";
      continue;
    }
    if (c.digests == Digests::kRecomputed)
      for (FrameRecord& frame : spoiled.frames) frame.digest = digest_of(frame);
    const core::Verdict after = verdict_of(c.law, spoiled);
    EXPECT_EQ(after.outcome, core::Outcome::kFail) << line(after);
    rejected += after.outcome == core::Outcome::kFail ? 1 : 0;
  }
  const std::string score = std::to_string(rejected) + " of " + std::to_string(table.size()) + " rejected";
  testing::Test::RecordProperty("score", score);
  std::cout << score << '\n';
}

}  // namespace broadside::tests
