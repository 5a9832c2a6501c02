// broadside.native.BroadPhase: a broad phase of the table, called in this process.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bench/python/native/arrays.hpp"
#include "bench/python/native/dlpack.hpp"
#include "bench/python/native/make_engine.hpp"
#include "bench/python/native/module.hpp"
#include "bench/python/native/raise.hpp"
#include "core/engine/device_boxes.hpp"

namespace py = pybind11;

namespace broadside::bench::python {
namespace {

template <typename T>
using Packed = py::array_t<T, py::array::c_style>;
using Flags = std::optional<Packed<std::uint8_t>>;

// Calls of one engine take turns, because Python's lock is released while it works.
class HeldBroadPhase {
 public:
  HeldBroadPhase(const std::string& id, const GivenSettings& settings, bool may_abort)
      : engine_(make_engine(id, settings, may_abort)) {
    if (!engine_.broad_phase)
      throw Raised({"it offers no broad phase", id, "broadside list engines names those that do"});
  }

  [[nodiscard]] std::string id() const { return engine_.id; }
  [[nodiscard]] std::string build() const { return engine_.build; }
  [[nodiscard]] bool is_exact() const { return engine_.broad_phase->traits().exact; }
  [[nodiscard]] double margin_m() const { return engine_.broad_phase->traits().margin_m; }

  // Boxes [n, 6] are read where they lie.
  py::tuple find_pairs(const Packed<float>& boxes, const Flags& is_static) {
    if (boxes.ndim() != 2 || boxes.shape(1) != 6)
      throw Raised({"boxes of shape " + py::str(boxes.attr("shape")).cast<std::string>(), engine_.id,
                    "give [n, 6]: min x y z, max x y z"});
    const auto count = static_cast<std::size_t>(boxes.shape(0));
    static_assert(sizeof(core::Box) == 6 * sizeof(float));
    const std::span<const core::Box> given(reinterpret_cast<const core::Box*>(boxes.data()), count);
    const std::vector<std::uint8_t> flags = flags_of(is_static, count);
    core::PairSet found;
    {
      const py::gil_scoped_release others_run;
      const std::lock_guard lock(mutex_);
      found = find(given, flags);
    }
    const std::uint64_t demanded = found.demanded;
    const std::uint64_t raw = found.raw;
    const auto rows = static_cast<py::ssize_t>(found.pairs.size());
    return py::make_tuple(owned_array(std::move(found.pairs), py::dtype::of<std::uint32_t>(), {rows, 2}), demanded,
                          raw);
  }

  // Boxes [count, 6] in the device's memory, read where they lie, after the work that `stream` has so far; without a
  // stream they must be complete. Returns the address and the rows of the pairs, in no order, and the device.
  py::tuple find_pairs_on_device(std::uint64_t address, std::size_t count, std::optional<std::uint64_t> stream,
                                 const Flags& is_static) {
    auto* const taker = dynamic_cast<core::TakesDeviceBoxes*>(engine_.broad_phase.get());
    if (taker == nullptr)
      throw Raised({"the boxes are on a GPU, and it reads the host's memory", engine_.id,
                    "take octree-gpu, or copy them yourself, such as cupy.asnumpy(x) or x.cpu()"});
    // NOLINTBEGIN(performance-no-int-to-ptr): Python has addresses and streams as integers
    const core::DeviceBoxes boxes{reinterpret_cast<const float*>(address), count, stream.has_value(),
                                  reinterpret_cast<void*>(stream.value_or(0))};
    // NOLINTEND(performance-no-int-to-ptr)
    const std::vector<std::uint8_t> flags = flags_of(is_static, count);
    core::DevicePairs found;
    {
      const py::gil_scoped_release others_run;
      const std::lock_guard lock(mutex_);
      found = find_there(*taker, boxes, flags);
    }
    return py::make_tuple(reinterpret_cast<std::uint64_t>(found.data), found.count, found.device);
  }

 private:
  // One flag for each box; no box is static where no flags are given.
  [[nodiscard]] std::vector<std::uint8_t> flags_of(const Flags& is_static, std::size_t count) const {
    if (!is_static) return std::vector<std::uint8_t>(count, 0);
    if (is_static->ndim() != 1 || static_cast<std::size_t>(is_static->shape(0)) != count)
      throw Raised({"is_static has not one flag a box", engine_.id, "give [n] of 0 and 1"});
    return {is_static->data(), is_static->data() + count};
  }

  core::PairSet find(std::span<const core::Box> boxes, const std::vector<std::uint8_t>& flags) {
    core::BroadPhase& broad = *engine_.broad_phase;
    if (flags != loaded_ || !is_loaded_) {
      is_loaded_ = false;
      take(broad.load(boxes, flags));
      loaded_ = flags;
      is_loaded_ = true;
    } else {
      take(broad.update(boxes));
    }
    take(broad.find());
    return take(broad.read_back());
  }

  core::DevicePairs find_there(core::TakesDeviceBoxes& taker, const core::DeviceBoxes& boxes,
                               const std::vector<std::uint8_t>& flags) {
    const bool is_known = is_loaded_ && flags == loaded_;
    is_loaded_ = false;
    take(is_known ? taker.update_on_device(boxes) : taker.load_on_device(boxes, flags));
    loaded_ = flags;
    is_loaded_ = true;
    take(engine_.broad_phase->find());
    return take(taker.pairs_on_device());
  }

  core::Engine engine_;
  std::vector<std::uint8_t> loaded_;
  bool is_loaded_ = false;
  std::mutex mutex_;
};

}  // namespace

void add_broad_phases(py::module_& module) {
  py::class_<HeldBroadPhase>(module, "BroadPhase")
      .def(py::init<const std::string&, const GivenSettings&, bool>(), py::arg("engine"), py::arg("settings"),
           py::arg("may_abort"))
      .def_property_readonly("id", &HeldBroadPhase::id)
      .def_property_readonly("build", &HeldBroadPhase::build)
      .def_property_readonly("is_exact", &HeldBroadPhase::is_exact)
      .def_property_readonly("margin_m", &HeldBroadPhase::margin_m)
      .def("find_pairs", &HeldBroadPhase::find_pairs, py::arg("boxes").noconvert(),
           py::arg("is_static").noconvert() = py::none())
      .def("find_pairs_on_device", &HeldBroadPhase::find_pairs_on_device, py::arg("address"), py::arg("count"),
           py::arg("stream"), py::arg("is_static").noconvert() = py::none());
  py::class_<TakenArray>(module, "TakenArray")
      .def(py::init<const py::capsule&, const std::string&>(), py::arg("capsule"), py::arg("what"))
      .def_property_readonly("address", [](const TakenArray& a) { return reinterpret_cast<std::uint64_t>(a.data()); })
      .def_property_readonly("memory", &TakenArray::memory)
      .def_property_readonly("device", &TakenArray::device)
      .def_property_readonly("shape", &TakenArray::shape)
      .def_property_readonly("type", &TakenArray::type);
  module.def(
      "given_rows",
      [](std::uint64_t address, std::int64_t rows, std::int64_t width, std::int64_t row_bytes, bool is_float,
         int memory, int device, const py::object& owner) {
        return given_rows({address, rows, width, row_bytes, is_float}, memory, device, owner);
      },
      py::arg("address"), py::arg("rows"), py::arg("width"), py::arg("row_bytes"), py::arg("is_float"),
      py::arg("memory"), py::arg("device"), py::arg("owner"));
}

}  // namespace broadside::bench::python
