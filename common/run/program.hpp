/// What the three programs share: options, log, interruption, exit codes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/case/case_file.hpp"
#include "common/run/failure.hpp"

namespace toryu {

struct Options {
  std::filesystem::path case_path;     ///< the case file; empty for `describe` without a case
  std::filesystem::path out;           ///< default: out/<case name>
  std::vector<std::string> overrides;  ///< --set section.key=value, and --end-time as one of them
  int threads = 0;                     ///< 0: all cores
  std::string log_level = "info";
  bool check = false;     ///< read and check the case, then end
  bool describe = false;  ///< print the parameters, then end
};

/// Parses a command line without the program's name; `--version` and `--help` are not among them. Throws
/// BadInput with all that is wrong.
Options parse_options(const std::string& role, const std::vector<std::string>& arguments);
/// The text of `--help`.
std::string help_text(const std::string& role);

/// Parses the command line, sets up the log (in `out`, unless the case is only checked or described), runs
/// `body` and turns what it throws into an exit code and one line on standard error and in the log.
/// `--version`, `--help` and wrong options end here. `role` is the program's name: "fluid_solver".
int run_program(const std::string& role, int argc, char** argv,
                const std::function<ExitCode(const Options&)>& body);

/// Writes to `log.txt` in `out` (appended, lines tagged with time and role, each line whole even if several
/// processes write at once) and, from warnings on, to standard error. With an empty `out` there is no file.
/// All code logs by spdlog's default logger.
void open_log(const std::string& role, const std::filesystem::path& out, const std::string& level);
/// Writes an error to the log file alone, for what standard error shows in another form.
void log_error_to_file(const std::string& message);

/// From now on SIGINT and SIGTERM only ask to stop.
void catch_interruptions();
/// True once SIGINT or SIGTERM came.
bool interruption_requested();
/// Throws Interrupted if so; call it once a step.
void throw_if_interrupted();

/// Version, commit, compiler, flags, processor: what made the numbers.
struct Provenance {
  std::string version, commit, compiler, flags, cpu;
  int threads = 1;
};
Provenance provenance(int threads);

}  // namespace toryu
