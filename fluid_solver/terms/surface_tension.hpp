/// Surface tension sigma of a free surface, as a continuum surface stress (Lafaurie, Nardone, Scardovelli,
/// Zaleski & Zanetti 1994): the surface pulls along itself and not across,
///
///     T_i = K sigma max(|n_i| - n_0, 0) (I - n_i n_i/n_i^2),   n_i = sum_j V_j gradW_ij,   n_0 = 0.1/h,
///
/// where j is fluid or wall, and the force on i is sum_j m_j (T_i/rho_i^2 + T_j/rho_j^2) gradS_ij over fluid
/// particles: equal and opposite. n_i points inward, and is zero inside a lattice; n_0 takes off what
/// disorder leaves of it there. A flat surface bears no pressure across, so the density stays what it is.
///
/// K makes the tension of a flat surface sigma. A stretch along it has the power V_i T_i : sum_j V_j x_ij
/// gradS_ij, so 1/K is a sum over the rows of a lattice (`tension_of_rows`); in the continuum, with S = W and
/// n_0 = 0, that is the integral of C dC over the fluid's half of the surface, C = 1/2 to 1, which is 3/8.
///
/// S = 4/(pi H^2) (1 - r^2/H^2)^3, H = 2h (Mueller, Charypar & Gross 2003), has next to no Fourier components
/// at the wavelength of two spacings, on purpose: a tension draws neighbours together, and would pair them if
/// its kernel saw them better than that of the pressure does. So W should be Wendland's kernel at
/// h = 1.6 to 2 d_0; the cubic spline at 1.3 d_0 tears the surface (cases/capillary_drop).
///
/// Forces between pairs alone, attraction from afar and repulsion from near (Tartakovsky & Meakin 2005;
/// Akinci, Akinci & Teschner 2013), were tried and left out. Their tension is as easily put to sigma, but any
/// such force also makes a lattice of the particles and gives it a shear modulus of the order of sigma/h,
/// which outweighs the pressure sigma/R: the drop froze, and rang ten times too fast.
///
/// What is lost: angular momentum is kept as far as the stress converges. The tension sits up to 2h deep in
/// the fluid, so a radius R counts as R minus about half of h. K belongs to rows along the surface; lattices
/// at other angles have 3 to 4 % less tension in the mean, and so has a surface that is stirred. The stress
/// has no potential: it feeds what it stirs, and a thin liquid does not damp that (mu/sqrt(rho sigma R) below
/// 0.02 at R = 10 d_0). c_0 must be large against sqrt(sigma/(rho h)), ten times is enough. Walls count as
/// fluid: the surface meets them as if they were wetted, without an angle of contact, and they feel nothing
/// of it.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "common/case/parameter_table.hpp"
#include "fluid_solver/boundary.hpp"
#include "fluid_solver/terms/medium.hpp"
#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

/// Holds drops together, see terms/surface_tension.hpp.
struct SurfaceTension {
  static constexpr const char* section = "surface_tension";
  static constexpr const char* help = "of free surfaces, as a stress along them (Lafaurie et al. 1994)";
  double coefficient = 0;  ///< sigma [N/m]
};
inline void describe(ParameterTable& table, SurfaceTension& tension) {
  table.number("coefficient", tension.coefficient,
               {.unit = "N/m", .minimum = 0, .required = true, .help = "sigma; water in air has 0.072"});
}

/// S: without a root, and blind to what is shorter than two spacings.
class SmoothKernel {
 public:
  explicit SmoothKernel(double support)
      : inverse_H2_(1 / (support * support)), factor_(-24 / std::numbers::pi * inverse_H2_ * inverse_H2_) {}
  /// gradS_ij = x_ij times this [1/m4].
  TORYU_INLINE Lanes gradient_over_r(const Lanes& r2) const {
    const Lanes inside = positive_part(1.0 - inverse_H2_ * r2);
    return factor_ * (inside * inside);
  }

 private:
  double inverse_H2_, factor_;
};

/// The force on some particles i.
struct SurfaceTensionPair {
  SmoothKernel S;
  TensorLanes T_i;               ///< T_i/rho_i^2 [m5/(kg s2)]
  std::array<Positions, dim> T;  ///< that of all

  TORYU_INLINE void momentum(const Targets&, const Sources& source, std::size_t j, const Pair& pair,
                             Rates& rates) const {
    const Lanes factor = source.m[j] * S.gradient_over_r(pair.r2);
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b) rates.a[a] += factor * (T_i[a][b] + T[a][b][j]) * pair.x_ij[b];
  }
};

/// The stress of all particles.
class SurfaceTensionForce {
 public:
  SurfaceTensionForce(double K_sigma, double n_0, double support)
      : K_sigma_(K_sigma), n_0_(n_0), S_(support) {}

  template <class W>
  void prepare(const W& kernel, const Particles& fluid, const ClusterList& neighbours,
               const std::vector<Boundary>& boundaries) {
    resize(T_, padded(fluid.count));
#pragma omp parallel for schedule(dynamic, 8)
    for (std::size_t c = 0; c < fluid.clusters(); ++c) {
      const std::size_t first = c * lane_count;
      const VecLanes x = load(fluid.x, first);
      VecLanes n = zero_vector();
      const auto add = [&](const Sources& source, std::span<const ShiftedNeighbours> near) {
        over_neighbours(kernel, near, x, source.x,
                        [&](std::uint32_t j, const Neighbour& pair)
                            TORYU_INLINE_LAMBDA { add_product(n, source.V[j] * pair.G, pair.x_ij); });
      };
      add(sources(fluid), neighbours.near(c));
      for (const Boundary& wall : boundaries) add(sources(wall), wall.list_for_fluid.near(c));
      store(stress(n, load(fluid.rho, first)), T_, first);
    }
  }
  SurfaceTensionPair seen_from(std::size_t first) const {
    return {S_, load(T_, first), pointers(T_)};
  }

  /// T_i/rho_i^2.
  TORYU_INLINE TensorLanes stress(const VecLanes& n, const Lanes& rho) const {
    const Lanes n2 = max(dot(n, n), 1e-300), inverse_n = inverse_sqrt(n2);
    const Lanes tension = K_sigma_ * positive_part(n2 * inverse_n - n_0_) * inverse(rho * rho);
    TensorLanes T = zero_tensor();
    for (int a = 0; a < dim; ++a) {
      T[a][a] = tension;
      for (int b = 0; b < dim; ++b) T[a][b] -= tension * (n[a] * inverse_n) * (n[b] * inverse_n);
    }
    return T;
  }

 private:
  double K_sigma_, n_0_;
  SmoothKernel S_;
  TensorField T_ = {};
};

/// 1/K: the tension of a flat surface over sigma at K = 1, by sums over a square lattice, d_0 = `spacing`.
inline double tension_of_rows(const Kernel& W, const SmoothKernel& S, double n_0, double spacing) {
  const int reach = static_cast<int>(W.support() / spacing) + 1;
  const double V = spacing * spacing;
  double tension = 0;
  for (int row = 0; row < reach; ++row) {  // below the surface
    double n = 0, stretch = 0;
    for (int other = -row; other <= reach; ++other)
      for (int column = -reach; column <= reach; ++column) {
        const double r = spacing * std::hypot(other, column), x = spacing * column;
        if (r == 0) continue;
        n -= V * spacing * other * W.visit([r](const auto& form) { return form.gradient_over_r(r, 1 / r); });
        stretch -= V * x * x * S.gradient_over_r(r * r)[0];
      }
    tension += spacing * std::max(n - n_0, 0.0) * stretch;
  }
  return tension;
}

inline SurfaceTensionForce pair_force(const SurfaceTension& tension, const Medium& medium) {
  const double n_0 = 0.1 / medium.h(), support = medium.kernel.support();
  const double sum = tension_of_rows(medium.kernel, SmoothKernel(support), n_0, medium.d_0);
  return {tension.coefficient / sum, n_0, support};
}

/// That of the shortest capillary waves (Brackbill, Kothe & Zemach 1992) [s].
inline double time_step_limit(const SurfaceTension& tension, const Medium& medium) {
  const double h3 = std::pow(medium.h(), 3);
  return 0.25 * std::sqrt(medium.rho_0 * h3 / (2 * std::numbers::pi * tension.coefficient));
}

inline ActiveTerm text(const SurfaceTension& tension, const Medium&) {
  return {"surface tension", "sum_j m_j (T_i/rho_i^2 + T_j/rho_j^2) gradS_ij, T = K sigma (|n| I - n n/|n|)",
          "Lafaurie et al. 1994", fmt::format("sigma {} N/m", tension.coefficient)};
}

}  // namespace toryu::fluid
