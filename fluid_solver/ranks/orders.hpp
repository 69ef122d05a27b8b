/// What rank 0, which leads a run, has the other ranks do. All of a fluid's work is done by all of them
/// together, and only the lead knows when.
#pragma once

#include <mpi.h>

#include <functional>
#include <sstream>
#include <string>

#include "common/state/serialize.hpp"

namespace toryu::fluid {

enum class Action {
  fill,          ///< read the case and fill the walls of its scene
  hand_out,      ///< the fluid; what it has begun with comes with it
  read_state,    ///< of a checkpoint, which comes with it
  find_surface,  ///< of the work pieces, where the case asks for removal
  attach,        ///< the interface that comes with it
  begin_window,  ///< of `value` [s], with the motion that comes with it
  advance,       ///< by `value` [s]
  check,         ///< at the time `value` [s]
  look,          ///< at powers and at who is in walls
  collect,       ///< of the whole what is reported, or with a `value` all of its state
  pack,          ///< find how densely particles are packed
  take_load,
  save,
  restore,
  end,
};

struct Order {
  Action action = Action::end;
  double value = 0;
  std::string with = {};
};

/// Gives an order to all other ranks.
void give(MPI_Comm communicator, const Order& order);
/// Waits for one.
Order take(MPI_Comm communicator);
/// Does this rank's share of what all do together. If it fails the others wait in vain: it ends them too.
void end_all_if_it_fails(MPI_Comm communicator, const std::function<void()>& share);

/// Values as the text that goes with an order, and back.
template <class... Value>
std::string packed(const Value&... values) {
  std::ostringstream stream(std::ios::binary);
  write_states(stream, values...);
  return std::move(stream).str();
}
template <class... Value>
void unpack(const std::string& text, Value&... values) {
  std::istringstream stream(text, std::ios::binary);
  read_states(stream, values...);
}

}  // namespace toryu::fluid
