// The command as a user calls it: small git repositories whose commits are scripts, and lists of such scripts.
#include "bench/bisect/bisection.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "core/pair.hpp"
#include "core/rows.hpp"
#include "core/trace/trace_reader.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string program_path() {
  const char* program = std::getenv("BROADSIDE_PROGRAM");
  return program == nullptr ? "broadside" : program;
}

void write_script(const fs::path& file, const std::string& text) {
  std::ofstream(file) << "#!/bin/sh\n" << text;
  fs::permissions(file, fs::perms::owner_all);
}

// The engine's label without its settings.
constexpr const char* kOneLabel =
    "for rows in \"$1\"/cells.json \"$1\"/verdicts.json; do [ ! -f \"$rows\" ] ||\n"
    "  sed -i 's/\"settings_short\":\"[^\"]*\"/\"settings_short\":\"\"/' \"$rows\"\ndone\n";

// A build: records and judges errata:E3 with some settings of the engine. Its label leaves the settings out, as the
// label of an edited engine would. Each run appends a line to the log; the text `before` is run first.
std::string build_text(const std::string& settings, const fs::path& log, const std::string& before = "") {
  return before + "echo run >> '" + log.string() + "'\nset -e\n'" + program_path() +
         "' run errata:E3 --engine 'octree-cpu[" + settings + "]' --frames 20 --out \"$1\"\n'" + program_path() +
         "' check \"$1\"/*.h5 --json \"$1\"/verdicts.json || [ $? -eq 1 ]\n" + kOneLabel;
}

constexpr const char* kSound = "levels=C";
constexpr const char* kMoreTests = "levels=A";                 // other counters, the same bits
constexpr const char* kWrong = "levels=A,variant=printed-E3";  // breaks center-of-mass

// A git repository with one commit a call.
class Repository {
 public:
  explicit Repository(fs::path at) : at_(std::move(at)) {
    fs::create_directory(at_);
    git("init -q .");
  }
  void commit(const std::string& subject, const std::string& build, const std::string& sim) {
    write_script(at_ / "build.sh", build);
    write_script(at_ / "sim", sim);
    std::ofstream(at_ / "notes", std::ios::app) << subject << "\n";
    git("add -A && git -c user.name=t -c user.email=t@t -c commit.gpgsign=false commit -q -m '" + subject + "'");
  }
  void git(const std::string& words) const {
    ASSERT_EQ(std::system(("cd '" + at_.string() + "' && git " + words).c_str()), 0) << words;
  }
  [[nodiscard]] std::string path() const { return at_.string(); }

 private:
  fs::path at_;
};

std::size_t lines_of(const fs::path& file) {
  const std::string text = read_text(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

const json& answer_of(const json& result, const std::string& quantity) {
  for (const json& answer : result["answers"])
    if (answer["quantity"] == quantity) return answer;
  static const json kNone;
  return kNone;
}

std::string first_of(const json& result, const std::string& quantity) {
  const json& answer = answer_of(result, quantity);
  return answer.contains("first_changed") ? answer["first_changed"]["title"].get<std::string>().substr(8) : "none";
}

// Commits in this order: good, notes, more tests, two that do not build, one that builds again, a wrong one, notes.
void fill(Repository& repository, const fs::path& log) {
  const std::string good_build = "test -f sim && touch built\n";
  const std::string bad_build = "echo 'sim.c:3: error' >&2\nexit 2\n";
  repository.commit("good", good_build, build_text(kSound, log));
  repository.commit("a note", good_build, build_text(kSound, log));
  repository.commit("tests more boxes", good_build, build_text(kMoreTests, log));
  repository.commit("does not build", bad_build, build_text(kMoreTests, log));
  repository.commit("still does not build", bad_build, build_text(kMoreTests, log));
  repository.commit("builds again", good_build, build_text(kMoreTests, log));
  repository.commit("swaps the masses", good_build, build_text(kWrong, log));
  repository.commit("another note", good_build, build_text(kWrong, log));
}

std::vector<std::string> bisect(const std::string& good, const std::string& bad, const ScratchFolder& folder) {
  return {"bisect", good, bad, "--out", (folder / "out").string(), "--json", "--command", "{build}/sim {out}"};
}

TEST(Bisection, OfCommitsNamesTheFirstForEachQuantityWithBothSides) {
  const ScratchFolder folder;
  Repository repository(folder / "repository");
  fill(repository, folder / "log");
  std::vector<std::string> arguments = bisect("HEAD~7", "HEAD", folder);
  arguments.insert(arguments.end(), {"--build", "./build.sh", "--repository", repository.path()});
  const Ended ended = run_program(arguments);
  EXPECT_EQ(ended.exit_code, 1) << ended.out << ended.err;
  const json result = json::parse(ended.out);
  EXPECT_EQ(first_of(result, "counter"), "tests more boxes") << ended.out;
  EXPECT_EQ(first_of(result, "digest"), "swaps the masses") << ended.out;
  EXPECT_EQ(first_of(result, "verdict"), "swaps the masses") << ended.out;
  EXPECT_EQ(answer_of(result, "contacts")["ending"], "same") << "E3 moves bodies otherwise, and the same two touch";

  const json& verdict = answer_of(result, "verdict");
  EXPECT_EQ(verdict["last_unchanged"]["title"].get<std::string>().substr(8), "builds again");
  EXPECT_EQ(verdict["differences"][0]["subject"], "center-of-mass");
  EXPECT_EQ(verdict["differences"][0]["was"], "pass");
  EXPECT_EQ(verdict["differences"][0]["is"], "fail");
  for (const char* side : {"last_unchanged", "first_changed"})
    EXPECT_TRUE(fs::exists(verdict[side]["results"].get<std::string>() + "/verdicts.json")) << side;
  // The answer about digests is proved by the step at which the traces start to differ.
  EXPECT_NE(answer_of(result, "digest")["traces"].get<std::string>().find("step"), std::string::npos) << ended.out;
  EXPECT_NE(read_text(folder / "out" / "bisect.md").find("swaps the masses"), std::string::npos);

  // Nothing of the repository itself was touched.
  EXPECT_FALSE(fs::exists(repository.path() + "/built"));
  repository.git("diff --quiet HEAD");
  // The same call again runs nothing and gives the same answer.
  const std::size_t runs = lines_of(folder / "log");
  const Ended again = run_program(arguments);
  EXPECT_EQ(again.out, ended.out);
  EXPECT_EQ(lines_of(folder / "log"), runs);
}

// With the printed friction (E6) a pair separates earlier than with the sound one.
TEST(Bisection, OfContactsNamesTheStepAndAPair) {
  const ScratchFolder folder;
  for (const char* variant : {"sound", "printed-E6"})
    write_script(folder / variant, "'" + program_path() + "' run errata:E6 --engine 'octree-cpu[variant=" + variant +
                                       "]' --frames 60 --out \"$1\"\n" + kOneLabel);
  const Ended ended =
      run_program({"bisect", (folder / "sound").string(), (folder / "printed-E6").string(), "--on", "contacts", "--out",
                   (folder / "out").string(), "--json", "--command", "{build} {out}"});
  EXPECT_EQ(ended.exit_code, 1) << ended.out << ended.err;
  const json result = json::parse(ended.out);
  const json& difference = answer_of(result, "contacts")["differences"][0];
  // What each trace itself holds, read without the bisection.
  const std::string step = difference["subject"].get<std::string>().substr(17);
  EXPECT_NE(answer_of(result, "contacts")["traces"], "");
  std::vector<std::set<core::Pair>> touch;
  for (const char* build : {"0-sound/octree-cpu+variant=sound.h5", "1-printed-E6/octree-cpu+variant=printed-E6.h5"}) {
    fs::path file = folder / "out" / "builds" / build;
    if (!fs::exists(file)) file = file.parent_path() / "octree-cpu.h5";  // a default is not in the name
    const auto trace = core::TraceReader::open(file);
    ASSERT_TRUE(trace) << file;
    const auto frame = trace.value().read(std::stoull(step) - 1, core::bit(core::Group::kContacts));
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame.value().step, std::stoull(step));
    std::set<core::Pair>& pairs = touch.emplace_back();
    for (const core::Contact& contact : frame.value().contacts) pairs.insert(core::make_pair_of(contact.a, contact.b));
  }
  EXPECT_NE(touch[0], touch[1]) << step;
  EXPECT_EQ(difference["was"].get<std::string>().substr(0, 2), std::to_string(touch[0].size()) + " ") << ended.out;
  EXPECT_EQ(difference["is"].get<std::string>().substr(0, 2), std::to_string(touch[1].size()) + " ") << ended.out;
}

TEST(Bisection, CommitsThatDoNotBuildBesideTheChangeAreNamedAndLeaveItOpen) {
  const ScratchFolder folder;
  Repository repository(folder / "repository");
  const fs::path log = folder / "log";
  repository.commit("good", "exit 0\n", build_text(kSound, log));
  repository.commit("does not build", "echo 'sim.c:3: error: no such name' >&2\necho 'make: stop' >&2\nexit 2\n",
                    build_text(kWrong, log));
  repository.commit("bad", "exit 0\n", build_text(kWrong, log));
  const Ended ended =
      run_program({"bisect", "HEAD~2", "HEAD", "--out", (folder / "out").string(), "--command", "{build}/sim {out}",
                   "--build", "./build.sh", "--repository", repository.path(), "--on", "verdict"});
  EXPECT_EQ(ended.exit_code, 3) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("verdict: 2 builds may be the first that changes it"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("does not build: exit code 2: sim.c:3: error: no such name"), std::string::npos)
      << ended.out;
}

// The builds are scripts that exist already. The bisection is killed in the middle and then continued.
TEST(Bisection, AKilledOneGoesOnWhereItWas) {
  const ScratchFolder folder;
  const fs::path log = folder / "log";
  // The third run kills the bisection that started it.
  const std::string kill = "if [ -f '" + log.string() + "' ] && [ $(wc -l < '" + log.string() +
                           "') -eq 2 ]; then echo killed >> '" + log.string() +
                           "'; kill -9 $(cut -d ' ' -f 4 /proc/$PPID/stat); exit 1; fi\n";
  std::vector<std::string> arguments{"bisect"};
  const char* const settings[] = {kSound, kSound, kMoreTests, kMoreTests};
  std::vector<std::string> builds;
  for (const char* setting : settings) {
    builds.push_back((folder / ("build" + std::to_string(builds.size()))).string());
    write_script(builds.back(), build_text(setting, log, kill));
  }
  arguments.insert(arguments.end(), {builds[0], builds[3], "--between", builds[1], builds[2], "--on", "counter",
                                     "--out", (folder / "out").string(), "--json", "--command", "{build} {out}"});
  const Ended killed = run_program(arguments);
  EXPECT_EQ(killed.exit_code, -1);
  const Ended ended = run_program(arguments);
  EXPECT_EQ(ended.exit_code, 1) << ended.out << ended.err;
  EXPECT_NE(ended.err.find("continuing: 2 runs are already known"), std::string::npos) << ended.err;
  const json result = json::parse(ended.out);
  EXPECT_EQ(answer_of(result, "counter")["first_changed"]["title"], builds[2]);
  // Good, bad, the run that killed the bisection, good again, and the two builds between: no finished run is repeated.
  EXPECT_EQ(lines_of(log), 6U);
}

// Processes that a killed bisection started may still write into its folder, and git leaves a lock in a clone in which
// it was killed.
TEST(Bisection, OneWaitsForWhatAKilledOneStartedAndMendsItsClone) {
  const ScratchFolder folder;
  const fs::path log = folder / "log";
  Repository repository(folder / "repository");
  repository.commit("sound", "", "exit 0\n");
  repository.commit("broken", "", "exit 1\n");
  const std::string out = (folder / "out").string();
  const auto arguments = [&](const std::string& build) {
    return std::vector<std::string>{"bisect",  "HEAD~1", "HEAD",      "--repository", repository.path(),
                                    "--build", build,    "--on",      "exit",         "--out",
                                    out,       "--json", "--command", "{build}/sim"};
  };
  // The first build outlives the bisection, which it kills, by two seconds.
  const std::string build = "if [ ! -f '" + log.string() + "' ]; then touch .git/index.lock; echo killed > '" +
                            log.string() + "'; kill -9 $PPID; sleep 2; echo late >> '" + log.string() +
                            "'; exit 1; fi; sh ./build.sh; echo built >> '" + log.string() + "'";
  EXPECT_EQ(run_program(arguments(build)).exit_code, -1);
  const Ended ended = run_program(arguments(build));
  EXPECT_EQ(ended.exit_code, 1) << ended.out << ended.err;
  EXPECT_NE(ended.err.find("bisect: waiting for another bisect in "), std::string::npos) << ended.err;
  EXPECT_EQ(read_text(log).substr(0, 18), "killed\nlate\nbuilt\n") << read_text(log);
  // Another build command makes other builds.
  const Ended other = run_program(arguments("true"));
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("it holds a bisection of other builds"), std::string::npos) << other.err;
}

TEST(Bisection, AGoodBuildThatDiffersFromItselfIsNoBaseline) {
  const ScratchFolder folder;
  const fs::path log = folder / "log";
  // The third run is wrong, so the good build differs from itself.
  const std::string sound = build_text(kSound, log);
  const std::string wrong = build_text(kWrong, log);
  const std::string text =
      "if [ $(cat '" + log.string() + "' 2>/dev/null | wc -l) -eq 2 ]; then\n" + wrong + "else\n" + sound + "fi\n";
  write_script(folder / "a", text);
  write_script(folder / "b", wrong);
  const Ended ended = run_program({"bisect", (folder / "a").string(), (folder / "b").string(), "--on", "digest",
                                   "--out", (folder / "out").string(), "--command", "{build} {out}"});
  EXPECT_EQ(ended.exit_code, 3) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("digest: the good build differs from itself"), std::string::npos) << ended.out;
}

TEST(Bisection, ExitCodesOfAnyCommandAreEnough) {
  const ScratchFolder folder;
  for (int k = 0; k < 6; ++k)
    write_script(folder / std::to_string(k), k == 2 ? "exit 125\n" : k < 4 ? "exit 0\n" : "exit 7\n");
  std::vector<std::string> arguments{"bisect", (folder / "0").string(), (folder / "5").string()};
  for (int k = 1; k < 5; ++k) arguments.insert(arguments.end(), {"--between", (folder / std::to_string(k)).string()});
  arguments.insert(arguments.end(), {"--on", "exit", "--out", (folder / "out").string(), "--command", "{build}"});
  const Ended ended = run_program(arguments);
  EXPECT_EQ(ended.exit_code, 1) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("exit: the first build that changes it is " + (folder / "4").string()), std::string::npos)
      << ended.out;
  // There are no rows, so no other property can be compared.
  arguments[arguments.size() - 5] = "digest";
  const Ended rows = run_program(arguments);
  EXPECT_EQ(rows.exit_code, 3) << rows.out << rows.err;
  EXPECT_NE(rows.out.find("leaves no cells.json"), std::string::npos) << rows.out;
}

// The times are made by hand: samples of a real run, and the same half again as long.
TEST(Bisection, OfTimesUsesTheGateOfCompare) {
  const ScratchFolder folder;
  const std::string rows = (folder / "rows").string();
  ASSERT_EQ(run_program({"run", "errata:E4", "--frames", "20", "--engine", "octree-cpu", "--out", rows}).exit_code, 0);
  ASSERT_EQ(run_program({"check", rows + "/octree-cpu.h5", "--json", rows + "/verdicts.json"}).exit_code, 0);
  ASSERT_EQ(
      run_program({"time", "errata:E4", "--frames", "20", "--engine", "octree-cpu", "--out", rows + "/samples.json"})
          .exit_code,
      0);
  auto samples = core::read_samples(rows + "/samples.json");
  ASSERT_TRUE(samples);
  for (core::Sample& sample : samples.value())
    for (core::StageSeries& series : sample.stages)
      for (auto& seconds : series.seconds) seconds *= 1.5;
  ASSERT_TRUE(core::write_samples(folder / "slow.json", samples.value()));
  std::vector<std::string> arguments{"bisect", (folder / "0").string(), (folder / "4").string(), "--on", "time"};
  for (int k = 0; k < 5; ++k) {
    const std::string slow = k >= 3 ? "cp '" + (folder / "slow.json").string() + "' \"$1\"/samples.json\n" : "";
    write_script(folder / std::to_string(k), "cp '" + rows + "'/*.json \"$1\"\n" + slow);
    if (k > 0 && k < 4) arguments.insert(arguments.end(), {"--between", (folder / std::to_string(k)).string()});
  }
  arguments.insert(arguments.end(),
                   {"--processes", "7", "--out", (folder / "out").string(), "--json", "--command", "{build} {out}"});
  const Ended ended = run_program(arguments);
  EXPECT_EQ(ended.exit_code, 1) << ended.out << ended.err;
  const json result = json::parse(ended.out);
  const json& answer = answer_of(result, "time");
  EXPECT_EQ(answer["first_changed"]["title"], (folder / "3").string());
  EXPECT_EQ(answer["last_unchanged"]["title"], (folder / "2").string());
  EXPECT_EQ(answer["differences"][0]["is"].get<std::string>().substr(0, 5), "1.500") << ended.out;
}

// Given a scene, both programs are timed in turns. The delta is so large that one build cannot exceed it against
// itself.
TEST(Bisection, OfOneProgramUnderTwoNamesFindsNoChange) {
  const ScratchFolder folder;
  fs::create_symlink(program_path(), folder / "old");
  fs::copy_file(program_path(), folder / "new");
  const Ended ended = run_program({"bisect", (folder / "old").string(), (folder / "new").string(), "--scene",
                                   "errata:E4", "--frames", "20", "--on", "verdict,contacts,digest,counter,time",
                                   "--delta", "5", "--processes", "7", "--out", (folder / "out").string()});
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  for (const char* word : {"verdict", "contacts", "digest", "counter", "time"})
    EXPECT_NE(ended.out.find(std::string(word) + ": no change from"), std::string::npos) << ended.out;
}

TEST(Bisection, BadInputIsOneLine) {
  const ScratchFolder folder;
  const std::string out = (folder / "out").string();
  write_script(folder / "a", "exit 0\n");
  write_script(folder / "b", "exit 1\n");
  const std::string a = (folder / "a").string();
  const std::string b = (folder / "b").string();
  Repository repository(folder / "repository");
  repository.commit("one", "", "");
  repository.commit("two", "", "");
  const std::string at = repository.path();
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"bisect", a},
           {"bisect", a, b, "--out", out},
           {"bisect", a, b, "--out", out, "--command", "true"},
           {"bisect", a, b, "--out", out, "--command", "{build}", "--scene", "errata:E4"},
           {"bisect", a, b, "--out", out, "--command", "{build}", "--on", "colour"},
           {"bisect", a, (folder / "absent").string(), "--out", out, "--command", "{build}"},
           {"bisect", "HEAD~1", "HEAD", "--out", out, "--command", "{build}", "--build", "true", "--repository", a},
           {"bisect", "HEAD", "HEAD~1", "--out", out, "--command", "{build}", "--build", "true", "--repository", at},
           {"bisect", "HEAD", "HEAD", "--out", out, "--command", "{build}", "--build", "true", "--repository", at},
           {"bisect", "HEAD~9", "HEAD", "--out", out, "--command", "{build}", "--build", "true", "--repository", at}}) {
    const Ended ended = run_program(arguments);
    EXPECT_EQ(ended.exit_code, 2) << arguments.back() << ended.err;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  }
  // A folder holds one bisection.
  const std::vector<std::string> first{"bisect", a, b, "--out", out, "--on", "exit", "--command", "{build}"};
  EXPECT_EQ(run_program(first).exit_code, 1);
  const Ended other = run_program({"bisect", b, a, "--out", out, "--on", "exit", "--command", "{build}"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("it holds a bisection of other builds"), std::string::npos) << other.err;
  std::ofstream(folder / "out" / "bisect.json") << "{";
  EXPECT_NE(run_program(first).err.find("it is damaged"), std::string::npos);
}

}  // namespace
}  // namespace broadside::tests
