/// A program of protocol 2, for the tests of what those of today make of it: the fluid or the coupler of a
/// run, as the environment variable PART says, which introduces itself and waits.
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "common/link/dds.hpp"
#include "common/link/wire.hpp"
#include "common/run/interruption.hpp"
#include "common/run/options.hpp"
#include "common/run/program.hpp"
#include "messages_2.h"

namespace {

using namespace toryu;
using namespace std::chrono_literals;

std::string program = "outdated_peer", nothing, units = wire::units;

[[noreturn]] void wait() {
  for (;;) {
    throw_if_interrupted();
    std::this_thread::sleep_for(50ms);
  }
}

void play_fluid(dds::Node& node) {
  const auto writer = node.make_writer(toryu_2_Hello_desc, wire::hello_from_fluid);
  toryu_2_Hello hello{};
  hello.sender = dds::random_id();
  hello.role = toryu_2_FLUID;
  hello.program = program.data();
  hello.version = nothing.data();
  hello.protocol = 2;
  hello.units = units.data();
  hello.dimension = dim;
  hello.used_case = nothing.data();
  dds::require(dds_write(writer, &hello), wire::hello_from_fluid);
  wait();
}

void play_coupler(dds::Node& node) {
  const auto writer = node.make_writer(toryu_2_Session_desc, wire::session);
  toryu_2_Session session{};
  session.session_id = dds::random_id();
  session.reason = nothing.data();
  dds::require(dds_write(writer, &session), wire::session);
  wait();
}

ExitCode run(const Options& options) {
  const char* part = std::getenv("PART");
  dds::Node node(dds::rendezvous(options.out), {program, "fluid"});
  if (part != nullptr && part == std::string("coupler")) play_coupler(node);
  play_fluid(node);
  return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("outdated_peer", argc, argv, run);
}
