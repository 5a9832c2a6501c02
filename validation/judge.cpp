#include "validation/judge.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "core/nearest_name.hpp"
#include "core/scene/scene.hpp"
#include "validation/mechanics/motion.hpp"
#include "validation/scene_relation.hpp"

namespace broadside::validation {
namespace {

// How often progress is reported: often enough for a live estimate, too seldom to cost time.
constexpr std::uint64_t kFramesPerReport = 50;

// One row of the pass: a running validator, or the verdict that says why it did not run.
struct Entry {
  const ValidatorRow* row = nullptr;
  bool compares_scenes = false;
  bool reads_motion = false;
  std::unique_ptr<Validator> validator;
  core::Verdict verdict;
};

core::Status check_names(const std::vector<std::string>& only) {
  std::vector<std::string_view> known;
  for (const ValidatorRow& row : validators()) known.push_back(row.name);
  for (const std::string& name : only)
    if (std::find(known.begin(), known.end(), name) == known.end())
      return core::Error{"unknown validator '" + name + "'", "",
                         core::advise_name(name, known, "broadside list validators")};
  return core::Done{};
}

std::string hex(std::uint64_t digest) {
  char text[24];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(digest));
  return text;
}

// True for one scene, or for a scene that follows from the other.
core::Status check_scenes(const core::TraceHeader& a, const core::TraceHeader& b) {
  if (a.stamp.scene_digest == b.stamp.scene_digest || relation_of(a.scene, b.scene)) return core::Done{};
  return core::Error{
      "the two traces are of different scenes (" + a.stamp.scene_name + " " + hex(a.stamp.scene_digest) + " and " +
          b.stamp.scene_name + " " + hex(b.stamp.scene_digest) + ")",
      "baseline " + b.stamp.label(),
      "record both from one scene file, with the same parameters, or one from the other's scene, transformed"};
}

std::vector<Entry> make_entries(const Subject& subject, const JudgeOptions& options, std::uint32_t& groups,
                                std::uint32_t& baseline_groups) {
  // What validators see that compare runs of one scene: no baseline, when the baseline is of another scene.
  Subject alone = subject;
  const bool is_transformed =
      subject.baseline != nullptr && subject.baseline->stamp.scene_digest != subject.header.stamp.scene_digest;
  if (is_transformed) alone.baseline = nullptr;
  std::vector<Entry> entries;
  for (const ValidatorRow& row : validators()) {
    if (!options.only.empty() && std::find(options.only.begin(), options.only.end(), row.name) == options.only.end())
      continue;
    Entry entry;
    entry.row = &row;
    entry.compares_scenes = row.compares_scenes;
    entry.reads_motion = row.reads_motion;
    const Subject& seen = row.compares_scenes ? subject : alone;
    entry.verdict.validator = row.name;
    entry.verdict.explanation = row.why_not(seen);
    if (entry.verdict.explanation.empty()) {
      entry.validator = row.make(seen);
      groups |= row.groups;
      if (seen.baseline != nullptr) baseline_groups |= row.baseline_groups;
    }
    entries.push_back(std::move(entry));
  }
  groups &= subject.header.groups;
  baseline_groups &= subject.baseline != nullptr ? subject.baseline->groups : 0;
  return entries;
}

core::Verdict conclude(Entry& entry) {
  core::Verdict verdict = entry.validator ? entry.validator->conclude() : std::move(entry.verdict);
  verdict.law = entry.row->law;
  verdict.kind = entry.row->kind;
  verdict.ties_motion_to_forces = entry.row->ties_motion_to_forces;
  // Only laws of motion may claim to have proven one.
  if (!verdict.ties_motion_to_forces) verdict.moved = 0;
  return verdict;
}

// Walks the baseline beside the subject: both have rising steps.
class BaselineFrames {
 public:
  BaselineFrames(const FrameSource* source, std::uint32_t groups) : source_(source), groups_(groups) {}

  // The frame of this step, or null where the baseline has none.
  core::Result<const core::FrameRecord*> at(std::uint64_t step) {
    if (source_ == nullptr) return static_cast<const core::FrameRecord*>(nullptr);
    while (next_ < source_->steps.size() && source_->steps[next_] < step) ++next_;
    if (next_ == source_->steps.size() || source_->steps[next_] != step)
      return static_cast<const core::FrameRecord*>(nullptr);
    auto frame = source_->read(next_, groups_);
    if (!frame) return frame.error();
    frame_ = std::move(frame).value();
    return static_cast<const core::FrameRecord*>(&*frame_);
  }

 private:
  const FrameSource* source_;
  std::uint32_t groups_;
  std::size_t next_ = 0;
  std::optional<core::FrameRecord> frame_;
};

// Validators share no data that they write. So all of them look at a frame in parallel, on as many threads as there
// are, while the next frame is read; no verdict depends on the thread that computed it.
template <typename Read>
void look_and_read(std::vector<Entry>& entries, const Evidence& evidence, const Evidence& alone, const Read& read) {
  const tbb::blocked_range<std::size_t> jobs(0, entries.size() + 1, 1);
  const auto run = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      if (k == 0) {
        read();
        continue;
      }
      Entry& entry = entries[k - 1];
      if (entry.validator) entry.validator->look(entry.row->compares_scenes ? evidence : alone);
    }
  };
  tbb::parallel_for(jobs, run, tbb::simple_partitioner());
}

}  // namespace

core::Result<std::vector<core::Verdict>> judge(const FrameSource& subject, const FrameSource* baseline,
                                               const JudgeOptions& options) {
  if (core::Status s = check_names(options.only); !s) return s.error();
  if (baseline != nullptr)
    if (core::Status s = check_scenes(subject.header, baseline->header); !s) return s.error();

  const bool is_transformed =
      baseline != nullptr && baseline->header.stamp.scene_digest != subject.header.stamp.scene_digest;
  std::uint32_t groups = options.observed_groups;
  std::uint32_t baseline_groups = 0;
  const Subject facts{subject.header, baseline != nullptr ? &baseline->header : nullptr, subject.steps.size(),
                      &subject.statistics, subject.is_cut_off};
  std::vector<Entry> entries = make_entries(facts, options, groups, baseline_groups);

  std::optional<MotionReader> motions;
  if (std::any_of(entries.begin(), entries.end(), [](const Entry& e) { return e.validator && e.reads_motion; }))
    motions.emplace(subject.header);

  BaselineFrames baseline_frames(baseline, baseline_groups);
  std::optional<core::FrameRecord> previous;
  const std::uint64_t total = subject.steps.size();
  std::optional<core::Result<core::FrameRecord>> next;
  if (total > 0) next = subject.read(0, groups);
  for (std::uint64_t index = 0; index < total; ++index) {
    if (!*next) return next->error();
    core::FrameRecord frame = std::move(*next).value();
    next.reset();
    const auto counterpart = baseline_frames.at(frame.step);
    if (!counterpart) return counterpart.error();
    const bool follows = previous && previous->step + 1 == frame.step;
    const core::FrameRecord* before = follows ? &*previous : nullptr;
    const Motion* motion = motions ? motions->read(frame, before) : nullptr;
    const Evidence evidence{frame, before, counterpart.value(), motion};
    const Evidence alone{frame, before, is_transformed ? nullptr : evidence.baseline, motion};
    look_and_read(entries, evidence, alone, [&] {
      if (index + 1 < total) next = subject.read(index + 1, groups);
    });
    if (options.observe) options.observe(evidence);
    previous = std::move(frame);
    if (options.progress && ((index + 1) % kFramesPerReport == 0 || index + 1 == total))
      options.progress(index + 1, total);
  }

  std::vector<core::Verdict> verdicts;
  verdicts.reserve(entries.size());
  for (Entry& entry : entries) verdicts.push_back(conclude(entry));
  return verdicts;
}

}  // namespace broadside::validation
