/// How orders come from rank 0 to the others.
#include <time.h>

#include <cstring>

#include "engine.hpp"

namespace toryu::lammps_fluid {

namespace {

/// Waits for what rank 0 will say, which may take as long as the solid: MPI's own wait would keep a core
/// busy.
void wait_quietly(MPI_Request& request) {
  int done = 0;
  for (int tries = 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE), !done; ++tries)
    if (tries > 2000) {
      const timespec nap{.tv_sec = 0, .tv_nsec = 50'000};
      nanosleep(&nap, nullptr);
    }
}

/// The same on all ranks: rank 0 gives, the others receive.
void broadcast(Order& order, Numbers& numbers) {
  long head[] = {static_cast<long>(order), static_cast<long>(numbers.size())};
  MPI_Request request;
  MPI_Ibcast(head, 2, MPI_LONG, 0, MPI_COMM_WORLD, &request);
  wait_quietly(request);
  order = static_cast<Order>(head[0]);
  numbers.resize(static_cast<std::size_t>(head[1]));
  MPI_Bcast(numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
}

}  // namespace

void serve() {
  std::unique_ptr<Engine> engine;
  for (;;) {
    Order order = Order::end;
    Numbers numbers;
    broadcast(order, numbers);
    if (order == Order::end) return;
    if (order == Order::fill) engine = std::make_unique<Engine>();
    engine->obey(order, std::move(numbers));
  }
}

Numbers Fluid::call(Order order, Numbers in) {
  broadcast(order, in);
  if (order == Order::end) return {};
  is_busy_ = true;
  if (order == Order::fill) engine_ = std::make_unique<Engine>();
  Numbers out = engine_->obey(order, std::move(in));
  is_busy_ = false;
  return out;
}

Fluid::~Fluid() {
  if (!is_busy_) call(Order::end);
}

void Fluid::fill(const Start& start) {
  physics_ = start.physics;
  Numbers in((sizeof physics_ + 7) / 8);
  std::memcpy(in.data(), &physics_, sizeof physics_);
  for (std::size_t n = 0; n < start.density.size(); ++n) {
    for (const auto* vectors : {&start.position, &start.velocity})
      for (std::size_t a = 0; a < dim; ++a) in.push_back((*vectors)[dim * n + a]);
    in.push_back(start.density[n]);
    in.push_back(start.mass[n]);
  }
  call(Order::fill, std::move(in));
}

Extremes Fluid::step(double time, double dt) {
  const Numbers found = call(Order::step, {dt});
  const auto number = static_cast<long>(found[2]);
  if (number != Extremes::none) {
    const auto quantity = static_cast<char>(found[3]);
    const auto fail = [&](const char* what, const std::string& value, const std::string& limit) {
      throw PhysicsFailure("fluid", number, time + dt, what, value, limit);
    };
    if (quantity == 's')
      fail("speed", fmt::format("{:.6g} m/s", found[4]), fmt::format("{:g} m/s", physics_.largest_speed));
    if (quantity == 'd')
      fail("density", fmt::format("{:.6g} kg/m3", found[4]),
           fmt::format("{:g} kg/m3 +- {:g} %", physics_.rho_0, 100 * physics_.largest_change));
    fail("position", fmt::format("({:.6g}, {:.6g}) m", found[4], found[5]), "the domain");
  }
  return {.speed = found[0], .acceleration = found[1]};
}

}  // namespace toryu::lammps_fluid
