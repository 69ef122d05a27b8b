// Exit codes, standard output, standard error and log of a real program, for good and bad command lines.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "common/case/document.hpp"
#include "common/run/provenance.hpp"

namespace toryu {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string sound_case =
    "[case]\ntitle = 'A'\nend_time = 1\ndomain = {min=[0,0], max=[2,2]}\n[medium]\ndensity = 1000\n";

class ExampleProgram : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("toryu_program_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_ / "room");
    std::ofstream(folder_ / "room/case.toml") << sound_case;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  struct Ending {
    int code;
    std::string output, error;
  };
  /// `arguments` may redirect streams.
  Ending run(const std::string& arguments) const {
    const int status = shell("{ '" EXAMPLE_PROGRAM "' " + arguments + "; } >output.txt 2>error.txt");
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of("output.txt"), text_of("error.txt")};
  }
  /// The exit code where all that is said goes into a pipe that nobody reads.
  std::string code_unread(const std::string& arguments) const {
    shell("{ sleep 0.1; '" EXAMPLE_PROGRAM "' " + arguments + " 2>&1; echo $? >code.txt; } | true");
    return text_of("code.txt");
  }
  int shell(const std::string& command) const {
    return std::system(("cd '" + folder_.string() + "' && " + command).c_str());
  }
  std::string text_of(const std::string& file) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / file).rdbuf();
    return text.str();
  }
  std::filesystem::path folder_;
};

TEST_F(ExampleProgram, EndsWellInSilence) {
  const Ending ending = run("room");
  EXPECT_EQ(ending.code, 0);
  EXPECT_EQ(ending.output + ending.error, "");
  EXPECT_THAT(text_of("out/room/log.txt"), HasSubstr(" example_program info: runs to 1 s with 0 threads\n"));
}

TEST_F(ExampleProgram, TakesOptions) {
  const Ending ending = run("room/case.toml --out here --end-time 0.25 --threads 2 --set medium.steps=3");
  EXPECT_EQ(ending.code, 0) << ending.error;
  EXPECT_THAT(text_of("here/log.txt"), HasSubstr("runs to 0.25 s with 2 threads"));
}

TEST_F(ExampleProgram, LogsWhatRan) {
  EXPECT_EQ(run("room --set medium.steps=3 --end-time 0.5").code, 0);
  const std::string log = text_of("out/room/log.txt");
  EXPECT_THAT(log, HasSubstr("info: toryu " + provenance(1).version + " (commit "));
  EXPECT_THAT(log,
              HasSubstr("info: case room/case.toml with --set medium.steps=3 --set case.end_time=0.5\n"));
}

TEST_F(ExampleProgram, KeepsTheCaseApartFromOverridesBeforeIt) {
  EXPECT_EQ(run("--set medium.wind=[1,2] --set medium.steps=3 room").code, 0);
}

TEST_F(ExampleProgram, ChecksWithoutLeavingAnything) {
  const Ending ending = run("room --check");
  EXPECT_EQ(ending.code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(ExampleProgram, ListsFaultsOfTheCase) {
  const Ending ending = run("room --set case.end_time=-1 --set medium.densty=1 --check");
  EXPECT_EQ(ending.code, 2);
  EXPECT_EQ(ending.error,
            "--set case.end_time=-1: error: 'end_time' in [case] must be above 0 [s], found -1\n"
            "--set medium.densty=1: error: unknown key 'densty' in [medium]; did you mean 'density'?\n");
}

TEST_F(ExampleProgram, WritesFaultsToTheLogToo) {
  EXPECT_EQ(run("room --set medium.steps=0").code, 2);
  EXPECT_THAT(text_of("out/room/log.txt"),
              HasSubstr("example_program error: --set medium.steps=0: error: 'steps' in [medium] must be at "
                        "least 1, found 0\n"));
}

TEST_F(ExampleProgram, ListsAllFaultsOfTheCommandLine) {
  const Ending ending = run("rom --ouy here --threads few --log-level wrn --chek");
  EXPECT_EQ(ending.code, 2);
  EXPECT_EQ(
      ending.error,
      "--ouy: error: unknown option; did you mean '--out'?\n"
      "--chek: error: unknown option; did you mean '--check'?\n"
      "--threads few: error: must be an integer of at least 0\n"
      "--log-level wrn: error: must be one of 'trace', 'debug', 'info', 'warn', 'error', 'off'; did you "
      "mean 'warn'?\n"
      "rom: error: no such file or folder\n");
}

TEST_F(ExampleProgram, RefusesOneArgumentTooMany) {
  EXPECT_EQ(run("room room").error, "room: error: one argument too many; there is one CASE\n");
}

TEST_F(ExampleProgram, RefusesAnOptionWithAnEmptyValue) {
  EXPECT_EQ(run("room --out= --check").error, "--out=: error: has no value\n");
  EXPECT_EQ(run("room --end-time= --check").error, "--end-time=: error: has no value\n");
  EXPECT_EQ(run("room --secure '' --check").error, "--secure '': error: has no value\n");
  EXPECT_EQ(run("'' --check").error, "'': error: has no value\n");
}

TEST_F(ExampleProgram, RefusesAnOptionWithoutValue) {
  const Ending ending = run("room --out");
  EXPECT_EQ(ending.code, 2);
  EXPECT_EQ(ending.error, "example_program: error: --out: 1 required DIR missing\n");
}

TEST_F(ExampleProgram, RefusesHostsThatCannotBe) {
  EXPECT_EQ(run("room --peers a,,b --interface eth0/1 --domain 101 --lost-after 0.5").error,
            "--peers a,,b: error: must be names or IPv4 addresses of hosts, with commas between them\n"
            "--interface eth0/1: error: must be the name or the IPv4 address of a network interface\n"
            "--domain 101: error: must be an integer of 1 to 100\n"
            "--lost-after 0.5: error: must be a number of 1 to 3600 [s]\n");
  EXPECT_EQ(run("room --peers a,").error,
            "--peers a,: error: must be names or IPv4 addresses of hosts, with commas between them\n");
  EXPECT_EQ(run("room --peers 'a<b' --domain 7x --lost-after nan").error,
            "--peers a<b: error: must be names or IPv4 addresses of hosts, with commas between them\n"
            "--domain 7x: error: must be an integer of 1 to 100\n"
            "--lost-after nan: error: must be a number of 1 to 3600 [s]\n");
  EXPECT_EQ(run("room --interface eth0").error,
            "--interface eth0: error: without --peers a run is on this machine alone, and takes no other "
            "than lo\n");
}

TEST_F(ExampleProgram, RefusesLessThanNoThread) {
  EXPECT_EQ(run("room --threads -1").error, "--threads -1: error: must be an integer of at least 0\n");
  EXPECT_EQ(run("room --threads 1x").error, "--threads 1x: error: must be an integer of at least 0\n");
}

TEST_F(ExampleProgram, TellsANameWithoutWhatATerminalWouldObey) {
  EXPECT_EQ(run("room --set 'medium.density=\x1b[2J' --check").error,
            "--set medium.density=\\x1b[2J: error: 'density' in [medium] must be a number [kg/m3] above 0, "
            "found the "
            "text \"\\x1b[2J\"\n");
}

TEST_F(ExampleProgram, WantsACase) {
  EXPECT_EQ(run("").error, "example_program: error: no CASE given; see --help\n");
  EXPECT_EQ(run("").code, 2);
}

TEST_F(ExampleProgram, TakesANegativeEndTimeForAFaultOfTheCase) {
  EXPECT_EQ(run("room --end-time -1 --check").error,
            "--set case.end_time=-1: error: 'end_time' in [case] must be above 0 [s], found -1\n");
}

TEST_F(ExampleProgram, DescribesWithAndWithoutACase) {
  const Ending without = run("--describe"), with = run("room --describe");
  EXPECT_EQ(without.code, 0);
  EXPECT_EQ(without.output, with.output);
  EXPECT_THAT(without.output, HasSubstr("[medium.drag]  (optional)"));
}

TEST_F(ExampleProgram, PrintsTheCaseAsItIsRead) {
  std::ofstream(folder_ / "room/half.toml") << "base = 'case.toml'\nother = false\n[medium]\nsteps = 2\n";
  const Ending ending = run("room/half.toml --print-case --set medium.label=thin --end-time 0.25");
  EXPECT_EQ(ending.code, 0) << ending.error;
  const toml::table printed = parse_document(ending.output, "printed");
  EXPECT_EQ(printed, parse_document("other = false\n"
                                    "[case]\ntitle = 'A'\nend_time = 0.25\ndomain = {min=[0,0], max=[2,2]}\n"
                                    "[medium]\ndensity = 1000\nsteps = 2\nlabel = 'thin'\n",
                                    "expected"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(ExampleProgram, PrintsNoCaseThatCannotBeRead) {
  const Ending ending = run("room --print-case --set medium.density.more=1 --set case");
  EXPECT_EQ(ending.code, 2);
  EXPECT_EQ(ending.output, "");
  EXPECT_EQ(ending.error,
            "--set medium.density.more=1: error: 'medium.density' is the number 1000, not a section with a "
            "key 'more'\n"
            "--set case: error: expected section.key=value\n");
  EXPECT_EQ(run("--print-case").error, "example_program: error: no CASE given; see --help\n");
}

TEST_F(ExampleProgram, SaysItsVersion) {
  const Ending ending = run("--version");
  EXPECT_EQ(ending.code, 0);
  EXPECT_THAT(ending.output, StartsWith("example_program of toryu " + provenance(1).version + " (commit "));
}

TEST_F(ExampleProgram, Helps) {
  const Ending ending = run("--help");
  EXPECT_EQ(ending.code, 0);
  for (const char* option :
       {"CASE", "--out DIR", "--set SECTION.KEY=VALUE", "--end-time SECONDS", "--threads N",
        "--log-level LEVEL", "--check", "--describe", "--print-case", "--version"})
    EXPECT_THAT(ending.output, HasSubstr(option));
}

struct Failure {
  std::string label;
  int code;
  std::string error;
};

TEST_F(ExampleProgram, EndsEachFailureWithItsCodeAndOneLine) {
  const std::vector<Failure> failures = {
      {"physics", 3, "physics failed: medium particle 7 at t = 0.5 s: speed = 12 m/s, limit 10 m/s"},
      {"peer", 4, "peer lost: solid_solver has not answered for 2 s"},
      {"disk", 5,
       "the machine: cannot write 'a.csv': No space left on device; make room on the disk (df -h and df -i "
       "show it), or give --out a folder on another"},
      {"folder", 5,
       "the machine: 'folder/absent/a' cannot be used: No such file or directory; the folder was removed or "
       "moved in mid-run; leave it where it is until the run has ended"},
      {"library", 5,
       "the machine: OpenMP gets no threads: give --threads fewer, or raise 'ulimit -u' and 'ulimit -v'"},
      {"interrupted", 130, "interrupted"},
      {"bug", 1, "unexpected: index 3 of 2"}};
  for (const auto& failure : failures) {
    const Ending ending = run("room --out " + failure.label + " --set medium.label=" + failure.label);
    EXPECT_EQ(ending.code, failure.code);
    EXPECT_EQ(ending.error, "example_program: error: " + failure.error + "\n");
    EXPECT_THAT(text_of(failure.label + "/log.txt"),
                HasSubstr("example_program error: " + failure.error + "\n"));
  }
}

TEST_F(ExampleProgram, DoesNotDependOnWhoReads) {
  const std::string warns = "room --out read --set medium.label=warning ";
  for (const char* streams : {"0<&- >&- 2>&-", ">/dev/full 2>/dev/full"}) {
    EXPECT_EQ(run(warns + streams).code, 0) << streams;
    EXPECT_THAT(text_of("read/log.txt"), HasSubstr("example_program warning: the medium is thin\n"));
    std::filesystem::remove(folder_ / "read/log.txt");
  }
  EXPECT_EQ(code_unread(warns), "0\n");
  EXPECT_EQ(code_unread("absent"), "2\n");
}

TEST_F(ExampleProgram, SaysThatWhatWasAskedForCannotBeWritten) {
  for (const char* asked : {"--describe", "--help", "--version", "room --print-case"}) {
    const Ending ending = run(std::string(asked) + " >/dev/full");
    EXPECT_EQ(ending.code, 5) << asked;
    EXPECT_THAT(ending.error, HasSubstr("cannot write to standard output: No space left on device; "));
    EXPECT_EQ(code_unread(asked), "0\n") << "who went away has read enough";
  }
}

TEST_F(ExampleProgram, RefusesAPathThatCannotBeOne) {
  const std::string longest(300, 'a');
  EXPECT_EQ(run(longest).error, longest + ": error: cannot be read: File name too long\n");
  EXPECT_EQ(run(longest).code, 2);
  EXPECT_EQ(run("room --out " + longest).code, 2);
}

TEST_F(ExampleProgram, WarnsOnStandardError) {
  const Ending ending = run("room --set medium.label=warning");
  EXPECT_EQ(ending.code, 0);
  EXPECT_EQ(ending.error, "example_program: warning: the medium is thin\n");
}

}  // namespace
}  // namespace toryu
