#include "solid_solver/total_lagrangian/stress_recovery.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace toryu::solid {

static_assert(dim == 2, "the polynomials are those of the plane");

namespace {

constexpr double fit_reach = 3.2, face_reach = 2.0, surface_depth = 1.25, deep = 1.5;  // over the spacing
/// Smallest over largest pivot of the moments with which a fit of each order is trusted: about a point on the
/// surface the lattice determines a quadratic, from a depth of one and a half rows on a cubic. Rows that fit
/// an outline are good enough for a cubic there too, which a curved surface needs: a quadratic lacks 5 % of
/// the strain along a hole of 10 rows.
constexpr double least_pivot(int order, bool fitted) {
  return order < 3 ? 1e-4 : fitted ? 1e-6 : 4e-4;
}

double weight(double r_over_reach) {
  const double q = 1.0 - r_over_reach * r_over_reach;
  return q > 0 ? q * q : 0.0;
}

/// Those of `near` that neighbours of one material join to the one nearest to `point`, which is the first,
/// and none that is held.
std::vector<std::uint32_t> joined(const Body& body, std::vector<std::uint32_t> near, const Vec& point) {
  std::erase_if(near, [&](std::uint32_t j) { return body.held[j]; });
  const auto distance = [&](std::uint32_t j) { return (body.X[j] - point).norm(); };
  const auto nearest =
      std::min_element(near.begin(), near.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
  if (nearest == near.end()) return {};
  const std::uint32_t material = body.material[*nearest];
  std::iter_swap(near.begin(), nearest);
  std::erase_if(near, [&](std::uint32_t j) { return body.material[j] != material; });
  std::size_t found = 1;
  for (std::size_t k = 0; k < found; ++k)
    for (std::size_t l = found; l < near.size(); ++l)
      if ((body.X[near[l]] - body.X[near[k]]).norm() < 1.6 * body.spacing) std::swap(near[found++], near[l]);
  near.resize(found);
  return near;
}

}  // namespace

BodyIndex::BodyIndex(const Body& body)
    : body_(body), width_(fit_reach * body.spacing), by_strip_(body.size()), rank_by_x_(body.size()) {
  std::iota(by_strip_.begin(), by_strip_.end(), 0u);
  std::stable_sort(by_strip_.begin(), by_strip_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return body.X[a][0] < body.X[b][0]; });
  std::uint32_t rank = 0;
  for (const std::uint32_t j : by_strip_) rank_by_x_[j] = rank++;
  std::stable_sort(by_strip_.begin(), by_strip_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(strip_of(a), body.X[a][1]) < std::pair(strip_of(b), body.X[b][1]);
  });
}

std::vector<std::uint32_t> BodyIndex::about(const Vec& point, double reach) const {
  std::vector<std::uint32_t> found;
  const double first = strip_at(point[0] - reach);
  const int count = static_cast<int>(strip_at(point[0] + reach) - first) + 1;
  for (int k = 0; k < count; ++k) {
    const std::pair lowest(first + k, point[1] - reach);
    auto j = std::partition_point(by_strip_.begin(), by_strip_.end(), [&](std::uint32_t i) {
      return std::pair(strip_of(i), body_.X[i][1]) < lowest;
    });
    for (; j != by_strip_.end() && strip_of(*j) == first + k && body_.X[*j][1] <= point[1] + reach; ++j)
      if ((body_.X[*j] - point).norm() < reach) found.push_back(*j);
  }
  std::sort(found.begin(), found.end(),
            [&](std::uint32_t a, std::uint32_t b) { return rank_by_x_[a] < rank_by_x_[b]; });
  return found;
}

template <int order>
bool GradientFit::fit(const Body& body, const Vec& point, const std::vector<std::uint32_t>& near) {
  constexpr int terms = (order + 1) * (order + 2) / 2;
  using Basis = Eigen::Matrix<double, terms, 1>;
  using Moments = Eigen::Matrix<double, terms, terms>;
  if (near.size() < terms) return false;
  const double reach = fit_reach * body.spacing;
  const auto basis = [&](std::uint32_t j) {
    const Vec r = (body.X[j] - point) / reach;
    Basis P;
    int term = 0;
    for (int n = 0; n <= order; ++n)
      for (int m = 0; m <= n; ++m) P[term++] = std::pow(r[0], n - m) * std::pow(r[1], m);
    return P;
  };
  const auto share = [&](std::uint32_t j) { return weight((body.X[j] - point).norm() / reach); };
  Moments moments = Moments::Zero();
  for (const std::uint32_t j : near) moments += share(j) * basis(j) * basis(j).transpose();
  Eigen::FullPivLU<Moments> solver(moments);
  solver.setThreshold(least_pivot(order, body.has_outline()));
  if (!solver.isInvertible()) return false;
  const Basis along_x = solver.solve(Basis::Unit(1)), along_y = solver.solve(Basis::Unit(2));
  particles_ = near;
  weights_.clear();
  for (const std::uint32_t j : near) {
    const double scale = share(j) / reach;
    weights_.push_back({scale * along_x.dot(basis(j)), scale * along_y.dot(basis(j))});
  }
  return true;
}

GradientFit::GradientFit(const BodyIndex& index, const Vec& point) {
  const Body& body = index.body();
  const auto near = joined(body, index.about(point, fit_reach * body.spacing), point);
  fit<3>(body, point, near) || fit<2>(body, point, near) || fit<1>(body, point, near);
}

namespace {

/// Of a body whose outline is known.
std::optional<FreeSurface> find_outline(const BodyIndex& index, const Vec& point) {
  const Body& body = index.body();
  const double d_0 = body.spacing;
  const auto foot = body.foot(point);
  const double depth = foot ? std::max(-foot->distance, 0.0) : 0.0;
  if (!foot || depth > surface_depth * d_0) return std::nullopt;
  std::vector<std::uint32_t> faces;
  for (const std::uint32_t j : index.about(foot->place, face_reach * d_0))
    if (!body.area_vector[j].isZero(0)) faces.push_back(j);
  GradientFit deeper(index, foot->place - deep * d_0 * foot->normal);
  if (faces.empty() || !deeper.found()) return std::nullopt;
  return FreeSurface{foot->normal, depth / (deep * d_0), std::move(faces), std::move(deeper), foot->place};
}

std::optional<FreeSurface> find_surface(const BodyIndex& index, const Vec& point) {
  const Body& body = index.body();
  if (body.has_outline()) return find_outline(index, point);
  const double d_0 = body.spacing, reach = face_reach * d_0;
  Vec normal = Vec::Zero(), middle = Vec::Zero();
  double area = 0;
  std::vector<std::uint32_t> faces;
  for (const std::uint32_t j : index.about(point, reach + d_0)) {
    const Vec A = body.area_vector[j];
    for (int a = 0; a < dim; ++a) {
      const Vec outward = std::copysign(1.0, A[a]) * Vec::Unit(a);
      const Vec centre = body.X[j] + 0.5 * body.cell[j][a] * outward;
      const double share = weight((centre - point).norm() / reach) * std::abs(A[a]);
      if (share == 0) continue;
      normal += share * outward;
      middle += share * centre;
      area += share;
      faces.push_back(j);
    }
  }
  if (!(normal.norm() > 0.5 * area)) return std::nullopt;  // no face, or two that face each other
  normal.normalize();
  const double depth = std::max(normal.dot(middle / area - point), 0.0);
  if (depth > surface_depth * d_0) return std::nullopt;
  GradientFit deeper(index, point - (deep * d_0 - depth) * normal);
  if (!deeper.found()) return std::nullopt;
  return FreeSurface{normal, depth / (deep * d_0), std::move(faces), std::move(deeper)};
}

}  // namespace

RecoveredPoint::RecoveredPoint(const BodyIndex& index, const Vec& point)
    : fit(index, point), surface(find_surface(index, point)) {}

}  // namespace toryu::solid
