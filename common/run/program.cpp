#include "common/run/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "common/case/case_file.hpp"
#include "common/run/interruption.hpp"
#include "common/run/log.hpp"
#include "common/run/options.hpp"
#include "common/run/provenance.hpp"

namespace toryu {

namespace {

void log_start(const Options& options) {
  const Provenance made = provenance(options.threads);
  log::info("toryu {} (commit {}, {}, {}) on {}", made.version, made.commit, made.compiler, made.flags,
            made.cpu);
  log::info("case {}{}{}", options.case_path.string(), options.overrides.empty() ? "" : " with --set ",
            fmt::join(options.overrides, " --set "));
}

/// Runs the body; what it throws ends in one line and an exit code.
ExitCode guarded(const std::function<ExitCode()>& body) {
  try {
    return body();
  } catch (const BadInput& error) {
    // Standard error shows the bare lines, as a compiler does, so that editors find the places.
    fmt::print(stderr, "{}\n", error.what());
    log_error_to_file(error.what());
    return ExitCode::bad_input;
  } catch (const PhysicsFailure& error) {
    log::error("physics failed: {}", error.what());
    return ExitCode::physics_failed;
  } catch (const PeerLost& error) {
    log::error("peer lost: {}", error.what());
    return ExitCode::peer_lost;
  } catch (const Interrupted& error) {
    log::error("{}", error.what());
    return ExitCode::interrupted;
  } catch (const std::bad_alloc&) {
    log::error("not enough memory for this case; a larger spacing needs less");
    return ExitCode::bad_input;
  } catch (const std::exception& error) {
    log::error("unexpected: {}", error.what());
    return ExitCode::bug;
  }
}

}  // namespace

int run_program(const std::string& role, int argc, char** argv,
                const std::function<ExitCode(const Options&)>& body, CanCheckpoint can_checkpoint) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto given = [&](const char* option) {
    return std::find(arguments.begin(), arguments.end(), option) != arguments.end();
  };
  open_log(role, "", "info");
  const ExitCode code = guarded([&] {
    if (given("--help")) {
      fmt::print("{}", help_text(role));
      return ExitCode::done;
    }
    if (given("--version")) {
      const Provenance made = provenance(1);
      fmt::print("{} of toryu {} (commit {}, {})\n", role, made.version, made.commit, made.compiler);
      return ExitCode::done;
    }
    if (given("--can-checkpoint")) {
      fmt::print("{}\n", can_checkpoint == CanCheckpoint::yes ? "yes" : "no");
      return ExitCode::done;
    }
    const Options options = parse_options(role, arguments);
    if (options.print_case) {
      fmt::print("{}\n", CaseFile(options.case_path, options.overrides).merged());
      return ExitCode::done;
    }
    const bool computes = !options.check && !options.describe;
    open_log(role, computes ? options.out : "", options.log_level);
    if (computes) log_start(options);
    catch_interruptions();
    return body(options);
  });
  return static_cast<int>(code);
}

}  // namespace toryu
