#include "bench/python/native/arrays.hpp"

#include <string_view>

#include "bench/python/native/raise.hpp"
#include "core/nearest_name.hpp"

namespace py = pybind11;

namespace broadside::bench::python {
namespace {

constexpr std::string_view kPrefix = "/trace/";

// Float64 states hide the float32 states of the same path.
bool is_hidden(const core::Column& column, std::uint32_t groups) {
  const bool is_wide = (groups & core::bit(core::Group::kWideBodies)) != 0U;
  return is_wide ? column.groups == core::bit(core::Group::kBodies)
                 : column.groups == core::bit(core::Group::kWideBodies);
}

}  // namespace

std::string short_path(const core::Column& column) {
  return std::string(column.path.substr(kPrefix.size()));
}

const core::Column& column_named(const std::string& path, std::uint32_t groups, const std::string& where) {
  std::vector<std::string> known;
  for (const core::Column& column : core::columns()) {
    if (is_hidden(column, groups)) continue;
    const std::string name = short_path(column);
    if (name == path) {
      if (column.groups == 0 || (column.groups & groups) != 0U) return column;
      throw Raised({"it has no " + path, where, "trace.columns lists what it has"});
    }
    known.push_back(name);
  }
  throw Raised({"there is no column '" + path + "'", where,
                core::advise_name(path, std::vector<std::string_view>(known.begin(), known.end()))});
}

py::dtype dtype_of(core::Element element) {
  switch (element) {
    case core::Element::kU8:
      return py::dtype::of<std::uint8_t>();
    case core::Element::kU32:
      return py::dtype::of<std::uint32_t>();
    case core::Element::kU64:
      return py::dtype::of<std::uint64_t>();
    case core::Element::kI64:
      return py::dtype::of<std::int64_t>();
    case core::Element::kF32:
      return py::dtype::of<float>();
    case core::Element::kF64:
      return py::dtype::of<double>();
  }
  return py::dtype::of<double>();
}

py::array read_only(py::array array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

py::array rows_of_frame(const HeldFrame& frame, const core::Column& column, py::handle owner) {
  const auto rows = core::records_of(frame.record, column.records);
  const auto element_bytes = static_cast<py::ssize_t>(core::size_of(column.element));
  std::vector<py::ssize_t> shape;
  std::vector<py::ssize_t> strides;
  if (column.layout != core::Layout::kFrames) {
    shape.push_back(static_cast<py::ssize_t>(rows.count));
    strides.push_back(static_cast<py::ssize_t>(rows.stride));
  }
  if (column.width > 1) {
    shape.push_back(column.width);
    strides.push_back(element_bytes);
  }
  const std::byte* const first = rows.count == 0 ? nullptr : rows.data + column.offset;
  return read_only(py::array(dtype_of(column.element), shape, strides, first, owner));
}

}  // namespace broadside::bench::python
