#include "core/trace/trace_reader.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <new>
#include <string>
#include <utility>

#include "core/trace/columns.hpp"
#include "core/trace/hdf5_source.hpp"
#include "core/trace/scene_group.hpp"

namespace broadside::core {
namespace {

// Frames read ahead at once: as many as fit this, so that going through a trace in order costs one HDF5 call per
// dataset and some 100 frames of 50 bodies.
constexpr std::uint64_t kBlockBytes = 4U << 20U;

constexpr std::uint64_t kMissingStep = std::numeric_limits<std::uint64_t>::max();

struct OpenColumn {
  const Column* column;
  OpenArray array;
  std::vector<std::byte> block;  // rows of the frames that its group read ahead
};

struct OpenGroup {
  Group group;
  std::vector<OpenColumn> columns;
  std::uint64_t first = 0;  // frames first .. last - 1 are in the blocks
  std::uint64_t last = 0;
};

std::vector<std::uint64_t> inner_dimensions(const Column& c, std::uint64_t bodies) {
  if (c.layout == Layout::kFrameBodies) return {bodies, c.width};
  return c.width == 1 ? std::vector<std::uint64_t>{} : std::vector<std::uint64_t>{c.width};
}

}  // namespace

struct TraceReader::Impl {
  Hdf5Source source;
  TraceHeader header;
  std::vector<std::uint64_t> steps;
  std::vector<double> times;
  std::vector<std::uint64_t> digests;
  std::vector<OpenGroup> groups;
  std::map<Records, std::vector<std::uint64_t>> offsets;
  std::uint64_t frames_started = 0;

  explicit Impl(Hdf5Source s) : source(std::move(s)) {}

  [[nodiscard]] std::uint64_t frame_count() const { return steps.size(); }

  void check_format() {
    if (!source.has_attribute("/", "format") || source.text("/", "format") != "broadside-trace")
      return source.fail("/@format", "it is an HDF5 file but no Broadside trace",
                         "give a trace file as broadside run --record writes it");
    const auto version = source.number<std::uint32_t>("/", "format_version");
    if (source.ok() && version != kTraceFormatVersion)
      source.fail("/@format_version",
                  "it is of trace format " + std::to_string(version) + ", this program reads format " +
                      std::to_string(kTraceFormatVersion),
                  version > kTraceFormatVersion ? "use a newer Broadside"
                                                : "record it again, or use the Broadside of its time");
  }

  void open_columns() {
    const std::uint64_t bodies = header.scene.bodies.size();
    for (const GroupRow& row : group_rows()) {
      if (!source.has(std::string(row.path))) continue;
      header.groups |= bit(row.group);
      OpenGroup group{row.group, {}, 0, 0};
      for (const Column& c : columns())
        if (c.groups == bit(row.group) && c.layout != Layout::kWindows && c.layout != Layout::kOffsets)
          group.columns.push_back({&c, source.array(std::string(c.path), c.element, inner_dimensions(c, bodies)), {}});
      groups.push_back(std::move(group));
    }
    for (const Column& c : columns())
      if (c.layout == Layout::kOffsets && (c.groups & header.groups) != 0U)
        offsets[c.records] = source.whole<std::uint64_t>(std::string(c.path), c.element, 1);
    steps = source.whole<std::uint64_t>("/trace/step", Element::kU64, 1);
    times = source.whole<double>("/trace/time", Element::kF64, 1);
    digests = source.whole<std::uint64_t>("/trace/digest", Element::kU64, 1);
  }

  // Rows that dataset c has for frames 0 .. frames - 1.
  [[nodiscard]] std::uint64_t rows_before(const Column& c, std::uint64_t frame) const {
    return c.layout == Layout::kRows ? offsets.at(offsets_of(c.records))[frame] : frame;
  }

  // A writer that was killed may have left some datasets longer than others. The trace ends where the shortest does.
  void keep_complete_frames() {
    std::uint64_t count = std::find(steps.begin(), steps.end(), kMissingStep) - steps.begin();
    frames_started =
        std::max({count, static_cast<std::uint64_t>(times.size()), static_cast<std::uint64_t>(digests.size())});
    count = std::min({count, static_cast<std::uint64_t>(times.size()), static_cast<std::uint64_t>(digests.size())});
    for (auto& [records, list] : offsets) {
      frames_started = std::max(frames_started, list.empty() ? 0 : static_cast<std::uint64_t>(list.size()) - 1);
      count = std::min(count, list.empty() ? 0 : static_cast<std::uint64_t>(list.size()) - 1);
    }
    for (const OpenGroup& g : groups)
      for (const OpenColumn& c : g.columns) {
        if (c.column->layout != Layout::kRows) {
          frames_started = std::max(frames_started, c.array.rows);
          count = std::min(count, c.array.rows);
          continue;
        }
        while (count > 0 && rows_before(*c.column, count) > c.array.rows) --count;
      }
    steps.resize(count);
    times.resize(count);
    digests.resize(count);
    for (auto& [records, list] : offsets) list.resize(std::min<std::size_t>(list.size(), count + 1));
  }

  void check_order() {
    if (std::adjacent_find(steps.begin(), steps.end(), std::greater_equal<>()) != steps.end())
      source.fail("/trace/step", "steps do not rise", "give the frames in order, each once");
    for (const Column& c : columns()) {
      if (c.layout != Layout::kOffsets || !offsets.contains(c.records)) continue;
      const std::vector<std::uint64_t>& list = offsets.at(c.records);
      if (!list.empty() && (list.front() != 0 || !std::is_sorted(list.begin(), list.end())))
        source.fail(std::string(c.path), "offsets do not start with 0 or they fall",
                    "give running sums of the row counts");
    }
    for (std::uint64_t k = 0; offsets.contains(Records::kProximity) && k < frame_count(); ++k) {
      const std::uint64_t given = offsets[Records::kProximity][k + 1] - offsets[Records::kProximity][k];
      const std::uint64_t wanted = offsets[Records::kConfirmed][k + 1] - offsets[Records::kConfirmed][k];
      if (given != 0 && given != wanted)
        source.fail("/trace/confirmed/proximity_offsets",
                    "frame " + std::to_string(k) + " has " + std::to_string(given) + " proximities for " +
                        std::to_string(wanted) + " confirmed pairs",
                    "give one per pair or none");
    }
  }

  [[nodiscard]] std::uint64_t frame_bytes(const OpenGroup& g, std::uint64_t frame) const {
    std::uint64_t sum = 0;
    for (const OpenColumn& c : g.columns)
      sum += (rows_before(*c.column, frame + 1) - rows_before(*c.column, frame)) * c.array.row_bytes;
    return sum;
  }

  bool read_ahead(OpenGroup& g, std::uint64_t frame) {
    if (frame >= g.first && frame < g.last) return true;
    std::uint64_t end = frame + 1;
    for (std::uint64_t bytes = frame_bytes(g, frame); end < frame_count(); ++end) {
      bytes += frame_bytes(g, end);
      if (bytes > kBlockBytes) break;
    }
    g.first = g.last = 0;
    for (OpenColumn& c : g.columns) {
      const std::uint64_t first = rows_before(*c.column, frame);
      if (!source.read(c.array, std::string(c.column->path), first, rows_before(*c.column, end) - first, c.block))
        return false;
    }
    g.first = frame;
    g.last = end;
    return true;
  }

  // Spreads one column of one frame over its records.
  void take(const OpenGroup& g, const OpenColumn& c, std::uint64_t frame, FrameRecord& record) const {
    const std::uint64_t first = rows_before(*c.column, frame);
    const std::uint64_t rows = rows_before(*c.column, frame + 1) - first;
    const std::size_t bytes = row_bytes(*c.column);
    const std::uint64_t count = rows * c.array.row_bytes / bytes;
    const RecordSpan<std::byte> records = resized_records(record, c.column->records, count);
    const std::byte* from = c.block.data() + (first - rows_before(*c.column, g.first)) * c.array.row_bytes;
    if (count == 0) return;
    if (records.stride == bytes) {
      std::memcpy(records.data, from, count * bytes);
      return;
    }
    std::byte* to = records.data + c.column->offset;
    for (std::uint64_t i = 0; i < count; ++i, from += bytes, to += records.stride) std::memcpy(to, from, bytes);
  }

  // bool has two values, and reading a third is undefined: whatever is not 0 becomes 1 before anyone looks.
  static void normalize_flags(OpenGroup& g) {
    for (OpenColumn& c : g.columns)
      if (c.column->element == Element::kU8)
        for (std::byte& b : c.block) b = b == std::byte{0} ? std::byte{0} : std::byte{1};
  }

  void check_indices(const FrameRecord& record) {
    const std::uint32_t n = header.scene.body_count();
    const auto fail = [&](const char* path) {
      source.fail(path, "step " + std::to_string(record.step) + " names a body that the scene does not have",
                  "body ids are 0 to " + std::to_string(n) + " - 1");
    };
    const auto is_bad = [n](Pair p) { return p.i >= n || p.j >= n; };
    if (std::any_of(record.pairs.begin(), record.pairs.end(), is_bad)) return fail("/trace/pairs/pairs");
    if (std::any_of(record.confirmed.begin(), record.confirmed.end(), is_bad)) return fail("/trace/confirmed/pairs");
    if (std::any_of(record.measured.begin(), record.measured.end(), is_bad)) return fail("/trace/narrow/pairs");
    for (const Contact& c : record.contacts) {
      if (c.a >= n) return fail("/trace/contact/a");
      if (c.b >= n && !(is_face(c.b) && c.b - kFirstFace < kFaceCount)) return fail("/trace/contact/b");
    }
    for (std::size_t i = 0; i < record.proximity.size(); ++i) {
      const Proximity& p = record.proximity[i];
      if (!p.is_touching()) continue;
      const auto vertices = [&](std::uint32_t body) {
        return header.scene.meshes[header.scene.bodies[body].mesh]->vertices.size();
      };
      if (p.vertex_a >= vertices(record.confirmed[i].i) || p.vertex_b >= vertices(record.confirmed[i].j))
        return source.fail("/trace/confirmed/vertex_a",
                           "step " + std::to_string(record.step) + " names a vertex that its mesh does not have",
                           "vertex ids count from 0 in each body's mesh");
    }
  }

  Result<FrameRecord> read(std::uint64_t index, std::uint32_t wanted) {
    if (!source.ok()) return source.error();
    if (index >= frame_count())
      return Error{"there is no frame " + std::to_string(index), source.path().string(),
                   "it has " + std::to_string(frame_count()) + " frames", Exit::kInternal};
    FrameRecord record;
    record.step = steps[index];
    record.time_s = times[index];
    record.digest = digests[index];
    try {
      for (OpenGroup& g : groups) {
        if ((bit(g.group) & wanted) == 0U) continue;
        const bool is_new = index < g.first || index >= g.last;
        if (!read_ahead(g, index)) return source.error();
        if (is_new) normalize_flags(g);
        for (const OpenColumn& c : g.columns) take(g, c, index, record);
      }
    } catch (const std::bad_alloc&) {
      source.fail("step " + std::to_string(record.step), "it needs more memory than there is", "use a larger machine");
      return source.error();
    }
    check_indices(record);
    if (!source.ok()) return source.error();
    return record;
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
  impl->check_format();
  if (impl->source.ok()) impl->header.scene = read_scene(impl->source);
  if (impl->source.ok()) read_provenance(impl->source, impl->header);
  if (impl->source.ok()) impl->open_columns();
  if (impl->source.ok()) impl->keep_complete_frames();
  if (impl->source.ok()) impl->check_order();
  if (!impl->source.ok()) return impl->source.error();
  return TraceReader(std::move(impl));
}

const TraceHeader& TraceReader::header() const {
  return impl_->header;
}
const std::filesystem::path& TraceReader::path() const {
  return impl_->source.path();
}
std::uint64_t TraceReader::frame_count() const {
  return impl_->frame_count();
}
const std::vector<std::uint64_t>& TraceReader::steps() const {
  return impl_->steps;
}
const std::vector<std::uint64_t>& TraceReader::digests() const {
  return impl_->digests;
}

Result<FrameRecord> TraceReader::read(std::uint64_t index, std::uint32_t groups) const {
  const QuietHdf5 quiet;
  return impl_->read(index, groups);
}

}  // namespace broadside::core
