// broadside.native.Judgement: the verdicts of one trace, and the texts and files that check makes of them.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <string>
#include <vector>

#include "bench/python/native/module.hpp"
#include "bench/python/native/raise.hpp"
#include "bench/record/judging.hpp"
#include "reports/report.hpp"
#include "reports/terminal_table.hpp"
#include "validation/judge.hpp"
#include "validation/outcome.hpp"

namespace py = pybind11;

namespace broadside::bench::python {
namespace {

using Rows = std::vector<core::CellVerdicts>;

core::CellVerdicts judge(const std::string& trace, const std::string& against, const std::vector<std::string>& laws) {
  const py::gil_scoped_release others_run;
  return take(judge_matter({trace, against, false, laws, nullptr}));
}

py::dict facts_of(const core::Verdict& v) {
  py::dict facts;
  facts["law"] = v.validator;
  facts["outcome"] = std::string(core::outcome_word(v.outcome));
  facts["measured"] = v.measured;
  facts["limit"] = v.limit;
  facts["unit"] = v.unit;
  facts["origin"] = v.origin;
  facts["explanation"] = v.explanation;
  facts["says"] = v.law;
  facts["kind"] = std::string(core::law_kind_word(v.kind));
  facts["step"] = v.worst.step < 0 ? py::object(py::none()) : py::object(py::int_(v.worst.step));
  facts["bodies"] = py::tuple(py::cast(v.worst.bodies));
  facts["field"] = v.worst.field;
  facts["checked"] = v.checked;
  facts["violations"] = v.violations;
  facts["baseline"] = v.baseline;
  py::list parts;
  for (const core::Verdict& part : v.parts) parts.append(facts_of(part));
  facts["parts"] = parts;
  return facts;
}

py::list verdicts_of(const core::CellVerdicts& row) {
  py::list verdicts;
  for (const core::Verdict& v : row.verdicts) verdicts.append(facts_of(v));
  return verdicts;
}

// As check: 3 where no law could be judged.
int exit_code(const core::CellVerdicts& row) {
  const core::Exit exit = exit_of({row});
  const bool is_unjudged = validation::worst_outcome(row.verdicts) == core::Outcome::kNotApplicable;
  return static_cast<int>(is_unjudged && exit == core::Exit::kGood ? core::Exit::kMissing : exit);
}

void write_page(const Rows& rows, const std::string& path, const std::string& title, const std::string& command) {
  core::RunRows all;
  all.verdicts = rows;
  reports::ReportOptions options;
  options.title = title;
  options.command = command;
  take(reports::write_html(all, options, path));
}

py::list laws() {
  py::list rows;
  for (const validation::ValidatorRow& row : validation::validators()) {
    py::dict facts;
    facts["name"] = std::string(row.name);
    facts["says"] = std::string(row.law);
    facts["must_reject"] = std::string(row.must_reject);
    facts["kind"] = std::string(core::law_kind_word(row.kind));
    rows.append(facts);
  }
  return rows;
}

}  // namespace

void add_judgement(py::module_& module) {
  py::class_<core::CellVerdicts>(module, "Judgement")
      .def_property_readonly("trace_file", [](const core::CellVerdicts& r) { return r.trace_file; })
      .def_property_readonly("scene", [](const core::CellVerdicts& r) { return r.stamp.scene_name; })
      .def_property_readonly("label", [](const core::CellVerdicts& r) { return r.stamp.label(); })
      .def_property_readonly("exit_code", exit_code)
      .def("verdicts", verdicts_of);
  module.def("judge", judge, py::arg("trace"), py::arg("against"), py::arg("laws"));
  module.def("verdict_table", [](const Rows& rows) { return reports::verdict_table(rows); });
  module.def("failure_lines", [](const Rows& rows) { return reports::failure_lines(rows); });
  module.def("write_verdicts",
             [](const std::string& path, const Rows& rows) { take(core::write_verdicts(path, rows)); });
  module.def("write_junit", [](const std::string& path, const Rows& rows) {
    core::RunRows all;
    all.verdicts = rows;
    take(reports::write_junit(all, {}, path));
  });
  module.def("write_page", write_page, py::arg("rows"), py::arg("path"), py::arg("title"), py::arg("command"));
  module.def("laws", laws);
}

}  // namespace broadside::bench::python
