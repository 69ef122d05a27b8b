/// LAMMPS with the fluid in it, over all ranks. What it does is an order with numbers that go in and come
/// out: rank 0, which alone knows of the case and of the other programs, gives it by `Fluid`, and all ranks
/// obey it together in `Engine`.
#pragma once

#include <memory>
#include <vector>

#include "fix_steps.hpp"
#include "parameters.hpp"

namespace toryu::lammps_fluid {

enum class Order { fill, begin_window, step, take_load, give_state, take_state, observe, end };
using Numbers = std::vector<double>;

class Engine {
 public:
  Engine();
  ~Engine();
  /// By all ranks; what comes back counts on rank 0.
  Numbers obey(Order order, Numbers in);

 private:
  Numbers fill(const Numbers& in);
  Numbers begin_window(const Numbers& in);
  Numbers step(double dt);
  Numbers take_load(bool with_impedance);
  Numbers give_state();
  Numbers take_state(const Numbers& in);
  Numbers observe(const Numbers& in);

  template <class Visit>
  void over_fluid(Visit&& visit);
  PairSph& pair();
  FixSteps& steps();
  void command(const std::string& line);
  std::unique_ptr<LAMMPS_NS::LAMMPS> lammps_;
  Physics physics_;
};

/// Obeys the orders of rank 0 until the end; on the other ranks.
void serve();

/// The fluid as rank 0 sees it.
class Fluid {
 public:
  Fluid() = default;
  /// Lets the others end; if an order failed half-way nobody can tell where they are, and all are ended.
  ~Fluid();

  void fill(const Start& start);
  /// Physics that fails is a PhysicsFailure.
  Extremes step(double time, double dt);
  Numbers call(Order order, Numbers in = {});

 private:
  std::unique_ptr<Engine> engine_;
  Physics physics_;
  bool is_busy_ = false;
};

}  // namespace toryu::lammps_fluid
