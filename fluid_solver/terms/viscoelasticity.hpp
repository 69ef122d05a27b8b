/// Elastic stress of a viscoelastic medium, one or several modes k beside the solvent's viscosity:
///
///     sigma_p = sum_k G_k (A_k - I),   G_k = eta_k/lambda_k
///     dA/dt = L A + A L^T - [(A - I) + alpha (A - I)^2]/lambda,   L_ab = dv_a/dx_b
///
/// with the conformation A of the polymer, I at rest: Oldroyd-B (Oldroyd 1950) where alpha = 0, else Giesekus
/// (1982). A stays positive definite however coarse the steps are, for its logarithm psi advances, with the
/// particle (Fattal & Kupferman 2004),
///
///     dpsi/dt = W psi - psi W + 2 B + [(1 - alpha) e^-psi - (1 - 2 alpha) I - alpha e^psi]/lambda
///
/// where W = (L - L^T)/2, and B is D = (L + L^T)/2 with its part off the axes of psi times x coth x, x half
/// the difference of the eigenvalues. That is their equation in the plane without its eigenvectors, and
/// without their case of equal eigenvalues: x coth x is 1 there.
///
/// The force is sum_j m_j/(rho_i rho_j) (sigma_i + sigma_j) . gradW_ij: equal and opposite pair by pair. Wall
/// particles have the stress of the fluid before them (wall_extrapolation.hpp), and so need no slip.
///
/// Energy: a particle holds V sum_k G_k/2 tr(A - I - psi) and dissipates V sum_k G_k/(2 lambda_k) tr[(I -
/// A^-1)((A - I) + alpha (A - I)^2)]; their sum is the power of the stress.
///
/// In the plane A_zz stays 1. Waves of shear travel at sqrt(G A_nn/rho). The stress is blind to a velocity
/// that alternates from particle to particle, which the solvent damps: so there has to be one. Tension along
/// the flow, 2 eta lambda gdot^2 in steady shear, has to be outweighed by a background pressure.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/case/parameter_table.hpp"
#include "fluid_solver/terms/medium.hpp"
#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

struct PolymerMode {
  double relaxation_time = 0;                                             ///< lambda [s]
  double polymer_viscosity = 0;                                           ///< eta [Pa s]
  double mobility = 0;                                                    ///< alpha
  double modulus() const { return polymer_viscosity / relaxation_time; }  ///< G [Pa]
};
inline void describe(ParameterTable& table, PolymerMode& mode) {
  const auto size = [&](const std::string& key, double& value, const std::string& unit,
                        const std::string& help) {
    table.number(key, value,
                 {.unit = unit, .minimum = 0, .above_minimum = true, .required = true, .help = help});
  };
  size("relaxation_time", mode.relaxation_time, "s", "lambda");
  size("polymer_viscosity", mode.polymer_viscosity, "Pa.s",
       "eta_p, in slow shear; the modulus is eta_p/lambda");
  table.number(
      "mobility", mode.mobility,
      {.minimum = 0, .maximum = 1, .help = "alpha of Giesekus (1982), mostly 0 to 0.5; 0: Oldroyd-B"});
}

/// Viscosity of a mode in steady shear: falls with the rate where alpha > 0 (Giesekus 1982; Bird, Armstrong &
/// Hassager 1987, table 7.3-3, without its differences of nearly equal numbers) [Pa s].
inline double steady_viscosity(const PolymerMode& mode, double shear_rate) {
  const double alpha = std::min(mode.mobility, 1 - 1e-6);  // at 1 it is a limit
  const double Wi = mode.relaxation_time * shear_rate, a = 8 * alpha * (1 - alpha) * Wi * Wi;
  const double root = std::sqrt(1 + 2 * a) + 1, chi = std::sqrt(2 / root);
  const double f = 2 * a / (root * root * (1 + chi) * (1 + (1 - 2 * alpha) * chi));
  return mode.polymer_viscosity * (1 - f) * (1 - f) / (1 + (1 - 2 * alpha) * f);
}

struct Viscoelasticity {
  static constexpr const char* section = "viscoelasticity";
  static constexpr const char* help = "elastic stress of a polymer beside the viscosity of its solvent";
  std::vector<PolymerMode> modes;
};
inline void describe(ParameterTable& table, Viscoelasticity& viscoelasticity) {
  table.list("mode", viscoelasticity.modes, "relaxation of the stress: one or several");
  table.require(
      !viscoelasticity.modes.empty() && viscoelasticity.modes.size() <= most_polymer_modes, "mode",
      fmt::format("a viscoelastic medium has one to {} [[fluid.viscoelasticity.mode]]", most_polymer_modes));
}

/// [a][b]: dv_b/dx_a of one particle [1/s].
using VelocityGradientOfOne = std::array<std::array<double, dim>, dim>;

/// A conformation A of the plane by its logarithm psi = [m + a, b; b, m - a].
class Conformation {
 public:
  explicit Conformation(const Symmetric<double>& psi)
      : m_(0.5 * (psi.xx + psi.yy)),
        a_(0.5 * (psi.xx - psi.yy)),
        b_(psi.xy),
        q2_(a_ * a_ + b_ * b_),
        q_(std::sqrt(q2_)),
        growth_(std::exp(m_)),
        cosh_(std::cosh(q_)),
        sinhc_(q_ > small ? std::sinh(q_) / q_ : 1 + q2_ / 6 * (1 + q2_ / 20 * (1 + q2_ / 42))) {}

  /// A.
  Symmetric<double> value() const {
    const double mean = growth_ * cosh_, share = growth_ * sinhc_;
    return {mean + share * a_, mean - share * a_, share * b_};
  }
  double largest_eigenvalue() const { return growth_ * std::exp(q_); }

  /// dpsi/dt [1/s].
  Symmetric<double> rate(const PolymerMode& mode, const VelocityGradientOfOne& grad_v) const {
    const double mean = 0.5 * (grad_v[0][0] + grad_v[1][1]), d = 0.5 * (grad_v[0][0] - grad_v[1][1]);
    const double e = 0.5 * (grad_v[0][1] + grad_v[1][0]), w = 0.5 * (grad_v[1][0] - grad_v[0][1]);
    // (x coth x - 1)/x^2 of x = q
    const double bend = q_ > small ? (cosh_ / sinhc_ - 1) / q2_ : (1 - q2_ / 15 * (1 - 2 * q2_ / 21)) / 3;
    const double across = 1 + bend * q2_, along = bend * (d * a_ + e * b_);
    const double alpha = mode.mobility, rate = 1 / mode.relaxation_time;
    const double back = (1 - alpha) / growth_, forth = alpha * growth_;
    const double shrink = rate * (back + forth) * sinhc_;
    const double dm = 2 * mean + rate * ((back - forth) * cosh_ - (1 - 2 * alpha));
    const double da = 2 * (w * b_ + across * d - along * a_) - shrink * a_;
    const double db = 2 * (-w * a_ + across * e - along * b_) - shrink * b_;
    return {dm + da, dm - da, db};
  }

  /// The fastest rate at which psi relaxes [1/s].
  double relaxation_rate(const PolymerMode& mode) const {
    const double largest = largest_eigenvalue(), smallest = growth_ * std::exp(-q_);
    return ((1 - mode.mobility) / smallest + mode.mobility * largest) / mode.relaxation_time;
  }

  /// Free energy [J/m3].
  double energy(const PolymerMode& mode) const { return mode.modulus() * (growth_ * cosh_ - 1 - m_); }
  /// What is lost of it [W/m3].
  double dissipation(const PolymerMode& mode) const {
    double sum = 0;
    for (const double s : {m_ - q_, m_ + q_}) {
      const double strain = std::expm1(s);
      sum += strain * strain * (1 + mode.mobility * strain) / (1 + strain);
    }
    return 0.5 * mode.modulus() / mode.relaxation_time * sum;
  }

 private:
  static constexpr double small = 0.03;  ///< below which series are as exact
  double m_, a_, b_, q2_, q_, growth_, cosh_, sinhc_;
};

struct PolymerStressForce {
  TORYU_INLINE void momentum(const Targets& i, const Sources& source, std::size_t j, const Pair& pair,
                             Rates& rates) const {
    const Lanes share = inverse(i.rho) * pair.V_G;  // V_j = m_j/rho_j
    const auto& [xx, yy, xy] = source.polymer_stress;
    const Lanes sum_xx = i.polymer_stress.xx + xx[j], sum_yy = i.polymer_stress.yy + yy[j];
    const Lanes sum_xy = i.polymer_stress.xy + xy[j];
    rates.a[0] += share * (sum_xx * pair.x_ij[0] + sum_xy * pair.x_ij[1]);
    rates.a[1] += share * (sum_xy * pair.x_ij[0] + sum_yy * pair.x_ij[1]);
  }
  TORYU_INLINE void at_wall(const Targets& i, const Sources& source, std::size_t j, const Pair& pair,
                            Rates& rates) const {
    momentum(i, source, j, pair, rates);
  }
};
inline PolymerStressForce pair_force(const Viscoelasticity&, const Medium&) {
  return {};
}

inline ActiveTerm text(const Viscoelasticity& viscoelasticity, const Medium&) {
  std::string modes;
  for (const PolymerMode& mode : viscoelasticity.modes)
    modes += fmt::format("{}lambda {} s, eta_p {} Pa s, alpha {}", modes.empty() ? "" : "; ",
                         mode.relaxation_time, mode.polymer_viscosity, mode.mobility);
  return {"viscoelasticity",
          "sum_j m_j/(rho_i rho_j) (sigma_i + sigma_j) . gradW_ij, sigma = sum_k G_k (A_k - I)",
          "Oldroyd 1950; Giesekus 1982; Fattal & Kupferman 2004", modes};
}

}  // namespace toryu::fluid
