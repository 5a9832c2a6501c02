#include "validation/recording.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "core/contact.hpp"
#include "core/trace/statistics.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

using core::PenetrationStatistics;

constexpr std::string_view kLevel = "SCHEMA.md: level full records groups, digest none, and none leaves no trace";
constexpr std::string_view kEvery = "SCHEMA.md: every k-th frame was recorded, and the last one";
constexpr std::string_view kWindows =
    "a recorded step is in one of the windows of steps that the trace names, or the last one";
constexpr std::string_view kStatistics = "METHOD 9: the statistics are those of the recorded contacts, per 100 steps";
// Depths are summed in double, one rounding for each.
constexpr double kDoubleRoundoff = 0x1p-53;

std::uint64_t window_of(std::uint64_t step) {
  return step == 0 ? 0 : (step - 1) / 100;
}

// The contacts of the frames of one window.
struct Window {
  std::uint64_t first_step = 0;
  std::uint64_t last_step = 0;
  std::uint64_t frames = 0;
  std::uint64_t on_bodies = 0;
  std::uint64_t on_faces = 0;
  std::uint64_t above_slop = 0;
  double sum_m = 0.0;
  double largest_m = 0.0;
};

struct StepWindow {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};

// "1:50,100:250" as the trace's note has it; nothing where there is no note. For a text that is no list of windows the
// list is empty, so that no step is inside a window.
std::optional<std::vector<StepWindow>> told_windows(const core::TraceHeader& header) {
  const auto note = header.notes.find("windows of steps");
  if (note == header.notes.end()) return std::nullopt;
  std::vector<StepWindow> windows;
  const std::string& text = note->second;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data(); at < end; ++at) {
    StepWindow w;
    const auto [colon, bad_first] = std::from_chars(at, end, w.first);
    if (bad_first != std::errc() || colon == end || *colon != ':') return std::vector<StepWindow>{};
    const auto [comma, bad_last] = std::from_chars(colon + 1, end, w.last);
    if (bad_last != std::errc() || (comma != end && *comma != ',')) return std::vector<StepWindow>{};
    windows.push_back(w);
    at = comma;
  }
  return windows;
}

class Recording final : public Validator {
 public:
  explicit Recording(const Subject& subject)
      : subject_(subject), header_(subject.header), windows_of_steps_(told_windows(subject.header)) {}

  void look(const Evidence& evidence) override {
    const core::FrameRecord& frame = evidence.frame;
    judge_level(frame.step);
    judge_every(frame.step);
    if (window_.frames > 0 && window_of(window_.last_step) != window_of(frame.step)) close_window();
    if (window_.frames++ == 0) window_.first_step = frame.step;
    window_.last_step = frame.step;
    for (const core::Contact& c : frame.contacts) add(c);
    last_step_ = frame.step;
  }

  core::Verdict conclude() override {
    if (window_.frames > 0) close_window();
    const auto told = static_cast<double>(rows().size());
    if (last_step_ != kNoStep && has_statistics())
      tally_.check(told - static_cast<double>(windows_), {0.0, "rows", kStatistics},
                   Where::frame(last_step_, "statistics: too many rows"));
    return tally_.conclude("no frames", std::to_string(compared_) + " rows of statistics computed anew");
  }

 private:
  [[nodiscard]] const std::vector<PenetrationStatistics>& rows() const {
    static const std::vector<PenetrationStatistics> kNone;
    return subject_.statistics != nullptr ? *subject_.statistics : kNone;
  }
  // Traces that something else wrote may have none.
  [[nodiscard]] bool has_statistics() const { return !rows().empty() && has(header_, core::Group::kContacts); }

  void judge_level(std::uint64_t step) {
    if (last_step_ != kNoStep) return;
    const bool is_full = header_.level == core::RecordLevel::kFull;
    tally_.require(is_full ? header_.groups != 0 : header_.level == core::RecordLevel::kDigest && header_.groups == 0,
                   kLevel, Where::frame(step, "/provenance@level"));
  }

  // Only the last step may be no multiple, or in no window, so each step is judged when another one follows. Nor may a
  // step that was to be recorded lie before the first recorded one.
  void judge_every(std::uint64_t step) {
    const std::uint64_t every = std::max<std::uint32_t>(1, header_.every);
    const bool is_first = last_step_ == kNoStep;
    if (is_first) {
      tally_.require(header_.every > 0, kEvery, Where::frame(step, "/provenance@every"));
    } else {
      tally_.require(last_step_ % every == 0, kEvery, Where::frame(last_step_, "/provenance@every"));
      if (windows_of_steps_)
        tally_.require(is_in_windows(last_step_), kWindows, Where::frame(last_step_, "/provenance/notes"));
    }
    const std::uint64_t due = next_due(is_first ? 0 : last_step_, every);
    tally_.require(step <= due, kEvery, Where::frame(step, "/provenance@every"));
  }

  [[nodiscard]] bool is_in_windows(std::uint64_t step) const {
    return std::any_of(windows_of_steps_->begin(), windows_of_steps_->end(),
                       [step](const StepWindow& w) { return w.first <= step && step <= w.last; });
  }

  // The first step after this one that is to be recorded.
  [[nodiscard]] std::uint64_t next_due(std::uint64_t step, std::uint64_t every) const {
    const std::uint64_t multiple = (step / every + 1) * every;
    if (!windows_of_steps_) return multiple;
    std::uint64_t due = kNoStep;
    for (const StepWindow& w : *windows_of_steps_) {
      const std::uint64_t in_window = std::max(multiple, (w.first + every - 1) / every * every);
      if (in_window <= w.last) due = std::min(due, in_window);
    }
    return due;
  }

  void add(const core::Contact& c) {
    if (core::is_face(c.b)) {
      ++window_.on_faces;
      return;
    }
    const double depth = c.depth_m;
    window_.largest_m = window_.on_bodies == 0 ? depth : std::max(window_.largest_m, depth);
    ++window_.on_bodies;
    window_.sum_m += depth;
    if (c.depth_m > header_.scene.parameters.delta_m) ++window_.above_slop;
  }

  void close_window() {
    const Window w = window_;
    window_ = {};
    const std::size_t k = windows_++;
    if (!has_statistics()) return;
    if (k >= rows().size()) {
      tally_.require(subject_.is_cut_off, kStatistics, Where::frame(w.last_step, "statistics: a missing row"));
      return;
    }
    ++compared_;
    const PenetrationStatistics& row = rows()[k];
    const auto same = [&](std::uint64_t told, std::uint64_t counted, std::string_view field) {
      tally_.check(told == counted ? 0.0 : std::abs(static_cast<double>(told) - static_cast<double>(counted)),
                   {0.0, "", kStatistics}, Where::frame(w.last_step, field));
    };
    same(row.first_step, w.first_step, "statistics.first_step");
    same(row.last_step, w.last_step, "statistics.last_step");
    same(row.frames, w.frames, "statistics.frames");
    same(row.body_contacts, w.on_bodies, "statistics.body_contacts");
    same(row.face_contacts, w.on_faces, "statistics.face_contacts");
    judge_depths(row, w);
  }

  void judge_depths(const PenetrationStatistics& row, const Window& w) {
    const auto at = [&](std::string_view field) { return Where::frame(w.last_step, field); };
    if (w.on_bodies == 0) {
      tally_.require(
          std::isnan(row.mean_depth_m) && std::isnan(row.largest_depth_m) && std::isnan(row.share_above_slop),
          "METHOD 9: without contacts the depths are NaN", at("statistics.mean_depth"));
      return;
    }
    const auto count = static_cast<double>(w.on_bodies);
    const double mean = w.sum_m / count;
    const double share = static_cast<double>(w.above_slop) / count;
    tally_.check(
        std::abs(row.mean_depth_m - mean),
        {2.0 * (count + 1.0) * kDoubleRoundoff * std::abs(mean), "m", "a sum of n doubles and a quotient, twice"},
        at("statistics.mean_depth"));
    tally_.check(std::abs(row.largest_depth_m - w.largest_m), {0.0, "m", kStatistics}, at("statistics.largest_depth"));
    tally_.check(std::abs(row.share_above_slop - share),
                 {2.0 * kDoubleRoundoff * share, "", "a quotient of doubles, twice"},
                 at("statistics.share_above_slop"));
  }

  static constexpr std::uint64_t kNoStep = ~std::uint64_t{0};

  const Subject subject_;
  const core::TraceHeader& header_;
  std::optional<std::vector<StepWindow>> windows_of_steps_;
  Window window_;
  std::uint64_t last_step_ = kNoStep;
  std::uint64_t windows_ = 0;
  std::uint64_t compared_ = 0;
  Tally tally_{"recording", "statements about the frames", kStatistics};
};

std::string why_not_recording(const Subject& subject) {
  const core::TraceHeader& header = subject.header;
  if (header.groups == 0 && header.level == core::RecordLevel::kDigest) return "the trace records digests alone";
  return {};
}

}  // namespace

ValidatorRow recording_row() {
  return {"recording",
          "level, steps and penetration statistics are those of the recorded frames",
          "statistics of other contacts; a step left out",
          core::bit(core::Group::kContacts),
          0,
          why_not_recording,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Recording>(subject); }};
}

}  // namespace broadside::validation
