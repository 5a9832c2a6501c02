// broadside.native.Writer: writes a trace of another engine, frame by frame, and refuses what a reader would refuse.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "bench/python/native/arrays.hpp"
#include "bench/python/native/frame_digest_of.hpp"
#include "bench/python/native/held_scene.hpp"
#include "bench/python/native/module.hpp"
#include "bench/python/native/raise.hpp"
#include "core/trace/refuse_frame.hpp"
#include "core/trace/trace_writer.hpp"

namespace py = pybind11;

namespace broadside::bench::python {
namespace {

using core::Column;
using core::Layout;
using core::Records;

struct OpenWriter {
  std::string path;
  core::TraceHeader header;
  core::TraceWriter writer;
  std::optional<std::uint64_t> last_step = {};
};

std::string text_of(const py::dict& given, const char* key) {
  return given.contains(key) ? py::str(given[key]).cast<std::string>() : std::string();
}

// The keys are explained in broadside/writer.py, which fills all of them.
std::shared_ptr<OpenWriter> create(const std::string& path, const HeldScene& scene, std::uint32_t groups,
                                   const std::map<std::string, std::string>& declaration,
                                   const std::map<std::string, std::string>& notes, const py::dict& given) {
  core::TraceHeader header;
  header.scene = *scene.scene;
  header.groups = groups;
  header.declaration = take(core::Declaration::parse(declaration, path + ": /declaration"));
  header.notes = notes;
  header.stamp.scene_name = header.scene.name;
  header.stamp.scene_digest = core::scene_digest(header.scene);
  header.stamp.engine = text_of(given, "engine");
  header.stamp.engine_build = text_of(given, "engine_build");
  header.stamp.settings = text_of(given, "settings");
  header.stamp.settings_short = header.stamp.settings;
  header.stamp.machine = text_of(given, "machine");
  header.every = given["every"].cast<std::uint32_t>();
  header.broad_is_exact = given["broad_is_exact"].cast<bool>();
  header.broad_margin_m = given["broad_margin_m"].cast<double>();
  core::TraceWriter writer = take(core::TraceWriter::create(path, header));
  return std::shared_ptr<OpenWriter>(new OpenWriter{path, std::move(header), std::move(writer)});
}

[[noreturn]] void refuse(const OpenWriter& open, std::uint64_t step, const std::string& what,
                         const std::string& advice) {
  throw Raised({"step " + std::to_string(step) + " " + what, open.path, advice});
}

std::string shape_text(const std::string& first, const Column& column) {
  return "[" + first + (column.width > 1 ? ", " + std::to_string(column.width) : std::string()) + "]";
}

// The array of this column: of the file's own type, packed, and with one row of `width` a record.
void check_array(const OpenWriter& open, std::uint64_t step, const Column& column, const py::array& array) {
  const std::string name = short_path(column);
  if (!array.dtype().is(dtype_of(column.element)) && !array.dtype().equal(dtype_of(column.element)))
    refuse(open, step, "has " + name + " as " + py::str(array.dtype()).cast<std::string>(),
           "give " + py::str(dtype_of(column.element)).cast<std::string>());
  const bool is_of_bodies = column.layout == Layout::kFrameBodies;
  const std::uint32_t bodies = open.header.scene.body_count();
  const bool has_rank = array.ndim() == (column.width > 1 ? 2 : 1);
  const bool fits = has_rank && (column.width == 1 || array.shape(1) == column.width) &&
                    (!is_of_bodies || array.shape(0) == static_cast<py::ssize_t>(bodies));
  if (fits) return;
  refuse(open, step, "has " + name + " of shape " + py::str(array.attr("shape")).cast<std::string>(),
         "give " + shape_text(is_of_bodies ? std::to_string(bodies) : "rows", column));
}

class FrameFiller {
 public:
  FrameFiller(const OpenWriter& open, core::FrameRecord& frame) : open_(open), frame_(frame) {}

  void take_column(const Column& column, const py::array& array) {
    check_array(open_, frame_.step, column, array);
    const auto count = static_cast<std::size_t>(array.shape(0));
    const bool is_first = filled_.insert(column.records).second;
    if (!is_first && core::records_of(frame_, column.records).count != count)
      refuse(open_, frame_.step,
             "has " + std::to_string(count) + " rows of " + short_path(column) +
                 " and a different number in an array before it",
             "give every array of a group as many rows");
    const auto rows = core::resized_records(frame_, column.records, count);
    const std::size_t bytes = core::row_bytes(column);
    const auto* from = static_cast<const std::byte*>(array.data());
    for (std::size_t k = 0; k < count; ++k)
      std::memcpy(rows.data + k * rows.stride + column.offset, from + k * bytes, bytes);
  }

 private:
  const OpenWriter& open_;
  core::FrameRecord& frame_;
  std::set<Records> filled_;
};

// Adds float32 states beside the float64 ones, as every reader does.
void narrow(core::FrameRecord& frame) {
  const auto all = [](const auto& from, auto& to) {
    to.clear();
    for (const auto& value : from) to.push_back(core::narrowed(value));
  };
  all(frame.wide.position, frame.position);
  all(frame.wide.orientation, frame.orientation);
  all(frame.wide.velocity, frame.velocity);
  all(frame.wide.angular_velocity, frame.angular_velocity);
}

core::FrameRecord frame_of(const OpenWriter& open, std::uint64_t step, const py::dict& arrays) {
  core::FrameRecord frame;
  frame.step = step;
  frame.time_s = static_cast<double>(step) * open.header.scene.dt_s;
  FrameFiller filler(open, frame);
  std::set<std::string> known;
  for (const Column& column : core::columns()) {
    const bool is_there = (column.groups & open.header.groups) != 0U;
    const bool is_array = column.layout == Layout::kFrameBodies || column.layout == Layout::kRows;
    const std::string name = short_path(column);
    if (!is_there || !is_array || &column_named(name, open.header.groups, open.path) != &column) continue;
    known.insert(name);
    if (arrays.contains(name))
      filler.take_column(column, arrays[py::str(name)].cast<py::array>());
    else if (!column.is_optional)
      refuse(open, step, "has no " + name, "give every array of the groups of the first frame");
  }
  for (const auto& item : arrays)
    if (!known.contains(py::str(item.first).cast<std::string>()))
      refuse(open, step, "has " + py::str(item.first).cast<std::string>() + ", which the first frame did not have",
             "give the same groups in every frame");
  if ((open.header.groups & core::bit(core::Group::kWideBodies)) != 0U) narrow(frame);
  frame.pairs_demanded = frame.pairs.size();
  frame.pairs_raw = frame.pairs.size();
  return frame;
}

void append(OpenWriter& open, std::uint64_t step, const py::dict& arrays,
            const std::optional<std::uint64_t>& pairs_demanded, const std::optional<std::uint64_t>& pairs_raw) {
  if (open.last_step && step <= *open.last_step)
    refuse(open, step, "follows step " + std::to_string(*open.last_step), "append frames in rising order");
  core::FrameRecord frame = frame_of(open, step, arrays);
  frame.pairs_demanded = pairs_demanded.value_or(frame.pairs_demanded);
  frame.pairs_raw = pairs_raw.value_or(frame.pairs_raw);
  if (const auto fault = core::fault_of(frame, open.header.scene))
    throw Raised({fault->what, open.path + ": " + fault->at, fault->advice});
  frame.digest = digest_of(frame, open.header.groups);
  const py::gil_scoped_release others_run;
  take(open.writer.append(frame));
  open.last_step = step;
}

}  // namespace

void add_writer(py::module_& module) {
  py::class_<OpenWriter, std::shared_ptr<OpenWriter>>(module, "Writer")
      .def(py::init(&create), py::arg("path"), py::arg("scene"), py::arg("groups"), py::arg("declaration"),
           py::arg("notes"), py::arg("given"))
      .def("append", append, py::arg("step"), py::arg("arrays"), py::arg("pairs_demanded") = py::none(),
           py::arg("pairs_raw") = py::none())
      .def("flush",
           [](OpenWriter& open) {
             const py::gil_scoped_release others_run;
             take(open.writer.flush());
           })
      .def("finish", [](OpenWriter& open) {
        const py::gil_scoped_release others_run;
        take(open.writer.finish());
      });
  module.def("check_declaration", [](const std::map<std::string, std::string>& declaration) {
    take(core::Declaration::parse(declaration, "the declaration"));
  });
  module.def("groups_by_name", [] {
    std::map<std::string, std::uint32_t> groups;
    for (const core::GroupRow& row : core::group_rows())
      groups[std::string(row.path.substr(row.path.find('/', 1) + 1))] = core::bit(row.group);
    groups["body in float64"] = core::bit(core::Group::kWideBodies);
    return groups;
  });
}

}  // namespace broadside::bench::python
