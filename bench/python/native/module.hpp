// The parts of the Python module broadside.native. Each adds its classes and functions to it.
#pragma once

namespace pybind11 {
class module_;
}

namespace broadside::bench::python {

void add_scenes(pybind11::module_& module);
void add_traces(pybind11::module_& module);
void add_writer(pybind11::module_& module);
void add_judgement(pybind11::module_& module);
void add_broad_phases(pybind11::module_& module);
void add_engines(pybind11::module_& module);

}  // namespace broadside::bench::python
