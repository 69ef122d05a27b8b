#include "fluid_solver/ranks/orders.hpp"

#include <algorithm>

#include "common/error/ending.hpp"
#include "common/run/log.hpp"

namespace toryu::fluid {

namespace {

struct Head {
  double action, value, length;
};

void broadcast(MPI_Comm communicator, Head& head) {
  MPI_Bcast(&head, 3, MPI_DOUBLE, 0, communicator);
}

/// As many bytes as one call takes.
constexpr std::size_t most_bytes = std::size_t{1} << 30;

void broadcast(MPI_Comm communicator, std::string& text) {
  for (std::size_t begin = 0; begin < text.size(); begin += most_bytes)
    MPI_Bcast(text.data() + begin, static_cast<int>(std::min(most_bytes, text.size() - begin)), MPI_CHAR, 0,
              communicator);
}

}  // namespace

void give(MPI_Comm communicator, const Order& order) {
  Head head{static_cast<double>(order.action), order.value, static_cast<double>(order.with.size())};
  broadcast(communicator, head);
  std::string with = order.with;
  broadcast(communicator, with);
}

Order take(MPI_Comm communicator) {
  Head head = {};
  broadcast(communicator, head);
  Order order{static_cast<Action>(static_cast<int>(head.action)), head.value,
              std::string(static_cast<std::size_t>(head.length), '\0')};
  broadcast(communicator, order.with);
  return order;
}

void end_all_if_it_fails(MPI_Comm communicator, const std::function<void()>& share) {
  try {
    share();
  } catch (...) {
    const Ending ending = ending_of_exception();
    int rank = 0;
    MPI_Comm_rank(communicator, &rank);
    log::error("rank {}: {}", rank, ending.reason);
    MPI_Abort(communicator, static_cast<int>(ending.code));
  }
}

}  // namespace toryu::fluid
