/// Particles typed by hand, and the sums of one term over them.
#pragma once

#include <array>
#include <numeric>
#include <vector>

#include "fluid_solver/terms/pair.hpp"

namespace toryu::fluid {

/// One particle of a pair, with all that a term may read of it.
struct Point {
  Vec x = Vec::Zero(), v = Vec::Zero();
  double rho = 1000, m = 1, p = 0;
  Vec grad_rho = Vec::Zero();
  double eta = 1;
  Eigen::Matrix2d eta_grad_v = Eigen::Matrix2d::Zero();  ///< (a, b): eta dv_b/dx_a
  Symmetric<double> polymer_stress = {0, 0, 0};
};

/// What a pair loop reads of `points`.
struct FewSources {
  FewSources(std::initializer_list<Point> points) : FewSources(std::vector<Point>(points)) {}
  FewSources(const std::vector<Point>& points) {
    const std::size_t n = points.size();
    for (auto* field : {&x, &v, &grad_rho}) resize(*field, n);
    resize(eta_grad_v, n);
    for (const auto& point : points) {
      const std::size_t j = m.size();
      set(x, j, point.x);
      set(v, j, point.v);
      set(grad_rho, j, point.grad_rho);
      m.push_back(point.m);
      V.push_back(point.m / point.rho);
      rho.push_back(point.rho);
      p_rho2.push_back(point.p / (point.rho * point.rho));
      eta.push_back(point.eta);
      for (int a = 0; a < dim; ++a) set(eta_grad_v[a], j, point.eta_grad_v.row(a));
      polymer_stress.xx.push_back(point.polymer_stress.xx);
      polymer_stress.yy.push_back(point.polymer_stress.yy);
      polymer_stress.xy.push_back(point.polymer_stress.xy);
    }
  }
  Sources view() const {
    return {.x = pointers(x),
            .v = pointers(v),
            .v_viscous = pointers(v),
            .grad_rho = pointers(grad_rho),
            .m = m.data(),
            .V = V.data(),
            .rho = rho.data(),
            .p_rho2 = p_rho2.data(),
            .eta = eta.data(),
            .eta_grad_v = pointers(eta_grad_v),
            .polymer_stress = pointers(polymer_stress)};
  }
  VecField x, v, grad_rho;
  TensorField eta_grad_v;
  Symmetric<Field> polymer_stress;
  Field m, V, rho, p_rho2, eta;
};

/// `i` in every lane.
inline Targets targets(const Point& i) {
  const auto lanes = [](const Vec& value) { return VecLanes{Lanes(value[0]), Lanes(value[1])}; };
  const VecLanes v = lanes(i.v);
  return {lanes(i.x),
          v,
          v,
          lanes(i.grad_rho),
          Lanes(i.rho),
          Lanes(i.p / (i.rho * i.rho)),
          Lanes(i.eta),
          {lanes(i.eta_grad_v.row(0)), lanes(i.eta_grad_v.row(1))},
          {Lanes(i.polymer_stress.xx), Lanes(i.polymer_stress.yy), Lanes(i.polymer_stress.xy)}};
}

/// What `add(targets, sources, j, pair, rates)` adds up for particle `i` over `sources`.
template <class W, class Add>
Rates sum_over(const Point& i, const FewSources& sources, const W& kernel, Add&& add) {
  const Sources view = sources.view();
  const Targets target = targets(i);
  std::vector<std::uint32_t> all(sources.m.size());
  std::iota(all.begin(), all.end(), 0u);
  const ShiftedNeighbours list{Vec::Zero(), all};
  Rates rates;
  over_neighbours(kernel, std::span(&list, 1), target.x, view.x, [&](std::uint32_t j, const Neighbour& n) {
    const Pair pair = make_pair(kernel, n, target, view, j);
    add(target, view, j, pair, rates);
    rates.close(pair, view.m[j]);
  });
  return rates;
}

inline Vec first_lane(const VecLanes& value) {
  return {value[0][0], value[1][0]};
}

/// gradW_ij of particles at x_i and x_j, by the kernel's formula (11) alone.
inline Vec grad_W(const Vec& x_i, const Vec& x_j, double h) {
  const Vec x_ij = x_i - x_j;
  const double r = x_ij.norm(), s = r / h, f_0 = 10.0 / (7.0 * std::numbers::pi);
  double slope = 0;
  if (s < 1)
    slope = f_0 * (-3 * s + 2.25 * s * s);
  else if (s < 2)
    slope = -0.75 * f_0 * (2 - s) * (2 - s);
  return slope / (h * h * h) * x_ij / r;
}

}  // namespace toryu::fluid
