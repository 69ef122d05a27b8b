/// The loops over pairs of pair_sph.hpp.
#pragma once

#include <cmath>

#include "pair_sph.hpp"

namespace toryu::lammps_fluid {

/// A sum of W below this share of one particle's at no distance means that no fluid is in reach.
constexpr double smallest_share = 1e-9;
/// Smallest eigenvalue of the moment of a particle's neighbours that is inverted (1 in a full lattice).
constexpr double smallest_moment = 0.1;
/// A wall without suction thins the fluid by so much and no further.
constexpr double most_thinned = 0.05;

/// Calls add(j, x_ij, y_ij, r, G) for the neighbours of i from `begin` to `end` that are in reach.
template <class W, class Add>
inline void PairSph::over(int i, int begin, int end, const W& kernel, Add&& add) const {
  const double* const x = atom->x[0];  // three a particle
  const int* const near = list->firstneigh[i];
  const double x_i = x[3 * i], y_i = x[3 * i + 1], reach = physics.support(), reach2 = reach * reach;
  for (int k = begin; k < end; ++k) {
    const int j = near[k];
    const double dx = x_i - x[3 * j], dy = y_i - x[3 * j + 1], r2 = dx * dx + dy * dy;
    if (r2 >= reach2) continue;
    const double r = std::sqrt(r2);
    add(static_cast<std::size_t>(j), dx, dy, r, kernel.gradient_over_r(r));
  }
}

/// Pressure and velocity that walls take from the fluid: kernel means, the pressure with the weight of what
/// lies between.
template <class W>
void PairSph::extrapolate(const W& kernel) {
  double** const v = atom->v;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (atom->type[i] == Type::fluid) continue;
    const auto n = static_cast<std::size_t>(i);
    double sum_W = 0, sum_p = 0, sum_v[dim] = {}, sum_rho_x[dim] = {};
    over(i, 0, first_wall_[n], kernel, [&](std::size_t j, double dx, double dy, double r, double) {
      const double W_wi = kernel.value(r), rho_W = rho_[j] * W_wi;
      sum_W += W_wi;
      sum_p += p_[j] * W_wi;
      sum_v[0] += v[j][0] * W_wi;
      sum_v[1] += v[j][1] * W_wi;
      sum_rho_x[0] += rho_W * dx;
      sum_rho_x[1] += rho_W * dy;
    });
    const double share = 1 / std::max(sum_W, smallest_share * kernel.value(0));
    const double* a_w =
        atom->type[i] == Type::interface ? &wall_acceleration[static_cast<std::size_t>(dim * place(i))]
                                         : nullptr;
    p_[n] = sum_p;
    for (int a = 0; a < dim; ++a) p_[n] += (physics.gravity[a] - (a_w ? a_w[a] : 0)) * sum_rho_x[a];
    p_[n] *= share;
    wx_[n] = 2 * v[i][0] - sum_v[0] * share;
    wy_[n] = 2 * v[i][1] - sum_v[1] * share;
  }
}

/// <grad rho>_i = L_i sum_j V_j (rho_j - rho_i) gradW_ij; zero where L_i is near singular.
template <class W>
void PairSph::density_gradients(const W& kernel) {
  for (int i = 0; i < atom->nlocal; ++i) {
    if (atom->type[i] != Type::fluid) continue;
    const auto n = static_cast<std::size_t>(i);
    double xx = 0, xy = 0, yy = 0, b[dim] = {};
    over(i, 0, first_wall_[n], kernel, [&](std::size_t j, double dx, double dy, double, double G) {
      const double V_G = V_[j] * G, d_rho = rho_[j] - rho_[n];
      xx -= V_G * dx * dx;
      xy -= V_G * dx * dy;
      yy -= V_G * dy * dy;
      b[0] += V_G * d_rho * dx;
      b[1] += V_G * d_rho * dy;
    });
    const double det = xx * yy - xy * xy, trace = xx + yy;
    const bool regular =
        det - smallest_moment * trace + smallest_moment * smallest_moment > 0 && trace > 2 * smallest_moment;
    gx_[n] = regular ? (yy * b[0] - xy * b[1]) / det : 0;
    gy_[n] = regular ? (xx * b[1] - xy * b[0]) / det : 0;
  }
}

/// P_ij of artificial viscosity times what - sum_j m_j P_ij gradW_ij takes, for v_ij . x_ij below 0.
inline double artificial(const Physics& f, double v_x, double r2, double rho_sum) {
  const double theta = f.h * std::min(v_x, 0.0) / (r2 + 0.01 * f.h * f.h);
  return (f.beta * theta - f.alpha * f.c_0) * theta * 2 / rho_sum;
}

template <class W, bool of_density, bool of_velocity, bool renormalised>
void PairSph::rates(const W& kernel) {
  const Physics& f = physics;
  double** const v = atom->v;
  double* const drho = custom("drho");
  const bool is_viscous = f.alpha > 0 || f.beta > 0, is_laminar = f.mu > 0;
  const double least_rho = f.suction ? 0 : (1 - most_thinned) * f.rho_0;
  const double least_push = f.suction ? -std::numeric_limits<double>::infinity() : 0;
  for (int k = 0; k < list->inum; ++k) {
    const int i = list->ilist[k];
    const auto n = static_cast<std::size_t>(i);
    if (atom->type[i] != Type::fluid) continue;
    const double rho_i = rho_[n], p_rho2_i = p_rho2_[n], vx = v[i][0], vy = v[i][1],
                 laminar = 2 * f.mu / rho_i;
    double compression = 0, diffusion = 0, a[dim] = {};
    over(i, 0, first_wall_[n], kernel, [&](std::size_t j, double dx, double dy, double r, double G) {
      const double ux = vx - v[j][0], uy = vy - v[j][1], v_x = ux * dx + uy * dy, V_G = V_[j] * G;
      if constexpr (of_density) {
        compression += V_G * v_x;
        double psi_x = 2 * (rho_i - rho_[j]);
        if constexpr (renormalised) psi_x -= (gx_[n] + gx_[j]) * dx + (gy_[n] + gy_[j]) * dy;
        diffusion += V_G * psi_x;
      }
      if constexpr (of_velocity) {
        double push = p_rho2_i + p_rho2_[j];
        if (is_viscous) push += artificial(f, v_x, r * r, rho_i + rho_[j]);
        const double factor = m_[j] * G * push;
        a[0] -= factor * dx;
        a[1] -= factor * dy;
        if (is_laminar) {
          a[0] += laminar * V_G * ux;
          a[1] += laminar * V_G * uy;
        }
      }
    });
    const auto from_walls = [&](int begin, int end, double* by) {
      over(i, begin, end, kernel, [&](std::size_t j, double dx, double dy, double r, double G) {
        const double V_G = V_[j] * G;
        if constexpr (of_density) {
          const double all = V_G * ((vx - v[j][0]) * dx + (vy - v[j][1]) * dy);
          compression += rho_i >= least_rho ? all : std::max(all, 0.0);
        }
        if constexpr (of_velocity) {
          const double ux = vx - wx_[j], uy = vy - wy_[j];
          double push = std::max(p_rho2_i + p_rho2_[j], least_push);
          if (is_viscous && f.no_slip) push += artificial(f, ux * dx + uy * dy, r * r, rho_i + rho_[j]);
          const double factor = m_[j] * G * push;
          by[0] -= factor * dx;
          by[1] -= factor * dy;
          if (is_laminar && f.no_slip) {
            by[0] += laminar * V_G * ux;
            by[1] += laminar * V_G * uy;
          }
        }
      });
    };
    double by_interface[dim] = {};
    from_walls(first_wall_[n], first_interface_[n], a);
    from_walls(first_interface_[n], neighbours(i), by_interface);
    if constexpr (of_density) drho[i] = rho_i * compression + f.delta * f.h * f.c_0 * diffusion;
    if constexpr (of_velocity) {
      from_x_[n] = by_interface[0];
      from_y_[n] = by_interface[1];
      for (int c = 0; c < dim; ++c) atom->f[i][c] = a[c] + by_interface[c] + f.gravity[c];
    }
  }
}

/// The forces of the same pairs on the particles of the interface.
template <class W>
void PairSph::reaction(const W& kernel) {
  const Physics& f = physics;
  double** const v = atom->v;
  const double least_push = f.suction ? -std::numeric_limits<double>::infinity() : 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (atom->type[i] != Type::interface) continue;
    const auto n = static_cast<std::size_t>(i);
    double a[dim] = {};
    over(i, 0, first_wall_[n], kernel, [&](std::size_t j, double dx, double dy, double r, double G) {
      const double ux = wx_[n] - v[j][0], uy = wy_[n] - v[j][1];
      double push = std::max(p_rho2_[n] + p_rho2_[j], least_push);
      if ((f.alpha > 0 || f.beta > 0) && f.no_slip)
        push += artificial(f, ux * dx + uy * dy, r * r, rho_[n] + rho_[j]);
      const double factor = m_[j] * G * push;
      a[0] -= factor * dx;
      a[1] -= factor * dy;
      if (f.mu > 0 && f.no_slip) {
        const double viscous = 2 * f.mu / rho_[n] * V_[j] * G;
        a[0] += viscous * ux;
        a[1] += viscous * uy;
      }
    });
    fx_[n] = m_[n] * a[0];
    fy_[n] = m_[n] * a[1];
  }
}

}  // namespace toryu::lammps_fluid
