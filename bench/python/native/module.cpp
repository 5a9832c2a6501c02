#include "bench/python/native/module.hpp"

#include <pybind11/pybind11.h>

#include <string>

#include "bench/build_facts.hpp"
#include "bench/python/native/raise.hpp"

namespace py = pybind11;

PYBIND11_MODULE(native, module) {
  namespace own = broadside::bench::python;
  module.doc() = "What the package broadside is made of. Take its classes from broadside: they check and explain.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const own::Raised& raised) {
      // Chosen by the exit code that the command line would end with: broadside/errors.py has the table.
      const py::object error =
          py::module_::import("broadside.errors").attr("error_of")(raised.what(), static_cast<int>(raised.exit()));
      PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
    }
  });
  own::add_scenes(module);
  own::add_traces(module);
  own::add_writer(module);
  own::add_judgement(module);
  own::add_broad_phases(module);
  own::add_engines(module);
  module.def("build_line", &broadside::bench::build_line, "Version, commit, compiler and flags of this build.");
  module.def("machine_line", &broadside::bench::machine_line, "CPU, memory, system, and the GPU or \"no device\".");
}
