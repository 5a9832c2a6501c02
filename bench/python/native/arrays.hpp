// NumPy arrays over this program's memory, and rows of a frame as such arrays. Nothing is copied.
#pragma once

#include <pybind11/numpy.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/trace/columns.hpp"
#include "core/trace/frame.hpp"

namespace broadside::bench::python {

// A frame that Python holds, and the groups that it has.
struct HeldFrame {
  core::FrameRecord record;
  std::uint32_t groups = 0;
  std::uint32_t bodies = 0;
};

// The column of a short path, "body/position" for /trace/body/position; the column of float64 states where the groups
// have them. An unknown path is an error that names the nearest known one, and an absent group is an error that says
// so; `where` is part of both.
const core::Column& column_named(const std::string& path, std::uint32_t groups, const std::string& where);
// "body/position": the path without "/trace/".
std::string short_path(const core::Column& column);

pybind11::dtype dtype_of(core::Element element);

// The same array, but not writeable: traces and scenes are immutable.
pybind11::array read_only(pybind11::array array);

// A read-only array over the rows that the frame has of this column; owner keeps them alive.
pybind11::array rows_of_frame(const HeldFrame& frame, const core::Column& column, pybind11::handle owner);

// An array that owns these values.
template <typename T>
pybind11::array owned_array(std::vector<T> values, const pybind11::dtype& dtype, std::vector<pybind11::ssize_t> shape) {
  auto held = std::make_unique<std::vector<T>>(std::move(values));
  void* const data = held->data();
  const pybind11::capsule owner(held.release(), [](void* given) { delete static_cast<std::vector<T>*>(given); });
  return pybind11::array(dtype, std::move(shape), data, owner);
}

}  // namespace broadside::bench::python
