#include "core/trace/recover.hpp"

#include <algorithm>
#include <system_error>

#include "core/trace/part_file.hpp"
#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_writer.hpp"

namespace broadside::core {

std::string RecoverReport::line() const {
  std::string text = std::to_string(frames_kept) + " of " + std::to_string(frames_planned) +
                     " frames recovered (up to step " + std::to_string(last_step) + ")";
  if (frames_begun > frames_kept)
    text += "; " + std::to_string(frames_begun - frames_kept) + " more were begun but not finished";
  return text;
}

namespace {

Error still_written(const std::filesystem::path& part) {
  return {"its writer is still at work", part.string(), "wait until it has finished or been stopped"};
}

}  // namespace

Status set_aside(const std::filesystem::path& part, const std::filesystem::path& to) {
  if (is_being_written(part)) return still_written(part);
  return rename_durably(part, to);
}

Result<RecoverReport> recover_trace(const std::filesystem::path& part, const std::filesystem::path& out) {
  std::error_code ignored;
  if (std::filesystem::exists(out, ignored))
    return Error{"a file of that name exists", out.string(), "move it away or choose another name with --out"};
  if (is_being_written(part)) return still_written(part);
  Result<TraceReader> reader = TraceReader::open(part);
  if (!reader) return reader.error();
  const TraceReader& trace = reader.value();
  RecoverReport report;
  report.frames_kept = trace.frame_count();
  report.frames_begun = trace.frames_begun();
  report.frames_planned = trace.header().scene.frames / std::max<std::uint32_t>(1, trace.header().every);
  if (report.frames_kept == 0)
    return Error{"not one whole frame was written before it was cut off", part.string(), "record it again"};
  report.last_step = trace.steps().back();

  TraceHeader header = trace.header();
  header.notes["recovered"] = report.line();
  // Written under another name: the part file of `out` itself could be the file that is being read.
  const std::filesystem::path whole = std::filesystem::path(out) += ".recovered";
  Result<TraceWriter> writer = TraceWriter::create(whole, header);
  if (!writer) return writer.error();
  Status status = Done{};
  for (std::uint64_t k = 0; k < trace.frame_count() && status.ok(); ++k) {
    const Result<FrameRecord> frame = trace.read(k, header.groups);
    status = frame ? writer.value().append(frame.value()) : Status(frame.error());
  }
  if (status.ok()) status = writer.value().finish();
  if (!status) {
    std::filesystem::remove(std::filesystem::path(whole) += ".part", ignored);
    return status.error();
  }
  if (Status renamed = rename_durably(whole, out); !renamed) return renamed.error();
  return report;
}

}  // namespace broadside::core
