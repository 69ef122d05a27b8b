#include "common/scene/fill_outline.hpp"

#include <chrono>
#include <cmath>

#include "common/scene/filling_cache.hpp"
#include "common/scene/place_index.hpp"
#include "common/sph/kernel.hpp"

namespace toryu {

namespace {

using Ring = Outline::Ring;

/// Over the spacing: h of the relaxation, so short that a particle's nearest neighbours count most; how much
/// farther neighbours are listed; pieces of the outline; how deep the first row may start and how exactly it
/// keeps its depth; the longest move of a round.
constexpr double relaxing_h = 1.0, skin = 0.3, longest_piece = 0.125, first_row = 0.75, on_row = 1e-6,
                 longest_move = 0.1;
/// What sides of a rectangle may be off a whole number of rows, over it.
constexpr double largest_misfit = 0.1;
/// Of a move, what is kept in the next round; what F adds, over d_0^2; the largest F [1/d_0] at the end.
constexpr double inertia = 0.9, step = 0.3, converged = 5e-4;
constexpr int most_rounds = 200;
constexpr int most_turns = 20;  // from one side of a corner to the other
constexpr std::chrono::seconds worth_keeping{1};

/// The lattice of a rectangle, in the order of its rows; empty if the outline is none that rows fit.
FittedFilling fill_rectangle(const Outline& outline, double spacing) {
  if (outline.rings().size() != 1 || outline.rings()[0].size() != 4) return {};
  const Ring& ring = outline.rings()[0];
  const Vec u = ring[1] - ring[0], w = ring[3] - ring[0];
  const double lengths[] = {u.norm(), w.norm()};
  const bool right_angles = std::abs(u.dot(w)) < 1e-9 * lengths[0] * lengths[1] &&
                            (ring[2] - ring[1] - w).norm() < 1e-9 * (lengths[0] + lengths[1]);
  if (!right_angles) return {};
  long rows[2];
  for (int a = 0; a < 2; ++a) {
    rows[a] = std::lround(lengths[a] / spacing);
    if (rows[a] < 1 || std::abs(lengths[a] / (static_cast<double>(rows[a]) * spacing) - 1) > largest_misfit)
      return {};
  }
  FittedFilling filling;
  for (long b = 0; b < rows[1]; ++b)
    for (long a = 0; a < rows[0]; ++a)
      filling.points.push_back(ring[0] + (static_cast<double>(a) + 0.5) / static_cast<double>(rows[0]) * u +
                               (static_cast<double>(b) + 0.5) / static_cast<double>(rows[1]) * w);
  filling.volume = outline.area() / static_cast<double>(filling.points.size());
  return filling;
}

/// Moves particles until they are even.
class Relaxation {
 public:
  Relaxation(const Outline& outline, std::vector<Vec>& points, double volume)
      : outline_(outline),
        x_(points),
        V_(volume),
        d_(std::sqrt(volume)),
        W_(relaxing_h * d_),
        pieces_(surface_pieces(outline, longest_piece * d_)),
        move_(points.size(), Vec::Zero()),
        moved_(points.size(), Vec::Zero()),
        row_(points.size(), 0),
        neighbours_(points.size()),
        beside_(points.size()) {
    for (std::size_t i = 0; i < x_.size(); ++i) row_[i] = outline.nearest(x_[i]).distance > -first_row * d_;
    find_neighbours();
  }

  /// The largest force [1/d_0].
  double round() {
    double largest = 0, furthest = 0;
    const auto n = static_cast<std::ptrdiff_t>(x_.size());
#pragma omp parallel for schedule(static) reduction(max : largest, furthest)
    for (std::ptrdiff_t k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      Vec F = force(i);
      if (row_[i]) {
        const Vec normal = outline_.nearest(x_[i]).normal;
        F -= F.dot(normal) * normal;
      }
      largest = std::max(largest, F.norm() * d_);
      move_[i] = inertia * move_[i] + step * d_ * d_ * F;
      if (const double length = move_[i].norm(); length > longest_move * d_)
        move_[i] *= longest_move * d_ / length;
    }
#pragma omp parallel for schedule(static) reduction(max : furthest)
    for (std::ptrdiff_t k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Vec before = x_[i];
      x_[i] += move_[i];
      bound(i);
      moved_[i] += x_[i] - before;
      furthest = std::max(furthest, moved_[i].norm());
    }
    if (furthest > 0.5 * skin * d_) find_neighbours();
    return largest;
  }

  /// Standard deviation of sum_j V W_ij over their mean, where the outline is out of reach.
  double spread() const {
    double sum = 0, squares = 0, count = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      if (!beside_[i].empty()) continue;
      double density = V_ * W_.value(0.0);
      for (const std::uint32_t j : neighbours_[i]) density += V_ * W_.value((x_[i] - x_[j]).norm());
      sum += density;
      squares += density * density;
      ++count;
    }
    return count > 0 ? std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count))) * count / sum
                     : 0.0;
  }

 private:
  Vec force(std::size_t i) const {
    Vec F = Vec::Zero();
    for (const std::uint32_t j : neighbours_[i]) {
      const Vec x_ij = x_[i] - x_[j];
      const double r = x_ij.norm();
      if (r > 0) F -= V_ * W_.gradient_over_r(r, 1 / r) * x_ij;
    }
    for (const std::uint32_t b : beside_[i])
      F -= W_.value((x_[i] - pieces_[b].place).norm()) * pieces_[b].area;
    return F;
  }

  /// Puts a particle of the first row back on its row, and one that came too near to the outline back to it.
  void bound(std::size_t i) {
    for (int turn = 0; turn < most_turns; ++turn) {  // in a corner from one side to the other
      const auto foot = outline_.nearest(x_[i]);
      const double way = -0.5 * d_ - foot.distance;
      if ((!row_[i] && way >= 0) || std::abs(way) < on_row * d_) return;
      x_[i] += way * foot.normal;
    }
  }

  void find_neighbours() {
    const double reach = W_.support() + skin * d_;
    PlaceIndex particles(outline_.bounds(), reach), pieces(outline_.bounds(), reach);
    for (std::size_t i = 0; i < x_.size(); ++i) particles.add(x_[i], static_cast<std::uint32_t>(i));
    for (std::size_t b = 0; b < pieces_.size(); ++b)
      pieces.add(pieces_[b].place, static_cast<std::uint32_t>(b));
    const auto n = static_cast<std::ptrdiff_t>(x_.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      neighbours_[i].clear();
      beside_[i].clear();
      particles.about(x_[i], [&](std::uint32_t j) {
        if (j != i && (x_[j] - x_[i]).norm() < reach) neighbours_[i].push_back(j);
      });
      pieces.about(x_[i], [&](std::uint32_t b) {
        if ((pieces_[b].place - x_[i]).norm() < reach) beside_[i].push_back(b);
      });
      moved_[i].setZero();
    }
  }

  const Outline& outline_;
  std::vector<Vec>& x_;
  double V_, d_;
  WendlandC2 W_;
  std::vector<SurfacePiece> pieces_;
  std::vector<Vec> move_, moved_;  ///< of this round, and since the neighbours were found
  std::vector<char> row_;          ///< whether it belongs to the first row
  std::vector<std::vector<std::uint32_t>> neighbours_, beside_;
};

}  // namespace

std::vector<SurfacePiece> surface_pieces(const Outline& outline, double longest) {
  std::vector<SurfacePiece> pieces;
  for (const Ring& ring : outline.rings())
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec edge = ring[(k + 1) % ring.size()] - ring[k];
      const int count = std::max(1, static_cast<int>(std::ceil(edge.norm() / longest)));
      for (int m = 0; m < count; ++m)
        pieces.push_back({ring[k] + (m + 0.5) / count * edge, Vec(edge[1], -edge[0]) / count});
    }
  return pieces;
}

namespace {

FittedFilling relaxed(const Outline& outline, double spacing, const std::function<void(double)>& told) {
  FittedFilling filling;
  filling.points = parallel_rows(outline, spacing);
  if (filling.points.empty()) return filling;
  filling.volume = outline.area() / static_cast<double>(filling.points.size());
  Relaxation relaxation(outline, filling.points, filling.volume);
  for (double largest = 2 * converged; largest > converged && filling.rounds < most_rounds;) {
    ++filling.rounds;
    largest = relaxation.round();
    if (told) told(static_cast<double>(filling.rounds) / most_rounds);
  }
  filling.spread = relaxation.spread();
  return filling;
}

}  // namespace

FittedFilling fill_outline(const Outline& outline, double spacing, const std::function<void(double)>& told) {
  FittedFilling lattice = fill_rectangle(outline, spacing);
  if (!lattice.points.empty()) return lattice;
  const auto file = cached_filling(outline, spacing);
  if (auto kept = read_filling(file)) return *kept;
  const auto start = std::chrono::steady_clock::now();
  FittedFilling filling = relaxed(outline, spacing, told);
  if (std::chrono::steady_clock::now() - start > worth_keeping) keep_filling(filling, file);
  return filling;
}

std::vector<Vec> area_vectors(const std::vector<Vec>& points, const std::vector<SurfacePiece>& pieces,
                              double reach) {
  std::vector<Vec> areas(points.size(), Vec::Zero());
  if (points.empty()) return areas;
  Box bounds{points[0], points[0]};
  for (const Vec& x : points) {
    bounds.min = bounds.min.cwiseMin(x);
    bounds.max = bounds.max.cwiseMax(x);
  }
  PlaceIndex index(bounds, reach);
  for (std::size_t i = 0; i < points.size(); ++i) index.add(points[i], static_cast<std::uint32_t>(i));
  for (const SurfacePiece& piece : pieces) {
    double least = reach * reach;
    Vec* nearest = nullptr;
    index.about(piece.place, [&](std::uint32_t i) {
      const double square = (points[i] - piece.place).squaredNorm();
      if (square >= least) return;
      least = square;
      nearest = &areas[i];
    });
    if (nearest) *nearest += piece.area;
  }
  return areas;
}

}  // namespace toryu
