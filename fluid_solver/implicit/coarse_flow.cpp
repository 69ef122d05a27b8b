#include "fluid_solver/implicit/coarse_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace toryu::fluid {

namespace {

/// A node that hardly any particle sees is left where it is.
constexpr double smallest_pivot = 1e-10;

std::pair<double, double> bounds(const Field& x, std::size_t count) {
  const auto [least, most] = std::minmax_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(count));
  return {*least, *most};
}

}  // namespace

bool CoarseFlow::pays(const VecField& x, std::size_t count, double width) {
  double cells = 1;
  for (const Field& component : x) {
    const auto [least, most] = bounds(component, count);
    cells *= (most - least) / width;
  }
  return cells <= static_cast<double>(count);
}

CoarseFlow::CoarseFlow(const VecField& x, std::size_t count, double width, const std::vector<Piston>& pistons)
    : width_(width) {
  for (int a = 0; a < dim; ++a) {
    const auto [least, most] = bounds(x[a], count);
    cells_[a] = static_cast<Eigen::Index>((most - least) / width) + 3;  // a cell and more for the walls
    origin_[a] = 0.5 * (least + most - static_cast<double>(cells_[a]) * width);
  }
  const int across = cells_[1] <= cells_[0] ? 1 : 0;  // the shorter way first: a narrow band
  step_[across] = 1;
  step_[1 - across] = cells_[across] + near - 1;
  const Eigen::Index nodes = step_[1 - across] * (cells_[1 - across] + near - 1);
  half_ = Eigen::Index{dim} * (near - 1) * (step_[0] + step_[1]) + dim - 1;
  band_ = Eigen::MatrixXd::Zero(half_ + 1, dim * nodes);
  const auto piston_count = static_cast<Eigen::Index>(pistons.size());
  border_ = Eigen::MatrixXd::Zero(half_ + dim * nodes, piston_count);
  own_ = Eigen::MatrixXd::Zero(piston_count, piston_count);
  row_mass_.resize(piston_count);
  for (Eigen::Index k = 0; k < piston_count; ++k) {
    const auto& [mass, row_mass] = pistons[static_cast<std::size_t>(k)];
    own_(k, k) = mass;
    row_mass_[k] = row_mass;
  }
}

bool CoarseFlow::covers(const Vec& x) const {
  for (int a = 0; a < dim; ++a) {
    const double s = (x[a] - origin_[a]) / width_;
    if (!(s >= 0 && s < static_cast<double>(cells_[a]))) return false;
  }
  return true;
}

CoarseFlow::Splines CoarseFlow::splines(const Vec& x) const {
  std::array<std::array<double, near>, dim> value, slope;
  Eigen::Index first = 0;
  for (int a = 0; a < dim; ++a) {
    const double s = (x[a] - origin_[a]) / width_, cell = std::floor(s), t = s - cell;
    first += step_[a] * static_cast<Eigen::Index>(cell);
    value[a] = {0.5 * (1 - t) * (1 - t), 0.5 + t - t * t, 0.5 * t * t};
    slope[a] = {(t - 1) / width_, (1 - 2 * t) / width_, t / width_};
  }
  Splines all;
  for (std::size_t k = 0; k < near; ++k)
    for (std::size_t l = 0; l < near; ++l) {
      const std::size_t n = near * k + l;
      all.node[n] = first + step_[0] * static_cast<Eigen::Index>(k) + step_[1] * static_cast<Eigen::Index>(l);
      all.value[n] = value[0][k] * value[1][l];
      all.slope[n] = Vec(slope[0][k] * value[1][l], value[0][k] * slope[1][l]);
    }
  return all;
}

void CoarseFlow::add(const Vec& x, double mass, double viscous, double compressive) {
  const Splines s = splines(x);
  for (std::size_t p = 0; p < s.node.size(); ++p)
    for (std::size_t q = 0; q < s.node.size(); ++q) {
      if (s.node[q] > s.node[p]) continue;
      const double same = mass * s.value[p] * s.value[q] + viscous * s.slope[p].dot(s.slope[q]);
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < (p == q ? a + 1 : dim); ++b)
          entry(dim * s.node[p] + a, dim * s.node[q] + b) +=
              (a == b ? same : 0.0) + compressive * s.slope[p][a] * s.slope[q][b];
    }
}

void CoarseFlow::hold(const Vec& x, double weight) {
  if (covers(x)) add(x, weight, 0, 0);
}

void CoarseFlow::hold(const Vec& x, double weight, Eigen::Index piston, const Vec& axis) {
  if (!covers(x)) return;
  own_(piston, piston) += weight;
  hold(x, weight);
  const Splines s = splines(x);
  for (std::size_t p = 0; p < s.node.size(); ++p)
    for (int a = 0; a < dim; ++a)
      border_(half_ + dim * s.node[p] + a, piston) -= weight * s.value[p] * axis[a];
}

void CoarseFlow::factorise() {
  for (Eigen::Index i = 0; i < band_.cols(); ++i) {
    const double before = band_(half_, i);
    for (Eigen::Index j = std::max<Eigen::Index>(0, i - half_); j < i; ++j) {
      const Eigen::Index shared = half_ - (i - j);  // columns of both rows before j
      const double sum = band_.col(i).head(shared).dot(band_.col(j).segment(half_ - shared, shared));
      entry(i, j) = (entry(i, j) - sum) / band_(half_, j);
    }
    const double pivot = before - band_.col(i).head(half_).squaredNorm();
    band_(half_, i) =
        pivot > smallest_pivot * before ? std::sqrt(pivot) : std::numeric_limits<double>::infinity();
  }
  solved_ = border_;
  for (Eigen::Index k = 0; k < solved_.cols(); ++k) {
    Vector column = solved_.col(k);
    solve(column);
    solved_.col(k) = column;
  }
  own_ = (own_ - border_.transpose() * solved_).inverse().eval();
}

void CoarseFlow::solve(Vector& w) const {
  const Eigen::Index n = band_.cols();
  for (Eigen::Index i = 0; i < n; ++i)
    w[half_ + i] = (w[half_ + i] - band_.col(i).head(half_).dot(w.segment(i, half_))) / band_(half_, i);
  for (Eigen::Index i = n - 1; i >= 0; --i) {
    w[half_ + i] /= band_(half_, i);
    w.segment(i, half_) -= w[half_ + i] * band_.col(i).head(half_);
  }
}

CoarseFlow::Vector CoarseFlow::correction(const VecField& x, const Field& m, const Vector& r) const {
  const Eigen::Index pistons = own_.cols(), count = (r.size() - pistons) / dim, n = band_.cols();
  Vector w = Vector::Zero(n + half_);  // behind zeros, as the rows of the band
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Splines s = splines(at(x, k));
    for (std::size_t p = 0; p < s.node.size(); ++p)
      for (int a = 0; a < dim; ++a) w[half_ + dim * s.node[p] + a] += s.value[p] * m[k] * r[a * count + i];
  }
  solve(w);
  Vector found(r.size());
  if (pistons > 0) {
    const Vector u = own_ * (row_mass_.cwiseProduct(r.tail(pistons)) - border_.transpose() * w);
    w -= solved_ * u;
    found.tail(pistons) = u;
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const Splines s = splines(at(x, static_cast<std::size_t>(i)));
    Vec sum = Vec::Zero();
    for (std::size_t p = 0; p < s.node.size(); ++p)
      for (int a = 0; a < dim; ++a) sum[a] += s.value[p] * w[half_ + dim * s.node[p] + a];
    for (int a = 0; a < dim; ++a) found[a * count + i] = sum[a];
  }
  return found;
}

}  // namespace toryu::fluid
