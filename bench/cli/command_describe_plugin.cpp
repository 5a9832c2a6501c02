// plugin_row runs this in a child process: it loads the library, or starts the program, and prints its description.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/cli/commands.hpp"
#include "reference/plugin/plugin_engine.hpp"

namespace broadside::bench {

void add_describe_plugin(CLI::App& program, core::Exit& exit) {
  // A command without a group is not listed in the help; for people there is `broadside list --engine FILE`.
  CLI::App* command = program.add_subcommand("describe-plugin", "Print as JSON what a plug-in says about itself");
  command->group("");
  auto file = std::make_shared<std::string>();
  command->add_option("FILE", *file, "shared library, or the command of a program")->required();
  command->callback([file, &exit] {
    const auto description = reference::describe_plugin(*file);
    if (!description) {
      exit = complain(description.error());
      return;
    }
    const reference::PluginDescription& d = description.value();
    nlohmann::json json{{"id", d.id},     {"capabilities", d.capabilities}, {"build", d.build},
                        {"what", d.what}, {"on_device", d.on_device},       {"settings", nlohmann::json::array()}};
    for (const auto& s : d.settings)
      json["settings"].push_back({{"key", s.key}, {"default", s.default_value}, {"what", s.what}});
    fmt::print("{}\n", json.dump());
  });
}

}  // namespace broadside::bench
