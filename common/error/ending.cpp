#include "common/error/ending.hpp"

#include <new>

#include "common/error/machine.hpp"

namespace toryu {

Ending ending_of_exception() noexcept {
  try {
    throw;
  } catch (const BadInput& failure) {
    return {ExitCode::bad_input, failure.what()};
  } catch (const PhysicsFailure& failure) {
    return {ExitCode::physics_failed, failure.what()};
  } catch (const PeerLost& failure) {
    return {ExitCode::peer_lost, failure.what()};
  } catch (const Interrupted& failure) {
    return {ExitCode::interrupted, failure.what()};
  } catch (const MachineFailure& failure) {
    return {ExitCode::machine, failure.what()};
  } catch (const std::bad_alloc&) {
    return {ExitCode::bad_input,
            "memory: error: not enough memory for this case; a larger spacing needs less"};
  } catch (const std::system_error& error) {
    return {ExitCode::machine, machine_failure(error).what()};
  } catch (const std::exception& failure) {
    return {ExitCode::bug, failure.what()};
  } catch (...) {
    return {ExitCode::bug, "an exception of unknown type"};
  }
}

void throw_ending(const Ending& ending) {
  switch (ending.code) {
    case ExitCode::physics_failed:
      throw PhysicsFailure(ending.reason);
    case ExitCode::machine:
      throw MachineFailure(ending.reason);
    case ExitCode::interrupted:
      throw Interrupted(ending.reason);
    case ExitCode::bad_input:
      throw BadInput({{.place = "coupling", .message = ending.reason}});
    default:
      throw PeerLost(ending.reason);
  }
}

}  // namespace toryu
