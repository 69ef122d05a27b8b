// A program with one section of its own. `medium.label` says how it ends, so that tests see each ending.

#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "common/error/machine.hpp"
#include "common/run/interruption.hpp"
#include "common/run/log.hpp"
#include "common/run/options.hpp"
#include "common/run/program.hpp"
#include "common/run/standard_streams.hpp"
#include "tests/errors/example_section.hpp"

using namespace toryu;

int main(int argc, char** argv) {
  return run_program("example_program", argc, argv, [](const Options& options) {
    CaseFile file(options.case_path, options.overrides);
    Scene scene = read_scene(file);
    Medium medium;
    file.read("medium", medium, "what fills the room");
    if (options.describe) {
      print(file.description());
      return ExitCode::done;
    }
    check_folder(file, options.out);
    file.throw_if_faulty();
    if (options.check) return ExitCode::done;
    log::info("runs to {} s with {} threads", scene.end_time, options.threads);
    if (medium.label == "physics") throw PhysicsFailure("medium", 7, 0.5, "speed", "12 m/s", "10 m/s");
    if (medium.label == "peer") throw PeerLost("solid_solver has not answered for 2 s");
    if (medium.label == "bug") throw std::out_of_range("index 3 of 2");
    if (medium.label == "disk") throw MachineFailure("cannot write 'a.csv'", ENOSPC);
    if (medium.label == "folder") std::filesystem::create_directory(options.out / "absent/a");
    if (medium.label == "library") std::exit(1);  // as libgomp does where it gets no threads
    if (medium.label == "interrupted") {
      std::raise(SIGTERM);
      throw_if_interrupted();
    }
    if (medium.label == "warning") log::warn("the medium is thin");
    return ExitCode::done;
  });
}
