// broadside.native.BroadPhase and Dynamics: engines of the table, called in this process.
#include "bench/engines.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bench/plugin_engines.hpp"
#include "bench/python/native/arrays.hpp"
#include "bench/python/native/held_scene.hpp"
#include "bench/python/native/module.hpp"
#include "bench/python/native/raise.hpp"

namespace py = pybind11;

namespace broadside::bench::python {
namespace {

using Given = std::map<std::string, std::string>;
template <typename T>
using Packed = py::array_t<T, py::array::c_style>;

core::Engine make_engine(const std::string& id, const Given& settings, bool may_abort) {
  if (is_plugin_path(id))
    throw Raised(
        {"it is a library or a program, and none is loaded into Python", id, "run it: broadside.run(scene, ...)"});
  const core::EngineRow* row = take(find_engine(id));
  if (row->runs_in_child && !may_abort)
    throw Raised({"it or a library of its own may abort, and Python with it", id,
                  "run it in a process of its own, broadside.run(...), or say may_abort=True"});
  if (const std::string why = why_absent(*row); !why.empty())
    throw Raised({why, id, "broadside list engines names those that run here", core::Exit::kMissing});
  return take(row->create(take(core::Settings::parse(row->id, row->settings, settings))));
}

// Calls of one engine take turns: Python's lock is let go while it works.
class HeldBroadPhase {
 public:
  HeldBroadPhase(const std::string& id, const Given& settings, bool may_abort)
      : engine_(make_engine(id, settings, may_abort)) {
    if (!engine_.broad_phase)
      throw Raised({"it offers no broad phase", id, "broadside list engines names those that do"});
  }

  [[nodiscard]] std::string id() const { return engine_.id; }
  [[nodiscard]] std::string build() const { return engine_.build; }
  [[nodiscard]] bool is_exact() const { return engine_.broad_phase->traits().exact; }
  [[nodiscard]] double margin_m() const { return engine_.broad_phase->traits().margin_m; }

  // Boxes [n, 6] are read where they lie.
  py::tuple find_pairs(const Packed<float>& boxes, const std::optional<Packed<std::uint8_t>>& is_static) {
    if (boxes.ndim() != 2 || boxes.shape(1) != 6)
      throw Raised({"boxes of shape " + py::str(boxes.attr("shape")).cast<std::string>(), engine_.id,
                    "give [n, 6]: min x y z, max x y z"});
    const auto count = static_cast<std::size_t>(boxes.shape(0));
    static_assert(sizeof(core::Box) == 6 * sizeof(float));
    const std::span<const core::Box> given(reinterpret_cast<const core::Box*>(boxes.data()), count);
    std::vector<std::uint8_t> flags(count, 0);
    if (is_static) {
      if (is_static->ndim() != 1 || is_static->shape(0) != boxes.shape(0))
        throw Raised({"is_static has not one flag a box", engine_.id, "give [n] of 0 and 1"});
      flags.assign(is_static->data(), is_static->data() + count);
    }
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

 private:
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

  core::Engine engine_;
  std::vector<std::uint8_t> loaded_;
  bool is_loaded_ = false;
  std::mutex mutex_;
};

class HeldDynamics {
 public:
  HeldDynamics(const std::string& id, HeldScene scene, const Given& settings, bool may_abort)
      : scene_(std::move(scene)), engine_(make_engine(id, settings, may_abort)) {
    if (!engine_.dynamics) throw Raised({"it offers no dynamics", id, "broadside list engines names those that do"});
    const py::gil_scoped_release others_run;
    take(engine_.dynamics->load(*scene_.scene));
  }

  [[nodiscard]] std::string id() const { return engine_.id; }
  [[nodiscard]] std::string build() const { return engine_.build; }
  [[nodiscard]] Given declaration() const {
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
  py::class_<HeldBroadPhase>(module, "BroadPhase")
      .def(py::init<const std::string&, const Given&, bool>(), py::arg("engine"), py::arg("settings"),
           py::arg("may_abort"))
      .def_property_readonly("id", &HeldBroadPhase::id)
      .def_property_readonly("build", &HeldBroadPhase::build)
      .def_property_readonly("is_exact", &HeldBroadPhase::is_exact)
      .def_property_readonly("margin_m", &HeldBroadPhase::margin_m)
      .def("find_pairs", &HeldBroadPhase::find_pairs, py::arg("boxes").noconvert(),
           py::arg("is_static").noconvert() = py::none());
  py::class_<HeldDynamics>(module, "Dynamics")
      .def(py::init<const std::string&, HeldScene, const Given&, bool>(), py::arg("engine"), py::arg("scene"),
           py::arg("settings"), py::arg("may_abort"))
      .def_property_readonly("id", &HeldDynamics::id)
      .def_property_readonly("build", &HeldDynamics::build)
      .def_property_readonly("declaration", &HeldDynamics::declaration)
      .def_property_readonly("steps_done", &HeldDynamics::steps_done)
      .def_property_readonly("scene", &HeldDynamics::scene)
      .def("step", &HeldDynamics::step, py::arg("count") = 1)
      .def("read", &HeldDynamics::read);
  module.def("engine_rows", engine_rows);
}

}  // namespace broadside::bench::python
