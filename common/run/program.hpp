/// What the three programs share: options, log, interruption, exit codes.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/case/case_file.hpp"
#include "common/run/failure.hpp"

namespace toryu {

struct Options {
  std::filesystem::path case_path;
  std::filesystem::path out;           ///< default: out/<case name>
  std::vector<std::string> overrides;  ///< --set key=value
  std::optional<double> end_time;      ///< --end-time [s]
  std::optional<std::filesystem::path> restart;
  int threads = 0;  ///< 0: all cores
  std::string log_level = "info";
  bool check = false;
  bool describe = false;
};

/// Parses the command line, sets up the log, runs `body` and turns what it throws into an exit code and one
/// line on standard error and in the log. `--version`, `--help` and wrong options end here. `role` is the
/// program's name: "fluid_solver".
int run_program(const std::string& role, int argc, char** argv,
                const std::function<ExitCode(const Options&)>& body);

/// Writes to `log.txt` in `out` (appended, lines tagged with time and role) and, from warnings on, to stderr.
/// All code logs by spdlog's default logger.
void open_log(const std::string& role, const std::filesystem::path& out, const std::string& level);

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
