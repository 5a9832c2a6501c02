#include "core/trace/trace_writer.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "core/trace/column_buffer.hpp"
#include "core/trace/declaration_group.hpp"
#include "core/trace/finished_file.hpp"
#include "core/trace/part_file.hpp"
#include "core/trace/scene_group.hpp"
#include "core/trace/statistics.hpp"

namespace broadside::core {
namespace {

using Clock = std::chrono::steady_clock;

// Rows wait in memory up to this size and then go to HDF5's chunk cache, so that small frames do not each cost one HDF5
// call per dataset. 4 MiB is some 100 frames of 50 bodies.
constexpr std::size_t kWaitingBytes = 4U << 20U;
// A killed writer loses at most the frames of about one flush period. The period is shorter at the start, so that short
// runs leave something.
constexpr std::chrono::milliseconds kShortestFlushPeriod{100};
constexpr std::chrono::milliseconds kFlushPeriod{1000};

std::filesystem::path with_suffix(std::filesystem::path path, const char* suffix) {
  return path += suffix;
}

Error misuse(const std::filesystem::path& path, const std::string& what, const std::string& advice) {
  return {what, path.string(), advice, Exit::kInternal};
}

Status check_header(const std::filesystem::path& path, const TraceHeader& header) {
  if (Status s = check_scene(header.scene); !s) return s;
  if (header.stamp.scene_digest != scene_digest(header.scene))
    return misuse(path, "the stamp's scene_digest is not the digest of the scene", "stamp the scene that is recorded");
  const auto has = [&header](Group g) { return (header.groups & bit(g)) != 0U; };
  if ((has(Group::kWideBodies) && !has(Group::kBodies)) ||
      (has(Group::kDetectedOrientation) && !has(Group::kDetection)))
    return misuse(path, "a group is recorded without the one that it extends",
                  "give float64 states with the group of states");
  if (header.every == 0) return misuse(path, "every is 0", "record every 1st frame or fewer");
  for (const auto& [name, value] : header.notes)
    if (name.empty()) return misuse(path, "a note has no name", "name every note");
  return Done{};
}

void write_once(Hdf5Sink& sink, const TraceHeader& header) {
  sink.text("/", "format", "broadside-trace");
  sink.number("/", "format_version", Element::kU32, &kTraceFormatVersion);
  write_scene(sink, header.scene);
  write_provenance(sink, header);
  write_declaration(sink, header.declaration);
  sink.group("/trace");
  for (const GroupRow& row : group_rows())
    if ((header.groups & bit(row.group)) != 0U && !row.is_dataset) sink.group(std::string(row.path));
  if ((header.groups & bit(Group::kContacts)) != 0U) sink.group("/trace/statistics");
}

}  // namespace

struct TraceWriter::Impl {
  std::filesystem::path path;
  std::uint64_t bodies = 0;
  std::uint32_t groups = 0;
  PenetrationCounter counter{0.0F};
  std::unique_ptr<PartFile> part;
  Handle file;
  std::vector<ColumnBuffer> columns;
  Packing packing = Packing::kSmall;
  std::optional<std::uint64_t> last_step;
  std::uint64_t frames = 0;
  std::uint64_t frames_flushed = 0;
  Clock::time_point start = Clock::now();
  Clock::time_point last_flush = start;
  std::optional<Error> failed;
  bool finished = false;

  ~Impl() {
    const QuietHdf5 quiet;
    if (part && !failed && !finished) static_cast<void>(flush());  // a destructor cannot report an error
    columns.clear();
    if (file.close() && part) static_cast<void>(part->commit());
  }

  Error stop(Error error) {
    failed = error;
    return error;
  }

  // The error for a refusal of HDF5 or the disk, with what can still be saved.
  Error stop_writing(const std::string& doing) {
    Error error = part->refused() != 0 ? disk_error(part->refused(), part->path(), doing)
                                       : hdf5_error(doing + " failed", part->path().string(), "choose another folder");
    if (frames_flushed > 0)
      error.advice += "; its first " + std::to_string(frames_flushed) + " frames: broadside recover " +
                      part->path().filename().string();
    return stop(std::move(error));
  }

  // Passes rows to HDF5. Steps wait for flush(): a step in the file means that the rest of its frame is there.
  bool write_columns() {
    for (ColumnBuffer& c : columns)
      if (c.column().records != Records::kStep && !c.write(packing)) return false;
    return part->refused() == 0;
  }

  bool write_steps() {
    for (ColumnBuffer& c : columns)
      if (c.column().records == Records::kStep)
        return c.write(Packing::kSmall) && H5Dflush(c.set().get()) >= 0 && part->refused() == 0;
    return false;
  }

  [[nodiscard]] bool is_flush_due() const {
    const Clock::time_point now = Clock::now();
    return now - last_flush >= std::clamp<Clock::duration>((now - start) / 2, kShortestFlushPeriod, kFlushPeriod);
  }

  Status flush() {
    const bool good = write_columns() && H5Fflush(file.get(), H5F_SCOPE_LOCAL) >= 0 && write_steps() && part->commit();
    if (!good) return stop_writing("writing frame " + std::to_string(frames));
    frames_flushed = frames;
    last_flush = Clock::now();
    return Done{};
  }

  Status check_counts(const FrameRecord& frame) const {
    for (const ColumnBuffer& c : columns) {
      if (c.column().layout != Layout::kFrameBodies) continue;
      const std::size_t count = records_of(frame, c.column().records).count;
      if (count != bodies)
        return misuse(path,
                      "step " + std::to_string(frame.step) + " has " + std::to_string(count) + " rows of " +
                          std::string(c.column().path) + " for " + std::to_string(bodies) + " bodies",
                      "fill every group that the header names");
    }
    if ((groups & bit(Group::kConfirmed)) != 0U && !frame.proximity.empty() &&
        frame.proximity.size() != frame.confirmed.size())
      return misuse(path, "step " + std::to_string(frame.step) + " has not one proximity per confirmed pair",
                    "give all of them or none");
    if ((groups & bit(Group::kNarrow)) != 0U && frame.separations.size() != frame.measured.size())
      return misuse(path, "step " + std::to_string(frame.step) + " has not one separation per measured pair",
                    "give all of them");
    return Done{};
  }

  void add_statistics(const std::optional<PenetrationStatistics>& row) {
    if (!row) return;
    for (ColumnBuffer& c : columns)
      if (c.column().layout == Layout::kWindows) c.add({reinterpret_cast<const std::byte*>(&*row), 1, sizeof *row});
  }

  Status append(const FrameRecord& frame) {
    if (failed) return *failed;
    if (finished) return misuse(path, "a frame was appended after the end", "append before finish()");
    if (last_step && frame.step <= *last_step)
      return stop(misuse(path, "step " + std::to_string(frame.step) + " follows step " + std::to_string(*last_step),
                         "append frames in rising order"));
    if (const Status s = check_counts(frame); !s) return stop(s.error());
    if ((groups & bit(Group::kContacts)) != 0U) add_statistics(counter.add(frame.step, frame.contacts));
    std::size_t waiting = 0;
    for (ColumnBuffer& c : columns) {
      if (c.column().layout != Layout::kWindows) c.add(records_of(frame, c.column().records));
      waiting += c.waiting_bytes();
    }
    last_step = frame.step;
    ++frames;
    if (is_flush_due()) return flush();
    if (waiting >= kWaitingBytes && !write_columns()) return stop_writing("writing frame " + std::to_string(frames));
    return Done{};
  }

  std::uint64_t stored_bytes() const {
    std::uint64_t sum = 0;
    for (const ColumnBuffer& c : columns) sum += H5Dget_storage_size(c.set().get());
    return sum;
  }

  Status finish() {
    if (failed) return *failed;
    if (finished) return misuse(path, "finish() was called twice", "call it once");
    if ((groups & bit(Group::kContacts)) != 0U) add_statistics(counter.rest());
    if (Status s = flush(); !s) return s;
    const std::uint64_t stored = stored_bytes();
    columns.clear();
    if (!file.close() || !part->commit()) return stop_writing("closing the trace");
    std::unique_ptr<PartFile> copy;
    if (is_worth_compacting(*part, stored)) copy = compacted(*part, path);
    PartFile& complete = copy ? *copy : *part;
    if ((groups & bit(Group::kDetection)) != 0U) add_views(complete, frames, bodies);
    if (const int code = complete.sync(); code != 0)
      return stop(disk_error(code, complete.path(), "syncing the trace"));
    if (const Status s = rename_durably(complete.path(), path); !s) return stop(s.error());
    finished = true;
    std::error_code ignored;
    if (copy) std::filesystem::remove(part->path(), ignored);
    return Done{};
  }
};

TraceWriter::TraceWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TraceWriter::TraceWriter(TraceWriter&&) noexcept = default;
TraceWriter& TraceWriter::operator=(TraceWriter&&) noexcept = default;
TraceWriter::~TraceWriter() = default;

Result<TraceWriter> TraceWriter::create(const std::filesystem::path& path, const TraceHeader& header) {
  const QuietHdf5 quiet;
  if (const Status s = check_header(path, header); !s) return s.error();
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) return disk_error(EISDIR, path, "creating the trace");
  auto part = PartFile::create(with_suffix(path, ".part"));
  if (!part) return part.error();

  auto impl = std::make_unique<Impl>();
  impl->path = path;
  impl->bodies = header.scene.bodies.size();
  impl->groups = header.groups;
  impl->counter = PenetrationCounter(header.scene.parameters.delta_m);
  impl->part = std::move(part).value();
  impl->file = create_hdf5(*impl->part);
  bool good = static_cast<bool>(impl->file);
  if (good) {
    Hdf5Sink sink(impl->file.get());
    write_once(sink, header);
    for (const Column& c : columns()) {
      if (c.groups != 0 && (c.groups & header.groups) == 0) continue;
      if (c.groups == bit(Group::kBodies) && (header.groups & bit(Group::kWideBodies)) != 0U) continue;
      impl->columns.emplace_back(c, impl->bodies, sink.growing(c, impl->bodies));
    }
    // From here on, a kill at any moment leaves a file that can be opened.
    good = sink.ok() && H5Fflush(impl->file.get(), H5F_SCOPE_LOCAL) >= 0 &&
           H5Fstart_swmr_write(impl->file.get()) >= 0 && impl->part->commit();
  }
  if (!good) {
    const Error error = impl->stop_writing("creating the trace");
    std::filesystem::remove(impl->part->path(), code);
    return error;
  }
  return TraceWriter(std::move(impl));
}

void TraceWriter::hurry(bool is_late) {
  impl_->packing = is_late ? Packing::kFast : Packing::kSmall;
}

Status TraceWriter::flush_if_due() {
  const Impl& d = *impl_;
  if (d.finished || d.frames == d.frames_flushed || !d.is_flush_due()) return Done{};
  return flush();
}

Status TraceWriter::append(const FrameRecord& frame) {
  const QuietHdf5 quiet;
  return impl_->append(frame);
}

Status TraceWriter::flush() {
  const QuietHdf5 quiet;
  if (impl_->failed) return *impl_->failed;
  if (impl_->finished) return Done{};
  return impl_->flush();
}

Status TraceWriter::finish() {
  const QuietHdf5 quiet;
  return impl_->finish();
}

}  // namespace broadside::core
