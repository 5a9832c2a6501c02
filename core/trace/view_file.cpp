#include "core/trace/view_file.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "core/trace/finished_file.hpp"
#include "core/trace/hdf5_source.hpp"
#include "core/trace/view_geometry.hpp"
#include "core/trace/xdmf.hpp"
#include "core/whole_file.hpp"

namespace broadside::core {
namespace {

constexpr std::array<std::uint64_t, 1> kThree{3};

Status check_detection(const TraceReader& trace) {
  if ((trace.header().groups & bit(Group::kDetection)) == 0U)
    return Error{"it has no boxes and positions at detection to draw", trace.path().string(),
                 "record it with --record full"};
  return Done{};
}

std::vector<std::uint64_t> chosen_frames(const TraceReader& trace, const ViewRequest& request) {
  std::vector<std::uint64_t> frames;
  std::uint64_t seen = 0;
  for (std::uint64_t k = 0; k < trace.frame_count(); ++k) {
    const std::uint64_t step = trace.steps()[k];
    if (step < request.first_step || step > request.last_step) continue;
    if (seen++ % request.every == 0) frames.push_back(k);
  }
  return frames;
}

// The times are read with the frames, without reading any group.
Result<std::vector<XdmfFrame>> times_of(const TraceReader& trace, const std::vector<std::uint64_t>& frames) {
  std::vector<XdmfFrame> times;
  for (const std::uint64_t k : frames) {
    const auto frame = trace.read(k, 0);
    if (!frame) return frame.error();
    times.push_back({frame.value().step, frame.value().time_s});
  }
  return times;
}

Status write_frames(Hdf5Sink& sink, const TraceReader& trace, const std::vector<std::uint64_t>& frames,
                    const ViewGeometry& geometry, bool has_velocity) {
  const std::uint64_t points = geometry.topology().points;
  const std::uint64_t cells = geometry.topology().cells();
  const Handle point_set = sink.rows("/VTKHDF/Points", Element::kF32, 3, frames.size() * points, "m");
  Handle velocity_set;
  if (has_velocity)
    velocity_set = sink.rows("/VTKHDF/CellData/velocity", Element::kF32, 3, frames.size() * cells, "m/s");
  std::vector<double> times;
  for (std::uint64_t i = 0; i < frames.size() && sink.ok(); ++i) {
    const auto frame = trace.read(frames[i], bit(Group::kDetection));
    if (!frame) return frame.error();
    times.push_back(frame.value().time_s);
    sink.note(
        put_rows(point_set.get(), Element::kF32, kThree, i * points, points, geometry.points(frame.value()).data()),
        "/VTKHDF/Points");
    if (has_velocity)
      sink.note(
          put_rows(velocity_set.get(), Element::kF32, kThree, i * cells, cells, frame.value().detected_velocity.data()),
          "/VTKHDF/CellData/velocity");
  }
  sink.array("/VTKHDF/Steps/Values", Element::kF64, 1, times.size(), times.data(), "s");
  return Done{};
}

}  // namespace

Result<ViewReport> write_view(const TraceReader& trace, const ViewRequest& request, const std::filesystem::path& file) {
  const QuietHdf5 quiet;
  if (const Status s = check_detection(trace); !s) return s.error();
  const std::vector<std::uint64_t> frames = chosen_frames(trace, request);
  const ViewGeometry geometry(trace.header().scene, request.of);
  if (frames.empty() || geometry.topology().cells() == 0)
    return Error{frames.empty() ? "no recorded frame is among the steps asked for" : "it has no bodies to draw",
                 trace.path().string(), "choose other steps, or another trace"};
  const auto times = times_of(trace, frames);
  if (!times) return times.error();
  auto made = PartFile::create(std::filesystem::path(file) += ".part");
  if (!made) return made.error();
  PartFile& part = *made.value();
  const bool has_velocity = request.of == ViewOf::kBoxes;
  Status status = Done{};
  {
    Handle hdf5 = create_hdf5(part);
    Hdf5Sink sink(hdf5.get());
    if (hdf5) write_vtk_topology(sink, frames.size(), geometry.topology(), has_velocity);
    if (hdf5 && sink.ok()) status = write_frames(sink, trace, frames, geometry, has_velocity);
    if (status.ok() && (!hdf5 || !sink.ok() || !hdf5.close() || part.refused() != 0))
      status = part.refused() != 0
                   ? disk_error(part.refused(), part.path(), "writing the view")
                   : hdf5_error("writing the view failed", part.path().string(), "choose another --out");
  }
  if (const int code = status.ok() ? part.sync() : 0; code != 0)
    status = disk_error(code, part.path(), "syncing the view");
  if (status.ok()) status = rename_durably(part.path(), file);
  if (status.ok())
    status = write_whole_file(std::filesystem::path(file).replace_extension(".xdmf"),
                              xdmf_text(file.filename().string(), geometry.topology(), times.value(), has_velocity));
  if (!status) {
    std::error_code ignored;
    std::filesystem::remove(part.path(), ignored);
    return status.error();
  }
  return ViewReport{frames.size(), geometry.topology().cells()};
}

Result<ViewReport> write_xdmf(const TraceReader& trace, const std::filesystem::path& xdmf) {
  const QuietHdf5 quiet;
  if (const Status s = check_detection(trace); !s) return s.error();
  auto source = Hdf5Source::open(trace.path());
  if (!source) return source.error();
  if (!source.value().has("/VTKHDF/Points"))
    return Error{"it has no /VTKHDF group: another program wrote it, it is of format 1, or it has no frame or body",
                 trace.path().string(), "give --out, which writes the boxes into a file of their own"};
  std::vector<std::uint64_t> frames;
  for (std::uint64_t k = 0; k < trace.frame_count(); ++k) frames.push_back(k);
  const auto times = times_of(trace, frames);
  if (!times) return times.error();
  const VtkTopology topology = box_topology(trace.header().scene.bodies.size());
  const Status s = write_whole_file(xdmf, xdmf_text(trace.path().filename().string(), topology, times.value(), true));
  if (!s) return s.error();
  return ViewReport{frames.size(), topology.cells()};
}

}  // namespace broadside::core
