// broadside.native.Scene: the immutable description of a simulation, by name, from a file, or out of a trace.
#include "datasets/scenes.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string>

#include "bench/python/native/arrays.hpp"
#include "bench/python/native/held_scene.hpp"
#include "bench/python/native/module.hpp"
#include "bench/python/native/raise.hpp"
#include "datasets/scene_file/scene_file.hpp"

namespace py = pybind11;

namespace broadside::bench::python {
namespace {

using core::Body;

// A read-only array over one member of every body.
template <typename T>
py::array of_bodies(const HeldScene& held, T Body::*member, std::vector<py::ssize_t> inner, py::handle owner) {
  const auto& bodies = held.scene->bodies;
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(bodies.size())};
  std::vector<py::ssize_t> strides{sizeof(Body)};
  for (const py::ssize_t size : inner) {
    shape.push_back(size);
    strides.push_back(sizeof(float));
  }
  const void* const first = bodies.empty() ? nullptr : &(bodies[0].*member);
  const bool is_count = std::is_same_v<T, std::uint32_t>;
  py::array array(is_count ? py::dtype::of<std::uint32_t>() : py::dtype::of<float>(), shape, strides, first, owner);
  return read_only(std::move(array));
}

template <typename T>
auto body_member(T Body::*member, std::vector<py::ssize_t> inner) {
  return
      [member, inner](const py::object& self) { return of_bodies(self.cast<const HeldScene&>(), member, inner, self); };
}

py::list meshes_of(const py::object& self) {
  py::list meshes;
  for (const auto& mesh : self.cast<const HeldScene&>().scene->meshes) {
    const auto rows = [&self](const auto& values, py::dtype dtype) {
      const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(values.size()), 3};
      py::array array(std::move(dtype), shape, values.data(), self);
      return read_only(std::move(array));
    };
    py::dict made;
    made["name"] = mesh->name;
    made["source"] = mesh->source;
    made["is_stand_in"] = mesh->is_stand_in;
    made["vertices"] = rows(mesh->vertices, py::dtype::of<float>());
    made["triangles"] = rows(mesh->triangles, py::dtype::of<std::uint32_t>());
    meshes.append(made);
  }
  return meshes;
}

std::array<float, 3> triple(core::Vec3 v) {
  return {v.x, v.y, v.z};
}

HeldScene make(const std::string& spec, std::optional<std::uint32_t> frames, std::optional<std::uint64_t> seed,
               bool allow_stand_in) {
  datasets::SceneOptions options;
  options.frames = frames;
  options.seed = seed;
  options.meshes.allow_procedural = allow_stand_in;
  return {std::make_shared<const core::Scene>(take(datasets::make_scene(spec, options)))};
}

}  // namespace

void add_scenes(py::module_& module) {
  py::class_<HeldScene>(
      module, "Scene",
      "A scene: immutable. Arrays are read-only views of its n bodies: position [n, 3] m, orientation [n, 4] w x y z, "
      "velocity [n, 3] m/s, angular_velocity [n, 3] rad/s, inverse_mass [n] 1/kg (0 = static), mesh_of_body [n]. Two "
      "scenes of one digest are the same scene.")
      .def_property_readonly("name", [](const HeldScene& s) { return s.scene->name; })
      .def_property_readonly("description", [](const HeldScene& s) { return s.scene->description; })
      .def_property_readonly("motion", [](const HeldScene& s) { return std::string(motion_word(s.scene->motion)); })
      .def_property_readonly("answer", [](const HeldScene& s) { return s.scene->answer; })
      .def_property_readonly("frames", [](const HeldScene& s) { return s.scene->frames; })
      .def_property_readonly("seed", [](const HeldScene& s) { return s.scene->seed; })
      .def_property_readonly("dt_s", [](const HeldScene& s) { return s.scene->dt_s; })
      .def_property_readonly("gravity_m_s2", [](const HeldScene& s) { return triple(s.scene->gravity_m_s2); })
      .def_property_readonly("domain_min_m", [](const HeldScene& s) { return triple(s.scene->domain.min); })
      .def_property_readonly("domain_max_m", [](const HeldScene& s) { return triple(s.scene->domain.max); })
      .def_property_readonly("body_count", [](const HeldScene& s) { return s.scene->body_count(); })
      .def_property_readonly("digest", [](const HeldScene& s) { return core::scene_digest(*s.scene); })
      .def_property_readonly("mesh_of_body", body_member(&Body::mesh, {}))
      .def_property_readonly("position", body_member(&Body::position, {3}))
      .def_property_readonly("orientation", body_member(&Body::orientation, {4}))
      .def_property_readonly("velocity", body_member(&Body::velocity, {3}))
      .def_property_readonly("angular_velocity", body_member(&Body::angular_velocity, {3}))
      .def_property_readonly("inverse_mass", body_member(&Body::inverse_mass, {}))
      .def_property_readonly("meshes", meshes_of)
      .def(
          "save", [](const HeldScene& s, const std::string& path) { take(datasets::write_scene_file(*s.scene, path)); },
          py::arg("path"));
  module.def("make_scene", make, py::arg("spec"), py::arg("frames") = py::none(), py::arg("seed") = py::none(),
             py::arg("allow_stand_in") = false);
  module.def("scene_names", [] {
    std::vector<std::array<std::string, 3>> rows;
    for (const auto& row : datasets::scene_table())
      rows.push_back({std::string(row.pattern), std::string(row.example), std::string(row.what)});
    return rows;
  });
}

}  // namespace broadside::bench::python
