#include "core/trace/box_file.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "core/trace/hdf5_sink.hpp"
#include "core/trace/hdf5_source.hpp"
#include "core/trace/part_file.hpp"
#include "core/trace/trace_reader.hpp"

namespace broadside::core {
namespace {

constexpr const char* kBoxes = "/boxes";
static_assert(sizeof(Box) == 6 * sizeof(float));

// [frames, n, 6] in chunks of at most one frame; compressed like every array of a trace.
Handle create_boxes(hid_t file, std::uint64_t frames, std::uint64_t count) {
  const std::array<hsize_t, 3> dims{frames, count, 6};
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  if (count > 0) {
    const std::array<hsize_t, 3> chunk{1, std::min<hsize_t>(count, 8 * kChunkBytes / sizeof(Box)), 6};
    H5Pset_chunk(properties.get(), 3, chunk.data());
    H5Pset_shuffle(properties.get());
    H5Pset_deflate(properties.get(), 1);
  }
  const Handle space(H5Screate_simple(3, dims.data(), nullptr), H5Sclose);
  return {H5Dcreate2(file, kBoxes, hdf5_type(Element::kF32), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
          H5Dclose};
}

bool write_frame(hid_t set, std::uint64_t frame, const std::vector<Box>& boxes) {
  if (boxes.empty()) return true;
  const std::array<hsize_t, 3> start{frame, 0, 0};
  const std::array<hsize_t, 3> size{1, boxes.size(), 6};
  const Handle there(H5Dget_space(set), H5Sclose);
  const Handle here(H5Screate_simple(3, size.data(), nullptr), H5Sclose);
  return H5Sselect_hyperslab(there.get(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr) >= 0 &&
         H5Dwrite(set, hdf5_type(Element::kF32), here.get(), there.get(), H5P_DEFAULT, boxes.data()) >= 0;
}

Status write_frames(PartFile& part, std::uint64_t frames, const NextBoxes& next) {
  const auto refused = [&part] {
    const std::string why = part.refused() == 0 ? "" : ": " + std::system_category().message(part.refused());
    return Error{"it cannot be written" + why, part.path().string(), "check the folder and the free space"};
  };
  const Handle properties = part.access_properties();
  Handle file(H5Fcreate(part.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, properties.get()), H5Fclose);
  if (!file) return refused();
  Handle set;
  std::uint64_t count = 0;
  for (std::uint64_t k = 0; k < frames; ++k) {
    const Result<std::vector<Box>> boxes = next();
    if (!boxes) return boxes.error();
    if (k == 0) {
      count = boxes.value().size();
      set = create_boxes(file.get(), frames, count);
      Hdf5Sink(file.get()).text(kBoxes, "unit", "m");
    }
    if (boxes.value().size() != count)
      return Error{"frame " + std::to_string(k) + " has " + std::to_string(boxes.value().size()) + " boxes, not " +
                       std::to_string(count),
                   part.path().string(), "give every frame the same number of boxes"};
    if (!set || !write_frame(set.get(), k, boxes.value()) || part.refused() != 0) return refused();
  }
  if (!set.close() || !file.close() || part.refused() != 0 || part.sync() != 0) return refused();
  return Done{};
}

}  // namespace

struct BoxFile::Impl {
  // Exactly one of the next two is open.
  std::optional<Hdf5Source> source;
  std::optional<TraceReader> trace;
  OpenArray boxes;
  bool has_frames = true;  // false: [n, 6]
};

BoxFile::BoxFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
BoxFile::BoxFile(BoxFile&&) noexcept = default;
BoxFile& BoxFile::operator=(BoxFile&&) noexcept = default;
BoxFile::~BoxFile() = default;

Result<BoxFile> BoxFile::open(const std::filesystem::path& path) {
  const QuietHdf5 quiet;
  auto impl = std::make_unique<Impl>();
  Result<Hdf5Source> source = Hdf5Source::open(path);
  if (!source) return source.error();
  if (source.value().has(kBoxes)) {
    impl->source = std::move(source).value();
    const std::vector<std::uint64_t> shape = impl->source->shape(kBoxes);
    impl->has_frames = shape.size() != 2;
    impl->boxes = impl->source->array(
        kBoxes, Element::kF32,
        shape.size() == 3 ? std::vector<std::uint64_t>{shape[1], 6} : std::vector<std::uint64_t>{6});
    if (!impl->source->ok()) return impl->source->error();
  } else {
    Result<TraceReader> trace = TraceReader::open(path);
    if (!trace)
      return Error{
          "it has neither boxes nor a trace", path.string(),
          "give a file with the dataset /boxes, [frames, n, 6] or [n, 6] f32, or a trace with detection boxes"};
    if ((trace.value().header().groups & bit(Group::kDetection)) == 0)
      return Error{"this trace holds no detection boxes", path.string(), "record it with --record full"};
    impl->trace = std::move(trace).value();
  }
  BoxFile file(std::move(impl));
  if (file.frames() == 0) return Error{"it has no frame", path.string(), "record at least one"};
  return file;
}

std::uint64_t BoxFile::frames() const {
  if (impl_->trace) return impl_->trace->frame_count();
  return impl_->has_frames ? impl_->boxes.rows : 1;
}

Result<std::vector<Box>> BoxFile::read(std::uint64_t frame) {
  const QuietHdf5 quiet;
  if (impl_->trace) {
    Result<FrameRecord> record = impl_->trace->read(frame, bit(Group::kDetection));
    if (!record) return record.error();
    return std::move(record).value().boxes;
  }
  std::vector<std::byte> bytes;
  Hdf5Source& source = *impl_->source;
  const std::uint64_t first = impl_->has_frames ? frame : 0;
  const std::uint64_t rows = impl_->has_frames ? 1 : impl_->boxes.rows;
  if (!source.read(impl_->boxes, kBoxes, first, rows, bytes)) return source.error();
  std::vector<Box> boxes(bytes.size() / sizeof(Box));
  if (!boxes.empty()) std::memcpy(boxes.data(), bytes.data(), bytes.size());
  return boxes;
}

Status write_box_file(const std::filesystem::path& path, std::uint64_t frames, const NextBoxes& next) {
  const QuietHdf5 quiet;
  const std::filesystem::path part_path = path.string() + ".part";
  std::error_code failed;
  {
    Result<std::unique_ptr<PartFile>> part = PartFile::create(part_path);
    if (!part) return part.error();
    if (Status s = write_frames(*part.value(), frames, next); !s) {
      std::filesystem::remove(part_path, failed);
      return s;
    }
  }
  std::filesystem::rename(part_path, path, failed);
  if (failed) return Error{"it cannot be written: " + failed.message(), path.string(), "check the folder"};
  return Done{};
}

}  // namespace broadside::core
