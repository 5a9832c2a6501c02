// broadside.native.Trace and Frame: a trace file, read frame by frame or column by column.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstring>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bench/python/native/arrays.hpp"
#include "bench/python/native/held_scene.hpp"
#include "bench/python/native/module.hpp"
#include "bench/python/native/raise.hpp"
#include "core/trace/trace_reader.hpp"

namespace py = pybind11;

namespace broadside::bench::python {
namespace {

using core::Column;
using core::Layout;

// The reader is not thread-safe, and Python's lock is released while it reads, so calls take turns.
struct OpenTrace {
  core::TraceReader reader;
  std::mutex mutex = {};
};

std::shared_ptr<OpenTrace> open(const std::string& path) {
  const py::gil_scoped_release others_run;
  return std::shared_ptr<OpenTrace>(new OpenTrace{take(core::TraceReader::open(path))});
}

core::FrameRecord frame_at(OpenTrace& trace, std::uint64_t index, std::uint32_t groups) {
  return take(trace.reader.read(index, groups));
}

std::shared_ptr<HeldFrame> read(OpenTrace& trace, std::uint64_t index, std::uint32_t groups) {
  const py::gil_scoped_release others_run;
  const std::lock_guard lock(trace.mutex);
  const core::TraceHeader& header = trace.reader.header();
  return std::make_shared<HeldFrame>(
      HeldFrame{frame_at(trace, index, groups), header.groups & groups, header.scene.body_count()});
}

py::array offsets(OpenTrace& trace, const Column& column) {
  std::vector<std::uint64_t> rows{0};
  {
    const py::gil_scoped_release others_run;
    const std::lock_guard lock(trace.mutex);
    for (std::uint64_t k = 0; k < trace.reader.frame_count(); ++k) {
      const core::FrameRecord frame = frame_at(trace, k, column.groups);
      rows.push_back(rows.back() + core::records_of(frame, core::offsets_of(column.records)).count);
    }
  }
  const auto count = static_cast<py::ssize_t>(rows.size());
  return owned_array(std::move(rows), py::dtype::of<std::uint64_t>(), {count});
}

// Copies rows that are `stride` bytes apart to rows that hold this column alone.
void append_rows(const Column& column, const std::byte* first, std::size_t count, std::size_t stride,
                 std::vector<std::byte>& to) {
  const std::size_t bytes = core::row_bytes(column);
  std::size_t at = to.size();
  to.resize(at + count * bytes);
  for (std::size_t k = 0; k < count; ++k, at += bytes)
    std::memcpy(to.data() + at, first + k * stride + column.offset, bytes);
}

std::vector<py::ssize_t> shape_of(const Column& column, std::size_t frames, std::size_t bodies, std::size_t rows) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(column.layout == Layout::kRows ? rows : frames)};
  if (column.layout == Layout::kWindows) shape[0] = static_cast<py::ssize_t>(rows);
  if (column.layout == Layout::kFrameBodies) shape.push_back(static_cast<py::ssize_t>(bodies));
  if (column.width > 1 || column.layout == Layout::kFrameBodies) shape.push_back(column.width);
  return shape;
}

// All frames of one column, as it lies in the file.
py::array whole(OpenTrace& trace, const std::string& path) {
  const core::TraceHeader& header = trace.reader.header();
  const Column& column = column_named(path, header.groups, trace.reader.path().string());
  if (column.layout == Layout::kOffsets) return offsets(trace, column);
  std::vector<std::byte> bytes;
  {
    const py::gil_scoped_release others_run;
    const std::lock_guard lock(trace.mutex);
    if (column.layout == Layout::kWindows) {
      const auto windows = take(trace.reader.statistics());
      append_rows(column, reinterpret_cast<const std::byte*>(windows.data()), windows.size(), sizeof windows[0], bytes);
    } else {
      for (std::uint64_t k = 0; k < trace.reader.frame_count(); ++k) {
        const core::FrameRecord frame = frame_at(trace, k, column.groups);
        const auto rows = core::records_of(frame, column.records);
        append_rows(column, rows.data, rows.count, rows.stride, bytes);
      }
    }
  }
  const std::size_t rows = bytes.size() / core::row_bytes(column);
  return owned_array(std::move(bytes), dtype_of(column.element),
                     shape_of(column, trace.reader.frame_count(), header.scene.body_count(), rows));
}

const char* layout_word(Layout layout) {
  switch (layout) {
    case Layout::kFrames:
      return "frames";
    case Layout::kFrameBodies:
      return "bodies";
    case Layout::kRows:
      return "rows";
    case Layout::kOffsets:
      return "offsets";
    case Layout::kWindows:
      return "windows";
  }
  return "rows";
}

py::dict column_facts(const Column& column) {
  py::dict facts;
  facts["path"] = short_path(column);
  facts["layout"] = layout_word(column.layout);
  facts["dtype"] = dtype_of(column.element);
  facts["width"] = column.width;
  facts["unit"] = std::string(column.unit);
  facts["groups"] = column.groups;
  facts["is_optional"] = column.is_optional;
  return facts;
}

// The columns that a trace of these groups has.
py::list columns_of(std::uint32_t groups) {
  py::list rows;
  for (const Column& column : core::columns()) {
    const bool is_there = column.groups == 0 || (column.groups & groups) != 0U;
    if (is_there && &column_named(short_path(column), groups, {}) == &column) rows.append(column_facts(column));
  }
  return rows;
}

py::dict header_of(const OpenTrace& trace) {
  const core::TraceHeader& header = trace.reader.header();
  py::dict facts;
  facts["engine"] = header.stamp.engine;
  facts["label"] = header.stamp.label();
  facts["settings"] = header.stamp.settings;
  facts["engine_build"] = header.stamp.engine_build;
  facts["broadside_build"] = header.stamp.broadside_build;
  facts["machine"] = header.stamp.machine;
  facts["every"] = header.every;
  facts["driver"] = header.driver;
  facts["notes"] = header.notes;
  py::dict declaration;
  for (const auto& [key, value] : header.declaration.declared()) declaration[py::str(key)] = value;
  facts["declaration"] = declaration;
  return facts;
}

HeldScene scene_of(const std::shared_ptr<OpenTrace>& trace) {
  return {std::shared_ptr<const core::Scene>(trace, &trace->reader.header().scene)};
}

py::array steps_of(const OpenTrace& trace) {
  std::vector<std::uint64_t> steps = trace.reader.steps();
  const auto count = static_cast<py::ssize_t>(steps.size());
  return owned_array(std::move(steps), py::dtype::of<std::uint64_t>(), {count});
}

}  // namespace

void add_traces(py::module_& module) {
  py::class_<HeldFrame, std::shared_ptr<HeldFrame>>(module, "Frame")
      .def_property_readonly("step", [](const HeldFrame& f) { return f.record.step; })
      .def_property_readonly("time_s", [](const HeldFrame& f) { return f.record.time_s; })
      .def_property_readonly("digest", [](const HeldFrame& f) { return f.record.digest; })
      .def_property_readonly("groups", [](const HeldFrame& f) { return f.groups; })
      .def("rows", [](const py::object& self, const std::string& path) {
        const auto& frame = self.cast<const HeldFrame&>();
        const Column& column = column_named(path, frame.groups, "this frame");
        if (column.layout == Layout::kOffsets || column.layout == Layout::kWindows)
          throw Raised({path + " belongs to the whole trace", "a frame", "ask the trace for it"});
        return rows_of_frame(frame, column, self);
      });
  py::class_<OpenTrace, std::shared_ptr<OpenTrace>>(module, "Trace")
      .def(py::init(&open), py::arg("path"))
      .def("__len__", [](const OpenTrace& t) { return t.reader.frame_count(); })
      .def_property_readonly("frames_begun", [](const OpenTrace& t) { return t.reader.frames_begun(); })
      .def_property_readonly("groups", [](const OpenTrace& t) { return t.reader.header().groups; })
      .def_property_readonly("header", header_of)
      .def_property_readonly("scene", scene_of)
      .def_property_readonly("steps", steps_of)
      .def("columns", [](const OpenTrace& t) { return columns_of(t.reader.header().groups); })
      .def("read", read, py::arg("index"), py::arg("groups"))
      .def("whole", whole, py::arg("path"));
  module.def("columns_of", columns_of, py::arg("groups"));
}

}  // namespace broadside::bench::python
