/// The smooth part of what a step's system answers, for its preconditioner: velocities on a grid some
/// spacings wide, by quadratic B-splines b_n(x). Blocks of single particles see a long wave only bit by bit;
/// the grid sees it at once. Both are added (Dryja & Widlund 1990):
///
///     M^-1 r = D^-1 r + P A_c^-1 P^T m r,   (P w)_i = sum_n b_n(x_i) w_n
///
/// with D the diagonal blocks of the system 1 - dt da/dv and A_c what m (1 - dt da/dv) is to velocities of
/// the grid, by integrals over the particles, gradients those of the splines:
///
///     w . A_c w = sum_i m_i w^2 + dt V_i eta_i |grad w|^2 + dt^2 V_i rho_i c_i^2 (div w)^2
///               + sum_k 16 dt V_k eta_k w^2/d_0^2     k: particles of walls, which hold the medium
///
/// A piston that is pressed (pistons.hpp) has one more unknown, its speed u, with M u^2 in the sum and (w -
/// u)^2 for w^2 at its own particles: what the medium resists to its motion comes out, as the complement of
/// Schur.
///
/// The grid is centred on the medium: beside a symmetric flow what a step leaves unsolved is symmetric too.
/// Particles in a shear part from each other exponentially, by e in two or three of the wall's shears; begun
/// at the tolerance, and not at rounding, the halves of a slit 10 across differed by 2 % in their mean speed
/// after a stroke of four widths.
///
/// It is symmetric and positive, of few neighbours each, and factorised by Cholesky's method in its band. It
/// does not know of periods, where it is left out, and need not be exact: it changes the number of products,
/// and not what a step is solved for.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "common/sph/points.hpp"

namespace toryu::fluid {

class CoarseFlow {
 public:
  using Vector = Eigen::VectorXd;

  /// Whether it has no more cells than there are particles: a band over empty space costs more than it wins.
  static bool pays(const VecField& x, std::size_t count, double width);

  /// Over the first `count` particles at `x`; cells `width` [m] wide. A piston has a mass M, and the mass m
  /// by which its row stands in the system [kg/m].
  struct Piston {
    double mass, row_mass;
  };
  CoarseFlow(const VecField& x, std::size_t count, double width, const std::vector<Piston>& pistons = {});

  /// A particle of the fluid, by m [kg/m], dt V eta and dt^2 V rho c^2 [kg.m].
  void add(const Vec& x, double mass, double viscous, double compressive);
  /// One of a wall, by 16 dt V eta/d_0^2 [kg/m]; left out where it is beyond the grid.
  void hold(const Vec& x, double weight);
  /// The same of one of a piston, which moves along `axis`.
  void hold(const Vec& x, double weight, Eigen::Index piston, const Vec& axis);
  void factorise();

  /// P A_c^-1 P^T m r of the particles at `x` with masses `m`; all their r, first components first, then
  /// those of the pistons.
  Vector correction(const VecField& x, const Field& m, const Vector& r) const;

 private:
  static constexpr int near = 3;  ///< nodes along an axis
  /// The splines of the nodes near a place.
  struct Splines {
    std::array<Eigen::Index, std::size_t{near} * near> node{};
    std::array<double, std::size_t{near} * near> value{};
    std::array<Vec, std::size_t{near} * near> slope{};
  };
  bool covers(const Vec& x) const;
  Splines splines(const Vec& x) const;
  double& entry(Eigen::Index row, Eigen::Index column) { return band_(half_ - (row - column), row); }
  /// Solves in the band, behind `half_` zeros.
  void solve(Vector& w) const;

  double width_;
  Vec origin_;                                  ///< [m]
  std::array<Eigen::Index, dim> cells_, step_;  ///< along each axis; from node to node
  Eigen::Index half_;                           ///< width of the band below the diagonal
  Eigen::MatrixXd band_;  ///< row by row: of row i columns i - half_ to i; then the factor
  // of the pistons
  Vector row_mass_;         ///< [kg/m]
  Eigen::MatrixXd border_;  ///< columns of the matrix beside the band, behind `half_` zeros
  Eigen::MatrixXd solved_;  ///< those in the band
  Eigen::MatrixXd own_;     ///< of the matrix; then the inverse of its complement
};

}  // namespace toryu::fluid
