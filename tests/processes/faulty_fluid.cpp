/// A fluid that behaves for some windows and then has the fault that the environment variable FAULT names,
/// for the tests of what the others make of it.
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

#include "common/case/case_file.hpp"
#include "common/link/participant.hpp"
#include "common/run/options.hpp"
#include "common/run/program.hpp"
#include "common/run/provenance.hpp"
#include "common/state/checkpoint.hpp"

namespace {

using namespace toryu;

constexpr const char* role = "faulty_fluid";
constexpr std::uint64_t good_windows = 50;
constexpr double time_step_limit = 1e-4;  // [s]

/// Faults that need no message.
void fail(const std::string& fault, double time) {
  if (fault == "physics") throw PhysicsFailure("fluid", 7, time, "speed", "99 m/s", "10 m/s");
  if (fault == "bug") throw std::logic_error("index out of range");
  if (fault == "vanish") _exit(0);
  if (fault == "hang") std::this_thread::sleep_for(std::chrono::hours(1));
}

/// Faults in a checkpoint; the fluid has no state.
void write_checkpoint(const std::string& fault, const std::filesystem::path& folder) {
  if (fault == "full checkpoint") throw std::runtime_error("no space left");
  if (fault == "slow checkpoint") std::this_thread::sleep_for(std::chrono::milliseconds(600));
  write_part(folder, "fluid", {role}, [](std::ostream&) {});
}

/// Faults in what is sent.
void spoil(const std::string& fault, InterfaceLoad& load, double& limit) {
  if (fault == "value") load.force.back() = std::numeric_limits<double>::quiet_NaN();
  if (fault == "count") load.pressure.pop_back();
  if (fault == "limit") limit = -1;
  if (fault == "impulse") load.impulse_on_fluid.x() *= 1.001;
}

ExitCode run(const Options& options) {
  const char* variable = std::getenv("FAULT");
  const std::string fault = variable == nullptr ? "" : variable;
  const CaseFile file(options.case_path, options.overrides);
  FluidLink link({.role = role,
                  .version = provenance(1).version,
                  .out = options.out,
                  .network = options.network,
                  .case_hash = file.hash(),
                  .can_checkpoint = fault.ends_with("checkpoint")});
  if (fault == "before joining") _exit(0);
  try {
    const Interface interface = link.join({.reach = 0.005, .time_step_limit = time_step_limit});
    while (const auto turn = link.next_turn()) {
      if (turn->task == Task::checkpoint) {
        link.confirm_checkpoint([&] { write_checkpoint(fault, turn->checkpoint); });
        continue;
      }
      InterfaceLoad load;
      load.pressure.assign(interface.size(), 1.0);
      load.force.assign(dim * interface.size(), 1.0);
      load.impulse_on_fluid.setConstant(-turn->dt * static_cast<double>(interface.size()));
      double limit = time_step_limit;
      if (turn->number > good_windows) {
        fail(fault, turn->time);
        spoil(fault, load, limit);
      }
      link.send(load, limit, Health{});
    }
  } catch (...) {
    link.leave();
    throw;
  }
  return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program(role, argc, argv, run);
}
