/// The pair style `toryu/sph` of LAMMPS: rates of density and velocity by delta-SPH, walls as Adami, Hu &
/// Adams (2012) have them, and what the fluid does to the solid's interface.
///
/// All sums over neighbours go over a full list that is sorted by number, so that they have the same bits on
/// whatever rank: neighbours beyond the support add nothing, and ghosts are exact copies.
#pragma once

#include <vector>

#include "exact_sum.hpp"
#include "lammps_headers.hpp"
#include "physics.hpp"

namespace toryu::lammps_fluid {

enum class RatesOf { density, velocity, both };

class PairSph : public LAMMPS_NS::Pair {
 public:
  explicit PairSph(LAMMPS_NS::LAMMPS* lmp) : Pair(lmp) { single_enable = restartinfo = writedata = 0; }
  ~PairSph() override;

  Physics physics;                        ///< to be set before the first run
  RatesOf wanted = RatesOf::density;      ///< of the next evaluation
  std::vector<double> wall_acceleration;  ///< of the interface, dim values a particle [m/s2]

  /// The rates of all own particles of the fluid. The acceleration is in atom->f.
  void evaluate(RatesOf rates);
  /// What the last evaluation's forces do over `dt` [s]: the load of own particles of the interface.
  void add_load(double dt);
  /// Takes the impulse of each particle of the interface, by its place in it, out of the fluid near it, in
  /// shares of m_j W_ij. What finds none is taken off the load.
  void give_impulse(const double* impulse);
  /// Adds to `by_place` how the fluid answers own particles of the interface: rho_0 c_0 times the area that
  /// they bear, dim values each [kg/(s.m)].
  void add_impedance(double* by_place) const;
  /// The impulse on the fluid, dim values [N s/m], and the work of impulses [J/m], since the last call.
  ExactSums<dim + 1> take_impulse() { return std::exchange(received_, {}); }

  void compute(int, int) override { evaluate(wanted); }
  void settings(int, char**) override {}
  void coeff(int, char**) override;
  double init_one(int, int) override { return physics.support(); }
  void init_style() override;
  int pack_forward_comm(int count, int* which, double* buffer, int, int*) override;
  void unpack_forward_comm(int count, int first, double* buffer) override;

  double* custom(const char* name) const;  ///< the values of `fix property/atom`
  /// The place of a particle in the interface; below 0 if it belongs to fluid or walls.
  int place(int i) const { return atom->tag[i] - 1 - physics.fluid_count - physics.wall_count; }

 private:
  template <class Visit>
  void with_kernel(Visit&& visit) const {
    if (physics.wendland)
      visit(WendlandC2(physics.h));
    else
      visit(CubicSpline(physics.h));
  }
  void sort_lists();
  void send(std::vector<std::vector<double>*> fields);
  void find_pressures();
  template <class W>
  void extrapolate(const W& kernel);
  template <class W>
  void density_gradients(const W& kernel);
  template <class W, bool of_density, bool of_velocity, bool renormalised>
  void rates(const W& kernel);
  template <class W>
  void reaction(const W& kernel);
  template <class W, class Add>
  void over(int i, int begin, int end, const W& kernel, Add&& add) const;
  int neighbours(int i) const { return list->numneigh[i]; }

  std::vector<int> first_wall_, first_interface_;  ///< of the neighbours of each particle
  std::vector<std::vector<double>*> sent_;         ///< fields that are on their way to ghosts
  std::vector<double> rho_, p_, p_rho2_, V_, m_;   ///< of own particles and ghosts
  std::vector<double> wx_, wy_;                    ///< v_w-f of walls [m/s]
  std::vector<double> gx_, gy_;                    ///< gradient of the density
  std::vector<double> from_x_, from_y_;            ///< acceleration by the interface [m/s2]
  std::vector<double> fx_, fy_;                    ///< force on the interface [N/m]
  ExactSums<dim + 1> received_;
};

}  // namespace toryu::lammps_fluid
