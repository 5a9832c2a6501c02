#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <climits>
#include <memory>
#include <string>

#include "bench/campaign/campaign_file.hpp"
#include "bench/campaign/manifest.hpp"
#include "bench/campaign/schedulers.hpp"
#include "bench/cli/commands.hpp"
#include "bench/record/run_plan.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench {
namespace {

// The path of this program, for the scripts that call it on other machines.
std::string program_path() {
  std::array<char, PATH_MAX> path{};
  const ssize_t length = readlink("/proc/self/exe", path.data(), path.size() - 1);
  return length > 0 ? std::string(path.data(), static_cast<std::size_t>(length)) : "broadside";
}

core::Exit plan(const std::string& file, const std::string& out) {
  auto campaign = campaign::read_campaign_file(file);
  if (!campaign) return complain(campaign.error());
  auto manifest = campaign::make_manifest(campaign.value());
  if (!manifest) return complain(manifest.error());
  const std::filesystem::path folder = std::filesystem::absolute(out);
  if (core::Status s = prepare_folder(folder); !s) return complain(s.error());
  if (core::Status s = campaign::write_manifest(folder, manifest.value()); !s) return complain(s.error());
  std::uint32_t timed = 0;
  for (const campaign::ManifestCell& cell : manifest.value().cells) timed += cell.work.repetitions > 0 ? 1 : 0;
  fmt::print("{} cells, {} of them timed: {}\n", manifest.value().cells.size(), timed,
             (folder / "manifest.json").string());
  fmt::print("  here: broadside run {} --shard 1/1\n", out);
  for (const campaign::Scheduler& scheduler : campaign::schedulers()) {
    const std::string text = scheduler.text(manifest.value(), folder, program_path());
    if (core::Status s = core::write_whole_file(folder / scheduler.file, text); !s) return complain(s.error());
    fmt::print("  {}: {}\n", scheduler.name, scheduler.use);
  }
  return core::Exit::kGood;
}

}  // namespace

void add_plan(CLI::App& program, core::Exit& exit) {
  CLI::App* command = program.add_subcommand("plan", "Plan a campaign of many cells, for this machine or a cluster");
  auto file = std::make_shared<std::string>();
  auto out = std::make_shared<std::string>("out/campaign");
  command
      ->add_option("CAMPAIGN", *file,
                   "A .toml file: scenes, engines and values to vary, or experiments of the paper "
                   "(bench/campaign/README.md)")
      ->required();
  command->add_option("--out", *out, "The campaign's folder, on a file system that every node sees")
      ->capture_default_str();
  command->callback([file, out, &exit] { exit = plan(*file, *out); });
}

}  // namespace broadside::bench
