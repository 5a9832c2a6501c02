#include "bench/python/native/make_engine.hpp"

#include "bench/engines.hpp"
#include "bench/plugin_engines.hpp"
#include "bench/python/native/raise.hpp"

namespace broadside::bench::python {

core::Engine make_engine(const std::string& id, const GivenSettings& settings, bool may_abort) {
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

}  // namespace broadside::bench::python
