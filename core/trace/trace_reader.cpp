#include "core/trace/trace_reader.hpp"

#include <algorithm>
#include <cstring>
#include <new>
#include <string>
#include <utility>

#include "core/trace/columns.hpp"
#include "core/trace/declaration_group.hpp"
#include "core/trace/format1.hpp"
#include "core/trace/frame_index.hpp"
#include "core/trace/group_block.hpp"
#include "core/trace/hdf5_source.hpp"
#include "core/trace/refuse_frame.hpp"
#include "core/trace/scene_group.hpp"

namespace broadside::core {
namespace {

// The file's format version, 1 or 2; any other is reported to source.
std::uint32_t read_format(Hdf5Source& source) {
  if (!source.has_attribute("/", "format") || source.text("/", "format") != "broadside-trace") {
    source.fail("/@format", "it is an HDF5 file but not a Broadside trace",
                "give a trace file as broadside run --record writes it");
    return 0;
  }
  const auto version = source.number<std::uint32_t>("/", "format_version");
  if (source.ok() && (version == 0 || version > kTraceFormatVersion))
    source.fail("/@format_version",
                "it is of trace format " + std::to_string(version) + ", and this program reads formats 1 to " +
                    std::to_string(kTraceFormatVersion),
                "use a newer Broadside");
  return version;
}

// The element type of this dataset says whether the states are float32 or float64.
constexpr const char* kBodyPosition = "/trace/body/position";

// Fills kBodies with the rounded numbers of kWideBodies.
void narrow_states(FrameRecord& record) {
  const auto narrow = [](const auto& from, auto& to) {
    to.clear();
    for (const auto& value : from) to.push_back(narrowed(value));
  };
  narrow(record.wide.position, record.position);
  narrow(record.wide.orientation, record.orientation);
  narrow(record.wide.velocity, record.velocity);
  narrow(record.wide.angular_velocity, record.angular_velocity);
}

}  // namespace

struct TraceReader::Impl {
  Hdf5Source source;
  TraceHeader header;
  FrameIndex index;
  std::vector<GroupBlock> groups;

  explicit Impl(Hdf5Source s) : source(std::move(s)) {}
  ~Impl() {
    const QuietHdf5 quiet;
    groups.clear();
    source.close();
  }

  void open() {
    const std::uint32_t version = read_format(source);
    if (source.ok()) header.scene = read_scene(source);
    if (source.ok()) read_provenance(source, header);
    if (source.ok())
      header.declaration = version == 1 ? declaration_of_format1(header.stamp.engine) : read_declaration(source);
    if (source.ok()) check_stamp();
    for (const GroupRow& row : group_rows()) {
      if (!source.ok() || !source.has(std::string(row.path))) continue;
      header.groups |= bit(row.group);
      const bool is_wide = row.group == Group::kBodies && source.has_elements(kBodyPosition, Element::kF64);
      if (is_wide) header.groups |= bit(Group::kWideBodies);
      groups.emplace_back(is_wide ? Group::kWideBodies : row.group, header.scene.bodies.size(), source);
    }
    if (source.ok()) index = read_index(source, header.groups);
    if (source.ok()) keep_frames();
    if (source.ok()) check_order(index, source);
  }

  void check_stamp() {
    const std::uint64_t digest = scene_digest(header.scene);
    if (!source.has_attribute("/provenance", "scene_digest")) header.stamp.scene_digest = digest;
    if (header.stamp.scene_name.empty()) header.stamp.scene_name = header.scene.name;
    if (header.stamp.scene_digest != digest)
      source.fail("/provenance@scene_digest", "the stamp is of another scene than the one in this file",
                  "record it again");
  }

  void keep_frames() {
    keep_complete(index);
    for (const GroupBlock& g : groups) g.keep_reached(index);
    // A trace under its final name is complete: a missing frame is an error. Only a part file may end in the middle.
    if (index.frame_count() != index.frames_begun && !source.was_left_open() && source.path().extension() != ".part")
      source.fail("/trace",
                  "its datasets end at different frames, " + std::to_string(index.frame_count()) + " to " +
                      std::to_string(index.frames_begun),
                  "record it again");
  }

  Result<FrameRecord> read(std::uint64_t frame, std::uint32_t wanted) {
    if (!source.ok()) return source.error();
    if (frame >= index.frame_count())
      return Error{"there is no frame " + std::to_string(frame), source.path().string(),
                   "it has " + std::to_string(index.frame_count()) + " frames", Exit::kInternal};
    FrameRecord record;
    record.step = index.steps[frame];
    record.time_s = index.times[frame];
    record.digest = index.digests[frame];
    // States are read in the precision that the file has.
    if ((wanted & (bit(Group::kBodies) | bit(Group::kWideBodies))) != 0U)
      wanted |= bit(Group::kBodies) | bit(Group::kWideBodies);
    for (GroupBlock& g : groups)
      if ((bit(g.group()) & wanted) != 0U && !g.read(index, frame, source, record)) return source.error();
    if ((header.groups & wanted & bit(Group::kWideBodies)) != 0U) narrow_states(record);
    if (const auto fault = fault_of(record, header.scene)) source.fail(fault->at, fault->what, fault->advice);
    if (!source.ok()) return source.error();
    return record;
  }

  Result<std::vector<PenetrationStatistics>> statistics() {
    if (!source.ok()) return source.error();
    std::vector<PenetrationStatistics> rows;
    if (!source.has("/trace/statistics")) return rows;
    bool is_first = true;
    for (const Column& c : columns()) {
      if (c.layout != Layout::kWindows) continue;
      const auto column = source.whole<std::byte>(std::string(c.path), c.element, c.width);
      if (!source.ok()) return source.error();
      // The file of an interrupted writer may have rows past its last frame, and columns of unequal length.
      const std::size_t count = column.size() / row_bytes(c);
      rows.resize(is_first ? count : std::min(count, rows.size()));
      is_first = false;
      for (std::size_t i = 0; i < rows.size(); ++i)
        std::memcpy(reinterpret_cast<std::byte*>(&rows[i]) + c.offset, &column[i * row_bytes(c)], row_bytes(c));
    }
    const std::uint64_t last = index.steps.empty() ? 0 : index.steps.back();
    std::erase_if(rows, [last](const PenetrationStatistics& r) { return r.frames == 0 || r.last_step > last; });
    return rows;
  }

  // When a file needs more memory than there is, the exception from work() is reported as a fault of the file.
  template <typename Work>
  auto guarded(Work work) -> decltype(work()) {
    const QuietHdf5 quiet;
    try {
      return work();
    } catch (const std::bad_alloc&) {
      source.fail("/", "it needs more memory than this machine has", "use a larger machine");
      return source.error();
    }
  }
};

TraceReader::TraceReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TraceReader::TraceReader(TraceReader&&) noexcept = default;
TraceReader& TraceReader::operator=(TraceReader&&) noexcept = default;
TraceReader::~TraceReader() = default;

Result<TraceReader> TraceReader::open(const std::filesystem::path& path) {
  const QuietHdf5 quiet;
  Result<Hdf5Source> source = Hdf5Source::open(path);
  if (!source) return source.error();
  auto impl = std::make_unique<Impl>(std::move(source).value());
  const Status opened = impl->guarded([&impl]() -> Status {
    impl->open();
    if (!impl->source.ok()) return impl->source.error();
    return Done{};
  });
  if (!opened) return opened.error();
  return TraceReader(std::move(impl));
}

const TraceHeader& TraceReader::header() const {
  return impl_->header;
}
const std::filesystem::path& TraceReader::path() const {
  return impl_->source.path();
}
std::uint64_t TraceReader::frame_count() const {
  return impl_->index.frame_count();
}
std::uint64_t TraceReader::frames_begun() const {
  return impl_->index.frames_begun;
}
const std::vector<std::uint64_t>& TraceReader::steps() const {
  return impl_->index.steps;
}
const std::vector<std::uint64_t>& TraceReader::digests() const {
  return impl_->index.digests;
}

Result<FrameRecord> TraceReader::read(std::uint64_t index, std::uint32_t groups) const {
  return impl_->guarded([&] { return impl_->read(index, groups); });
}

Result<std::vector<PenetrationStatistics>> TraceReader::statistics() const {
  return impl_->guarded([&] { return impl_->statistics(); });
}

}  // namespace broadside::core
