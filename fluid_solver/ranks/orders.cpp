#include "fluid_solver/ranks/orders.hpp"

namespace toryu::fluid {

namespace {

struct Head {
  double action, value, length;
};

void broadcast(MPI_Comm communicator, Head& head) {
  MPI_Bcast(&head, 3, MPI_DOUBLE, 0, communicator);
}

void broadcast(MPI_Comm communicator, std::string& text) {
  if (!text.empty()) MPI_Bcast(text.data(), static_cast<int>(text.size()), MPI_CHAR, 0, communicator);
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

}  // namespace toryu::fluid
