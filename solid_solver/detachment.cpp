#include "solid_solver/detachment.hpp"

#include <cmath>

namespace toryu {

namespace {

/// Over the spacing: side and diagonal of a lattice's cell, also where a region's cells are a little longer.
constexpr double reach_of_adjacent = 1.5;

/// The points in storage order, with an index to find those in a box.
struct SortedPoints {
  SortedPoints(const std::vector<Vec>& points, StripOrder& strips) : strips_(strips) {
    Field x, y;
    for (const Vec& point : points) {
      x.push_back(point[0]);
      y.push_back(point[1]);
    }
    order = strips.sort(x, y, points.size());
    resize(sorted, points.size());
    for (std::size_t k = 0; k < points.size(); ++k) set(sorted, k, points[order[k]]);
    strips.index(sorted[0], points.size());
  }
  /// Calls visit(j) for the numbers of all points nearer than `reach` to `point`.
  template <class Visit>
  void near(const Vec& point, double reach, Visit&& visit) const {
    strips_.in_box(sorted[1], point[0] - reach, point[0] + reach, point[1] - reach, point[1] + reach,
                   [&](std::size_t begin, std::size_t end) {
                     for (std::size_t k = begin; k < end; ++k)
                       if ((at(sorted, k) - point).squaredNorm() < reach * reach) visit(order[k]);
                   });
  }
  const StripOrder& strips_;
  std::vector<std::uint32_t> order;
  VecField sorted;
};

}  // namespace

DetachmentObserver::DetachmentObserver(const SolidBody& body, const SolidParameters& parameters)
    : body_(body),
      density_(parameters.material.density),
      bond_length_(parameters.detachment->bond_length > 0 ? parameters.detachment->bond_length * body.spacing
                                                          : 2.0 * parameters.h()),
      interval_(parameters.detachment->interval),
      strips_(bond_length_),
      detached_(body.size(), 0),
      ever_detached_(body.size(), 0) {
  const SortedPoints points(body.X, strips_);
  for (std::uint32_t i = 0; i < body.size(); ++i)
    points.near(body.X[i], reach_of_adjacent * body.spacing, [&](std::uint32_t j) {
      if (i < j) adjacent_.emplace_back(i, j);
    });
}

std::vector<char> DetachmentObserver::reached_from_clamps(const std::vector<Vec>& x) {
  const SortedPoints points(x, strips_);
  std::vector<char> reached(body_.held);
  std::vector<std::uint32_t> front;
  for (std::uint32_t i = 0; i < x.size(); ++i)
    if (reached[i]) front.push_back(i);
  while (!front.empty()) {
    std::vector<std::uint32_t> next;
    for (const auto i : front)
      points.near(x[i], bond_length_, [&](std::uint32_t j) {
        if (reached[j]) return;
        reached[j] = 1;
        next.push_back(j);
      });
    front.swap(next);
  }
  return reached;
}

bool DetachmentObserver::look(const std::vector<Vec>& x, double time) {
  next_ = (std::floor(time / interval_ + 1e-9) + 1) * interval_;
  const auto reached = reached_from_clamps(x);
  const std::size_t before = list_.size();
  for (std::uint32_t i = 0; i < x.size(); ++i) {
    detached_[i] = !reached[i];
    if (!detached_[i] || ever_detached_[i]) continue;
    ever_detached_[i] = 1;
    list_.push_back({i, time, density_ * body_.volume(i), body_.X[i], x[i]});
  }
  return list_.size() > before;
}

Stretches DetachmentObserver::stretches(const std::vector<Vec>& x) const {
  Stretches found;
  for (const auto& [i, j] : adjacent_) {
    const double stretch = (x[i] - x[j]).norm() / (body_.X[i] - body_.X[j]).norm();
    found = {std::max(found.largest, stretch), std::min(found.smallest, stretch)};
  }
  return found;
}

}  // namespace toryu
