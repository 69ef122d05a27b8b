/// Where the energy of the fluid goes (for delta-SPH: Antuono, Marrone, Colagrossi & Bouscasse 2015; at
/// walls: Cercos-Pita, Antuono, Colagrossi & Souto-Iglesias 2017). Per metre of depth,
///
///     E = sum_i m_i [v_i^2/2 + phi(x_i) + e(rho_i)],    de/drho = p/rho^2,
///     dE/dt = power of the boundaries - powers of the terms + remainder
///
/// phi is the potential of gravity and of a central force. A boundary w that moves gives sum F_iw . v_w; a
/// term with forces F_ij between pairs takes - sum F_ij . v_ij, and density diffusion, D_i of it at particle
/// i, takes - sum_i m_i p_i/rho_i^2 D_i. The pressure takes something where rho_i and rho_j differ, for
/// only else its force is the gradient of e. The work of the boundaries is summed at each step, with the
/// forces by which the velocity advances. The powers of the terms are found where a row is written, at most
/// every tenth step, for they cost an evaluation of all rates and more, and integrated by the trapezoidal
/// rule.
///
/// What remains is of the time step, by its square; of particle shifting, tensile control and consistent
/// gradients; of the rule above, where rows are too few for what happens between them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/run/solver.hpp"

namespace toryu::fluid {

/// Whether what a term takes is lost, or may come back: a surface, a spring.
enum class Taken { dissipated, stored };

/// What a term takes from the energy of the fluid in a moment.
struct Power {
  std::string term;  ///< "artificial_viscosity"
  Taken taken = Taken::dissipated;
  double value = 0;  ///< [W per metre depth]
};

class EnergyBalance {
 public:
  EnergyBalance() = default;
  /// The terms of the case, by the names of `powers`.
  explicit EnergyBalance(std::vector<Power> powers)
      : terms_(std::move(powers)), state_{.energy = std::vector<double>(terms_.size()), .power = {}} {}

  /// Integrates to `time` [s], when the terms take `powers`. Before the first ones none are known: these
  /// count from the start.
  void add(double time, const std::vector<Power>& powers);

  /// Taken from the start to `time` [s], since the last powers at their rate [J per metre depth].
  double taken(Taken kind, double time) const;
  /// Columns: what is dissipated altogether and by each term, what is stored, and the remainder; `gained` is
  /// by how much the energy of the fluid has changed beyond the work done on it [J per metre depth].
  /// Energies are in `unit`: by metre of depth, or of the whole circumference.
  std::vector<Observation> observe(double gained, double time, const std::string& unit = "J/m") const;

 private:
  struct State {
    double time = 0;                           ///< of `power` [s]
    std::vector<double> energy;                ///< by term [J per metre depth]
    std::optional<std::vector<double>> power;  ///< the last ones [W per metre depth]
  };
  template <class Archive>
  friend void serialize(Archive& archive, EnergyBalance& balance) {
    auto& [time, energy, power] = balance.state_;
    bool known = power.has_value();
    archive(time, energy, known);
    if (!known) return power.reset();
    if (!power) power.emplace();
    archive(*power);
  }

  /// Taken by term n to `time`.
  double taken_by(std::size_t n, double time) const {
    return state_.energy[n] + (state_.power ? (*state_.power)[n] * (time - state_.time) : 0.0);
  }

  std::vector<Power> terms_;
  State state_;
};

}  // namespace toryu::fluid
