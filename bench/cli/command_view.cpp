#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/cell/more_than_zero.hpp"
#include "bench/cell/step_selection.hpp"
#include "bench/cli/commands.hpp"
#include "core/trace/view_file.hpp"

namespace broadside::bench {
namespace {

struct ViewArguments {
  std::string trace;
  std::string what = "boxes";
  std::uint64_t every = 1;
  std::string window;
  std::string out;
};

constexpr std::array<std::pair<std::string_view, core::ViewOf>, 4> kViews{{{"boxes", core::ViewOf::kBoxes},
                                                                           {"level1", core::ViewOf::kLevel1},
                                                                           {"level2", core::ViewOf::kLevel2},
                                                                           {"meshes", core::ViewOf::kMeshes}}};

core::Exit say(const core::Result<core::ViewReport>& report, const std::filesystem::path& xdmf) {
  if (!report) return complain(report.error());
  fmt::print("{}: {} frames of {} cells\n", xdmf.string(), report.value().frames, report.value().cells);
  return core::Exit::kGood;
}

core::Exit view(const ViewArguments& a) {
  core::ViewRequest request;
  for (const auto& [name, of] : kViews)
    if (name == a.what) request.of = of;
  request.every = a.every;
  if (!a.window.empty()) {
    const auto selection = StepSelection::parse(1, {a.window});
    if (!selection) return complain(selection.error());
    request.first_step = selection.value().windows[0].first;
    request.last_step = selection.value().windows[0].last;
  }
  auto trace = core::TraceReader::open(a.trace);
  if (!trace) return complain(trace.error());
  const std::filesystem::path path(a.trace);
  const bool is_whole = request.of == core::ViewOf::kBoxes && a.every == 1 && a.window.empty() && a.out.empty();
  if (is_whole) {
    const std::filesystem::path xdmf = std::filesystem::path(path).replace_extension(".xdmf");
    return say(core::write_xdmf(trace.value(), xdmf), xdmf);
  }
  std::filesystem::path out(a.out);
  if (out.empty()) out = path.parent_path() / (path.stem().string() + "." + a.what + ".vtkhdf");
  std::error_code ignored;
  if (std::filesystem::equivalent(out, path, ignored))
    return complain({"it is the trace itself", out.string(), "choose another --out"});
  const std::filesystem::path xdmf = std::filesystem::path(out).replace_extension(".xdmf");
  return say(core::write_view(trace.value(), request, out), xdmf);
}

}  // namespace

void add_view(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<ViewArguments>();
  CLI::App* command = program.add_subcommand("view", "Write what ParaView needs to play a trace");
  command->add_option("TRACE", a->trace, "A trace with recorded boxes (--record full)")->required();
  std::vector<std::string> names;
  names.reserve(std::size(kViews));
  for (const auto& row : kViews) names.emplace_back(row.first);
  command
      ->add_option("--what", a->what,
                   "boxes of the bodies; level1 or level2 boxes of the bodies' octrees; the bodies' meshes")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  command->add_option("--every", a->every, "Take every k-th recorded frame")
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command->add_option("--window", a->window, "Take only steps FIRST:LAST, such as 100:200");
  command->add_option(
      "--out", a->out,
      "File for the drawn geometry (default: beside the trace; all boxes of all frames need none, since the trace "
      "holds them). The XDMF file is written beside it");
  command->callback([a, &exit] { exit = view(*a); });
}

}  // namespace broadside::bench
