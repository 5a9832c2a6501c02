// broadside.native.Dynamics: a simulation of the table's engines, called in this process, and the table itself.
#include "bench/engines.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bench/python/native/arrays.hpp"
#include "bench/python/native/held_scene.hpp"
#include "bench/python/native/make_engine.hpp"
#include "bench/python/native/module.hpp"
#include "bench/python/native/raise.hpp"
#include "core/engine/frame_on_device.hpp"

namespace py = pybind11;

namespace broadside::bench::python {
namespace {

// Calls of one engine take turns, because Python's lock is released while it works.
class HeldDynamics {
 public:
  HeldDynamics(const std::string& id, HeldScene scene, const GivenSettings& settings, bool may_abort)
      : scene_(std::move(scene)), engine_(make_engine(id, settings, may_abort)) {
    if (!engine_.dynamics) throw Raised({"it offers no dynamics", id, "broadside list engines names those that do"});
    const py::gil_scoped_release others_run;
    take(engine_.dynamics->load(*scene_.scene));
  }

  [[nodiscard]] std::string id() const { return engine_.id; }
  [[nodiscard]] std::string build() const { return engine_.build; }
  [[nodiscard]] GivenSettings declaration() const {
    const auto& declared = engine_.declaration.declared();
    return {declared.begin(), declared.end()};
  }
  [[nodiscard]] std::uint64_t steps_done() const { return steps_; }
  [[nodiscard]] HeldScene scene() const { return scene_; }

  void step(std::uint64_t count) {
    const py::gil_scoped_release others_run;
    const std::lock_guard lock(mutex_);
    for (std::uint64_t k = 0; k < count; ++k, ++steps_) take(engine_.dynamics->step(scene_.scene->dt_s));
  }

  // The columns of the frame on the device that it runs on, by path: address, rows, numbers in a row, bytes from one
  // row to the next, whether they are floats; and the device.
  py::tuple frame_on_device() {
    auto* const there = dynamic_cast<core::FrameOnDevice*>(engine_.dynamics.get());
    if (there == nullptr)
      throw Raised({"its states are in the host's memory", engine_.id, "read() gives them without a copy"});
    const core::DeviceFrame frame = [&] {
      const py::gil_scoped_release others_run;
      const std::lock_guard lock(mutex_);
      return take(there->frame_on_device());
    }();
    py::dict columns;
    for (const core::DeviceColumn& c : frame.columns)
      columns[py::str(c.path.data(), c.path.size())] =
          py::make_tuple(reinterpret_cast<std::uint64_t>(c.data), c.rows, c.width, c.row_bytes, c.is_float);
    return py::make_tuple(columns, frame.device);
  }

  std::shared_ptr<HeldFrame> read() {
    if (steps_ == 0) throw Raised({"no step was made", engine_.id, "call step() first"});
    const py::gil_scoped_release others_run;
    const std::lock_guard lock(mutex_);
    auto frame = std::make_shared<HeldFrame>();
    frame->groups = engine_.dynamics->groups();
    frame->bodies = scene_.scene->body_count();
    take(engine_.dynamics->read_back(frame->record, core::RecordLevel::kFull));
    frame->record.step = steps_;
    frame->record.time_s = static_cast<double>(steps_) * scene_.scene->dt_s;
    return frame;
  }

 private:
  HeldScene scene_;  // outlives the engine that was loaded with it
  core::Engine engine_;
  std::uint64_t steps_ = 0;
  std::mutex mutex_;
};

py::list engine_rows() {
  py::list rows;
  for (const core::EngineRow& row : engines()) {
    py::dict facts;
    facts["id"] = std::string(row.id);
    facts["capabilities"] = std::string(row.capabilities);
    facts["what"] = std::string(row.what);
    facts["runs_in_child"] = row.runs_in_child;
    facts["absent"] = why_absent(row);
    py::dict settings;
    for (const core::SettingRow& setting : row.settings)
      settings[py::str(std::string(setting.key))] = std::string(setting.default_value);
    facts["settings"] = settings;
    rows.append(facts);
  }
  return rows;
}

}  // namespace

void add_engines(py::module_& module) {
  py::class_<HeldDynamics>(module, "Dynamics")
      .def(py::init<const std::string&, HeldScene, const GivenSettings&, bool>(), py::arg("engine"), py::arg("scene"),
           py::arg("settings"), py::arg("may_abort"))
      .def_property_readonly("id", &HeldDynamics::id)
      .def_property_readonly("build", &HeldDynamics::build)
      .def_property_readonly("declaration", &HeldDynamics::declaration)
      .def_property_readonly("steps_done", &HeldDynamics::steps_done)
      .def_property_readonly("scene", &HeldDynamics::scene)
      .def("step", &HeldDynamics::step, py::arg("count") = 1)
      .def("frame_on_device", &HeldDynamics::frame_on_device)
      .def("read", &HeldDynamics::read);
  module.def("engine_rows", engine_rows);
}

}  // namespace broadside::bench::python
