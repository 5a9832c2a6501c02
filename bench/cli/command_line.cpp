#include "bench/cli/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "bench/build_facts.hpp"
#include "bench/cli/commands.hpp"
#include "bench/process/interrupt.hpp"
#include "core/nearest_name.hpp"

namespace broadside::bench {
namespace {

// One command on each line, so that two changes that each add one do not conflict.
constexpr AddCommand kCommands[] = {
    add_list,             //
    add_run,              //
    add_agree,            //
    add_pairs,            //
    add_candidates,       //
    add_check,            //
    add_converge,         //
    add_time,             //
    add_report,           //
    add_compare,          //
    add_bisect,           //
    add_history,          //
    add_demo,             //
    add_fetch,            //
    add_fetch_engine,     //
    add_recover,          //
    add_describe_plugin,  //
    add_diff,             //
    add_replay,           //
    add_shrink,           //
    add_plan,             //
    add_merge,            //
    add_mutants,          //
    add_view,             //
    add_paper,            //
    add_contest,          //
    add_mesh,             //
    add_scene,            //
    add_export,           //
};

std::vector<std::string> subcommands(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

bool knows_subcommand(const CLI::App& program, const std::string& name) {
  const std::vector<std::string> names = subcommands(program);
  return std::find(names.begin(), names.end(), name) != names.end();
}

core::Error unknown_subcommand(const CLI::App& program, const std::string& typed) {
  const std::vector<std::string> names = subcommands(program);
  const std::vector<std::string_view> views(names.begin(), names.end());
  return {"unknown subcommand '" + typed + "'", "command line", core::advise_name(typed, views, "broadside --help")};
}

// An error when the first argument names no subcommand. It is checked here, because CLI11 would only say that a
// subcommand is missing.
core::Status known_first(const CLI::App& program, const std::string& first) {
  if (first.starts_with('-')) {
    if (program.get_option_no_throw(first.substr(0, first.find('='))) != nullptr) return core::Done{};
    return core::Error{"unknown option '" + first + "'", "command line", "see broadside --help"};
  }
  if (knows_subcommand(program, first)) return core::Done{};
  return unknown_subcommand(program, first);
}

// An error in the arguments after a subcommand says which help explains them.
core::Error wrong_argument(const CLI::App& program, const std::string& first, const char* what) {
  if (!knows_subcommand(program, first)) return {what, "command line", "see broadside --help"};
  return {what, first, "see broadside " + first + " --help"};
}

core::Exit parse_and_run(int argc, char** argv) {
  CLI::App program{
      "Runs collision engines side by side on identical scenes, proves what each got right, and times only "
      "what it proved.\n\n"
      "First:  broadside demo                                  then open out/demo/report.html in a browser\n"
      "Then:   broadside list engines                          also: list scenes, list validators\n"
      "        broadside run SCENE --engine ENGINE --out DIR   records a trace; your engine: --engine ./libmine.so\n"
      "        broadside check DIR/*.h5 --json DIR/verdicts.json\n"
      "        broadside time SCENE --engine ENGINE --out DIR/samples.json\n"
      "        broadside report DIR --html DIR/report.html     the page of these\n",
      "broadside"};
  program.require_subcommand(1);
  program.set_version_flag("--version", build_line);
  program.footer(
      "Exit codes: 0 good; 1 a validator failed or a regression; 2 bad usage or bad input; 3 inconclusive or a\n"
      "cell that was asked for is missing; 4 internal. 'broadside SUBCOMMAND --help' explains each.\n"
      "Environment: BROADSIDE_MESH_DIR, a folder with mesh files; BROADSIDE_HELLO_LIMIT_S, seconds that an engine of\n"
      "yours may take to describe itself (default: 10).");
  core::Exit exit = core::Exit::kGood;
  for (const AddCommand add : kCommands) add(program, exit);
  if (argc < 2)
    return complain({"no subcommand", "command line",
                     "begin with 'broadside demo', which leaves out/demo/report.html, or see broadside --help"});
  if (const auto known = known_first(program, argv[1]); !known) return complain(known.error());
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    program.exit(help);
  } catch (const CLI::CallForAllHelp& help) {
    program.exit(help);
  } catch (const CLI::CallForVersion& version) {
    program.exit(version);
  } catch (const CLI::ParseError& error) {
    return complain(wrong_argument(program, argv[1], error.what()));
  }
  return exit;
}

}  // namespace

core::Exit complain(const core::Error& error) {
  fmt::print(stderr, "broadside: {}\n", error.line());
  return error.exit;
}

int run_command_line(int argc, char** argv) {
  watch_for_interrupt();
  const auto gave_up = [](const char* what, const char* where, const char* advice) {
    return static_cast<int>(complain({what, where, advice, core::Exit::kInternal}));
  };
  constexpr const char* kLess = "fewer bodies or frames, or a larger machine";
  try {
    return static_cast<int>(parse_and_run(argc, argv));
  } catch (const std::bad_alloc&) {
    return gave_up("out of memory", "this run", kLess);
  } catch (const std::system_error& error) {
    // This is the system's message when there is no memory for a thread's stack.
    if (error.code() == std::errc::resource_unavailable_try_again)
      return gave_up("out of memory: no room for another thread", "this run", kLess);
    return gave_up(error.what(), "internal error", "please report it with the command");
  } catch (const std::exception& error) {
    return gave_up(error.what(), "internal error", "please report it with the command");
  }
}

}  // namespace broadside::bench
