#include "common/run/program.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cstdlib>

#include "common/case/case_file.hpp"
#include "common/error/ending.hpp"
#include "common/error/printable.hpp"
#include "common/run/interruption.hpp"
#include "common/run/log.hpp"
#include "common/run/options.hpp"
#include "common/run/provenance.hpp"
#include "common/run/standard_streams.hpp"
#include "common/run/team.hpp"
#include "common/scene/resolved_case.hpp"

namespace toryu {

namespace {

void log_start(const Options& options) {
  const Provenance made = provenance(options.threads);
  log::info("toryu {} (commit {}, {}, {}) on {}", made.version, made.commit, made.compiler, made.flags,
            made.cpu);
  log::info("case {}{}{}", options.case_path.string(), options.overrides.empty() ? "" : " with --set ",
            fmt::join(options.overrides, " --set "));
}

const char* words_for(ExitCode code) {
  switch (code) {
    case ExitCode::physics_failed:
      return "physics failed: ";
    case ExitCode::peer_lost:
      return "peer lost: ";
    case ExitCode::machine:
      return "the machine: ";
    case ExitCode::bug:
      return "unexpected: ";
    default:
      return "";
  }
}

/// Runs the body; what it throws ends in one line and an exit code.
ExitCode guarded(const std::function<ExitCode()>& body) {
  try {
    return body();
  } catch (...) {
    const auto [code, raw_reason] = ending_of_exception();
    const std::string reason = printable(raw_reason);
    if (code == ExitCode::bad_input) {
      // Standard error shows the bare lines, as a compiler does, so that editors find the places.
      tell(reason + '\n');
      log_error_to_file(reason);
    } else {
      log::error("{}{}", words_for(code), reason);
    }
    return code;
  }
}

/// libgomp ends the program by itself where it gets no thread, and says why on standard error.
void tell_of_exit_of_library() {
  log::error(
      "the machine: OpenMP gets no threads: give --threads fewer, or raise 'ulimit -u' and 'ulimit -v'");
  std::_Exit(static_cast<int>(ExitCode::machine));
}
bool within_program = false;

}  // namespace

int run_program(const std::string& role, int argc, char** argv,
                const std::function<ExitCode(const Options&)>& body, CanCheckpoint can_checkpoint) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto given = [&](const char* option) {
    return std::find(arguments.begin(), arguments.end(), option) != arguments.end();
  };
  secure_standard_streams();
  open_log(role, "", "info");
  omp_set_num_threads(useful_threads(omp_get_max_threads()));
  within_program = true;
  std::atexit([] {
    if (within_program) tell_of_exit_of_library();
  });
  const ExitCode code = guarded([&] {
    if (given("--help")) {
      print(help_text(role));
      return ExitCode::done;
    }
    if (given("--version")) {
      const Provenance made = provenance(1);
      print(fmt::format("{} of toryu {} (commit {}, {})\n", role, made.version, made.commit, made.compiler));
      return ExitCode::done;
    }
    if (given("--can-checkpoint")) {
      print(can_checkpoint == CanCheckpoint::yes ? "yes\n" : "no\n");
      return ExitCode::done;
    }
    const Options options = parse_options(role, arguments);
    if (options.print_case) {
      print(CaseFile(options.case_path, options.overrides).merged() + '\n');
      return ExitCode::done;
    }
    if (options.resolved) {
      CaseFile file(options.case_path, options.overrides);
      print(resolved_case(file) + '\n');
      return ExitCode::done;
    }
    const bool computes = !options.check && !options.describe;
    open_log(role, computes ? options.out : "", options.log_level);
    if (computes) {
      log_start(options);
      catch_interruptions();
    }
    return body(options);
  });
  within_program = false;
  return static_cast<int>(code);
}

}  // namespace toryu
