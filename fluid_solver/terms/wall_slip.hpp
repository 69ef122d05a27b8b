/// Slip of the medium along rigid walls: the law of Navier (1823), by a power and above a threshold,
///
///     u_s = b (tau_w - tau_c)^m where tau_w > tau_c, else 0,
///
/// u_s the speed of the medium against the wall, along the wall's shear stress tau_w (Hatzikiriakos 2012
/// reviews the laws that are measured of polymers; Peng, Gao & Wang 2023 find one of media of abrasive flow
/// machining). b = 0 is no slip, b without bound a wall without shear stress. m = 1 gives the slip length b
/// eta.
///
/// The rate of shear at a wall falls with the slip, gdot_w = gdot_0 - k u_s: gdot_0 is what the velocity
/// beside the wall would give if the medium stuck, and 1/k the distance of that velocity from the wall
/// (wall_extrapolation.hpp). With the medium's tau(gdot) = eta(gdot) gdot the slip is the solution of
///
///     gdot_w + k u_s(tau(gdot_w)) = gdot_0,
///
/// of which there is one, for the left side grows with gdot_w. Slip and velocity belong to the same time:
/// neither the step nor the law's steepness makes them swing.
///
/// On a work piece with friction (33) too, the smaller of both tractions rules: tau_w <= mu_A p.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "common/case/parameter_table.hpp"
#include "fluid_solver/terms/medium.hpp"

namespace toryu::fluid {

struct SlipLaw {
  static constexpr const char* section = "wall_slip";
  static constexpr const char* help =
      "speed at which the medium slides along rigid walls under its shear stress";
  double coefficient = 0;  ///< b [m/s/Pa^m]
  double exponent = 1;     ///< m
  double threshold = 0;    ///< tau_c [Pa]
};
inline void describe(ParameterTable& table, SlipLaw& law) {
  table.number("coefficient", law.coefficient,
               {.unit = "m/s/Pa^exponent",
                .minimum = 0,
                .required = true,
                .help = "b of u_s = b (tau_w - tau_c)^m (Navier 1823); 0: the medium sticks"});
  table.number("exponent", law.exponent,
               {.minimum = 0, .maximum = 10, .above_minimum = true, .help = "m; 1: Navier's own law"});
  table.number("threshold", law.threshold,
               {.unit = "Pa", .minimum = 0, .help = "tau_c, the shear stress up to which the medium sticks"});
}

/// Under the shear stress `tau` [Pa] of a wall [m/s].
inline double slip_speed(const SlipLaw& law, double tau) {
  return tau > law.threshold ? law.coefficient * std::pow(tau - law.threshold, law.exponent) : 0.0;
}

/// The x in (0, high] with f(x) = target > 0, where f grows from 0 and f(high) >= target; where f jumps past
/// the target, the place of the jump. By secants in logarithms (Illinois; Dowell & Jarratt 1971), in which
/// powers are straight lines.
template <class F>
double solve_growing(F&& f, double high, double target) {
  constexpr double close = 1e-12;
  const auto off = [&](double log_x) { return std::log(f(std::exp(log_x)) / target); };
  double b = std::log(high), f_b = off(b);
  if (f_b < close) return high;
  double a = b, f_a = f_b;
  for (double reach = 1; f_a > 0; reach *= 2) {
    b = a, f_b = f_a;
    a -= reach * f_a, f_a = off(a);
    if (std::abs(f_a) < close) return std::exp(a);
  }
  int side = 0;  // the bound that moved last
  for (int n = 0; n < 100 && b - a > close; ++n) {
    const double c = (a * f_b - b * f_a) / (f_b - f_a), f_c = off(c);
    if (std::abs(f_c) < close || !(a < c && c < b)) return std::exp(c);
    if (f_c < 0) {
      a = c, f_a = f_c;
      if (side < 0) f_b *= 0.5;
      side = -1;
    } else {
      b = c, f_b = f_c;
      if (side > 0) f_a *= 0.5;
      side = 1;
    }
  }
  return std::exp(0.5 * (a + b));
}

/// What a wall and the medium do to each other.
struct Slide {
  double speed = 0;   ///< u_s [m/s]
  double stress = 0;  ///< tau_w [Pa]
};

/// Of a medium whose shear stress is `tau(gdot)` [Pa], with gdot_0 [1/s] and k [1/m] as above; `most` [Pa] is
/// the largest traction of the wall.
template <class Stress>
Slide slide(const SlipLaw& law, Stress&& tau, double gdot_0, double k, double most) {
  if (!(gdot_0 > 0) || !(k > 0)) return {};
  const auto together = [&](double gdot) { return gdot + k * slip_speed(law, tau(gdot)); };
  double gdot_w = solve_growing(together, gdot_0, gdot_0), tau_w = tau(gdot_w);
  if (tau_w > most) {
    gdot_w = most > 0 ? solve_growing(tau, gdot_w, most) : 0.0;
    tau_w = most;
  }
  return {(gdot_0 - gdot_w) / k, tau_w};
}

inline ActiveTerm text(const SlipLaw& law, const Medium&) {
  return {"wall slip", "u_s = b (tau_w - tau_c)^m", "Navier 1823",
          fmt::format("b {} m/s/Pa^m, m {}, tau_c {} Pa, at rigid walls", law.coefficient, law.exponent,
                      law.threshold)};
}

}  // namespace toryu::fluid
