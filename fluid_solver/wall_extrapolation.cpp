#include "fluid_solver/wall_extrapolation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/sph/neighbour_loop.hpp"
#include "fluid_solver/wall_turning.hpp"

namespace toryu::fluid {

namespace {

// No length of a case is as small [m].
constexpr double tiny = 1e-30;
// What lies nearer to the face counts as this far, over the spacing: the velocity there is divided by it.
constexpr double least_distance = 0.25;
// Rows whose distances from the face spread less than this share tell no bend; the line in steps of h^2.
constexpr double least_bend = 0.01, least_spread = 0.005;

/// The face through which they see the fluid, if there is one.
struct Face {
  VecLanes normal = zero_vector();
  Lanes depth = 0.0, separation = 0.0;
  Lanes curvature = 0.0;
  bool bends = false;  ///< whether any has a curvature
  Lanes::Mask found() const { return separation > 0.0; }
  /// Of a particle of the fluid at x_w - x_i, if it is before the face: with d from the tangent and t along
  /// it, kappa of the circle, sqrt((1 + kappa d)^2 + kappa^2 t^2) = 1 + kappa times the distance from the
  /// circle.
  TORYU_INLINE Lanes distance(const VecLanes& x_wi) const {
    const Lanes d = -dot(normal, x_wi) - depth;
    if (!bends) return d;
    static_assert(dim == 2, "one way along the tangent");
    const Lanes t = normal[0] * x_wi[1] - normal[1] * x_wi[0];
    const Lanes twice = 2.0 * d + curvature * (d * d + t * t);
    return twice / (1.0 + square_root(positive_part(1.0 + curvature * twice)));
  }
};

/// The mean of x_w - x_i.
template <class W>
VecLanes mean_distance(const Boundary& boundary, const Particles& fluid, const W& kernel,
                       std::size_t cluster) {
  Lanes sum_W = 0.0;
  VecLanes sum_x = zero_vector();
  over_neighbours(kernel, boundary.list_for_wall.near(cluster), load(boundary.x, cluster * lane_count),
                  pointers(fluid.x), [&](std::uint32_t, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    const Lanes W_wi = kernel.value(n.r);
                    sum_W += W_wi;
                    add_product(sum_x, W_wi, n.x_ij);
                  });
  return product(inverse(max(sum_W, smallest_share * kernel.value(0.0))), sum_x);
}

template <class W>
Face face_towards(const Boundary& boundary, const Particles& fluid, const W& kernel, std::size_t cluster) {
  const std::size_t first = cluster * lane_count;
  VecLanes x_wi = mean_distance(boundary, fluid, kernel, cluster);
  if (boundary.turns()) x_wi = product(boundary.orientation.transpose(), x_wi);  // as the faces are told
  Face face;
  for (int a = 0; a < dim; ++a)
    for (const double side : {1.0, -1.0}) {
      const Lanes depth = load((side > 0 ? boundary.depth_up : boundary.depth_down)[a], first);
      const Lanes separation = -side * x_wi[a] - depth;
      const auto better = separation > face.separation;
      for (int b = 0; b < dim; ++b) face.normal[b] = select(better, b == a ? side : 0.0, face.normal[b]);
      face.depth = select(better, depth, face.depth);
      face.separation = select(better, separation, face.separation);
    }
  if (!boundary.to_outline[0].empty()) {
    const VecLanes way = load(boundary.to_outline, first);
    const Lanes depth = square_root(dot(way, way));
    const VecLanes normal = product(inverse(max(depth, tiny)), way);
    const Lanes separation = -dot(normal, x_wi) - depth;
    const auto better = (depth > 0.0) & (separation > face.separation);
    for (int b = 0; b < dim; ++b) face.normal[b] = select(better, normal[b], face.normal[b]);
    face.depth = select(better, depth, face.depth);
    face.separation = select(better, separation, face.separation);
    face.curvature = select(better, load(boundary.curvature, first), 0.0);
    face.bends = any_of((face.curvature < 0.0) | (face.curvature > 0.0));
  }
  if (boundary.turns()) face.normal = product(boundary.orientation, face.normal);
  return face;
}

/// v = g d + c d^2.
class ParabolaFit {
 public:
  TORYU_INLINE void add(const Lanes& W, const Lanes& d, const VecLanes& v) {
    const Lanes W_d = W * d, W_d2 = W_d * d;
    d2_ += W_d2, d3_ += W_d2 * d, d4_ += W_d2 * d * d;
    add_product(dv_, W_d, v);
    add_product(d2v_, W_d2, v);
  }
  /// At the depth `d` behind the face, of component a. A single row has no bend.
  TORYU_INLINE Lanes behind(const Lanes& d, int a) const {
    const Lanes c = share() * (d2_ * d2v_[a] - d3_ * dv_[a]);
    return (c * d - rate(a)) * d;
  }
  /// g, of component a.
  TORYU_INLINE Lanes rate(int a) const { return share() * (stiff() * dv_[a] - d3_ * d2v_[a]); }

 private:
  TORYU_INLINE Lanes stiff() const { return (1 + least_bend) * d4_; }
  TORYU_INLINE Lanes share() const { return inverse(max(d2_ * stiff() - d3_ * d3_, 1e-300)); }

  Lanes d2_ = 0.0, d3_ = 0.0, d4_ = 0.0;
  VecLanes dv_ = zero_vector(), d2v_ = zero_vector();
};

/// Lines in d through several values at once.
template <std::size_t count>
class LineFits {
 public:
  TORYU_INLINE void add(const Lanes& W, const Lanes& d, const std::array<double, count>& values) {
    const Lanes W_d = W * d;
    sum_ += W, d_ += W_d, d2_ += W_d * d;
    for (std::size_t k = 0; k < count; ++k) {
      value_[k] += W * values[k];
      d_value_[k] += W_d * values[k];
    }
  }
  /// The values at the depth `d` behind the face. Distances that spread by less than the square root of
  /// `spread` [m2] tell no slope.
  TORYU_INLINE std::array<Lanes, count> behind(const Lanes& d, const Lanes& spread) const {
    const Lanes share = inverse(max(sum_, 1e-300)), middle = share * d_;
    const Lanes steepness = inverse(share * d2_ - middle * middle + spread);
    std::array<Lanes, count> values;
    for (std::size_t k = 0; k < count; ++k) {
      const Lanes mean = share * value_[k], slope = steepness * (share * d_value_[k] - middle * mean);
      values[k] = mean - slope * (d + middle);
    }
    return values;
  }

 private:
  Lanes sum_ = 0.0, d_ = 0.0, d2_ = 0.0;
  std::array<Lanes, count> value_ = filled(), d_value_ = filled();
  static std::array<Lanes, count> filled() {
    std::array<Lanes, count> zeros;
    zeros.fill(0.0);
    return zeros;
  }
};

template <class W>
void extrapolate_to_cluster(Boundary& boundary, const Particles& fluid, const W& kernel, const Vec& gravity,
                            std::size_t cluster) {
  const double smallest_sum = smallest_share * kernel.value(0.0);
  const std::size_t first = cluster * lane_count;
  Lanes sum_W = 0.0, sum_p = 0.0;
  VecLanes sum_v = zero_vector(), sum_rho_x = zero_vector();
  over_neighbours(kernel, boundary.list_for_wall.near(cluster), load(boundary.x, first), pointers(fluid.x),
                  [&](std::uint32_t i, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    const Lanes W_wi = kernel.value(n.r);
                    sum_W += W_wi;
                    sum_p += fluid.p[i] * W_wi;
                    for (int a = 0; a < dim; ++a) {
                      sum_v[a] += fluid.v[a][i] * W_wi;
                      sum_rho_x[a] += (fluid.rho[i] * W_wi) * n.x_ij[a];
                    }
                  });
  const Lanes share = inverse(max(sum_W, smallest_sum));
  const VecLanes a_w = boundary.acceleration[0].empty() ? zero_vector() : load(boundary.acceleration, first);
  const VecLanes v_w = load(boundary.v, first);
  Lanes p_w = sum_p;
  for (int a = 0; a < dim; ++a) {
    p_w += (gravity[a] - a_w[a]) * sum_rho_x[a];
    store(2.0 * v_w[a] - sum_v[a] * share, boundary.v_viscous[a], first);
  }
  p_w *= share;
  const Lanes inverse_rho = inverse(load(boundary.rho, first));
  store(p_w, boundary.p, first);
  store(p_w * inverse_rho * inverse_rho, boundary.p_rho2, first);
}

/// Puts the fits in the place of the mean velocities.
template <class W>
void fit_velocity_to_cluster(Boundary& boundary, const Particles& fluid, const W& kernel,
                             std::size_t cluster) {
  const std::size_t first = cluster * lane_count;
  const Face face = face_towards(boundary, fluid, kernel, cluster);
  const Lanes least = least_distance * square_root(load(boundary.V, first));
  const VecLanes v_w = load(boundary.v, first);
  ParabolaFit fit;
  over_neighbours(kernel, boundary.list_for_wall.near(cluster), load(boundary.x, first), pointers(fluid.x),
                  [&](std::uint32_t i, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    const Lanes d = face.distance(n.x_ij);
                    const Lanes W_wi = select(d > 0.0, kernel.value(n.r), 0.0);
                    fit.add(W_wi, max(d, least), against_wall(boundary, v_w, fluid, i, n.x_ij));
                  });
  for (int a = 0; a < dim; ++a)
    store(select(face.found(), v_w[a] + fit.behind(face.depth, a), load(boundary.v_viscous[a], first)),
          boundary.v_viscous[a], first);
}

/// How the velocity beside a wall answers its slip u_s: the rate of shear at the wall is rate - resistance
/// u_s, and v_w-f is that of a medium that sticks and response u_s more.
struct AnswerToSlip {
  Face face;
  VecLanes rate;               ///< [1/s]
  Lanes resistance, response;  ///< [1/m], [1]
};

/// Of the parabola: a velocity u_s at the face is one less of all particles in the fit.
template <class W>
AnswerToSlip answer_of_fit(const Boundary& boundary, const Particles& fluid, const W& kernel,
                           std::size_t cluster) {
  const std::size_t first = cluster * lane_count;
  const Face face = face_towards(boundary, fluid, kernel, cluster);
  const Lanes least = least_distance * square_root(load(boundary.V, first));
  const VecLanes v_w = load(boundary.v, first);
  ParabolaFit velocity, one;
  over_neighbours(kernel, boundary.list_for_wall.near(cluster), load(boundary.x, first), pointers(fluid.x),
                  [&](std::uint32_t i, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    const Lanes d = face.distance(n.x_ij);
                    const Lanes W_wi = select(d > 0.0, kernel.value(n.r), 0.0);
                    velocity.add(W_wi, max(d, least), against_wall(boundary, v_w, fluid, i, n.x_ij));
                    one.add(W_wi, max(d, least), {1.0, 0.0});
                  });
  return {face, {velocity.rate(0), velocity.rate(1)}, one.rate(0), 1.0 - one.behind(face.depth, 0)};
}

/// Of the mean, which stands for a velocity at the mean distance of the fluid from the face.
template <class W>
AnswerToSlip answer_of_mean(const Boundary& boundary, const Particles& fluid, const W& kernel,
                            std::size_t cluster) {
  const std::size_t first = cluster * lane_count;
  const Face face = face_towards(boundary, fluid, kernel, cluster);
  const Lanes resistance =
      inverse(max(face.separation, least_distance * square_root(load(boundary.V, first))));
  VecLanes rate;
  for (int a = 0; a < dim; ++a)
    rate[a] = (load(boundary.v[a], first) - load(boundary.v_viscous[a], first)) * resistance;
  return {face, rate, resistance, 2.0};
}

/// Lets the medium slide along the wall particles of a cluster; `most(w)` [Pa] is the largest traction on w.
template <class W, class Most>
void slide_along_cluster(Boundary& boundary, const Particles& fluid, const W& kernel,
                         const OptionalTerms& terms, Most&& most, std::size_t cluster) {
  const AnswerToSlip answer = boundary.fitted ? answer_of_fit(boundary, fluid, kernel, cluster)
                                              : answer_of_mean(boundary, fluid, kernel, cluster);
  const auto tau = [&](double gdot) { return viscosity_of(terms, gdot) * gdot; };
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const std::size_t w = cluster * lane_count + lane;
    Vec normal, rate;
    for (int a = 0; a < dim; ++a) normal[a] = answer.face.normal[a][lane], rate[a] = answer.rate[a][lane];
    rate -= normal.dot(rate) * normal;
    const double gdot_0 = rate.norm();
    Slide found;
    if (answer.face.separation[lane] > 0)
      found = slide(*terms.wall_slip, tau, gdot_0, answer.resistance[lane], most(w));
    const Vec u_s = found.speed > 0 ? Vec(found.speed / gdot_0 * rate) : Vec(Vec::Zero());
    set(boundary.slip_velocity, w, u_s);
    boundary.shear_stress[w] = found.stress;
    set(boundary.v_viscous, w, at(boundary.v_viscous, w) + answer.response[lane] * u_s);
  }
}

template <class W>
void extrapolate_viscosity_to_cluster(Boundary& boundary, const Particles& fluid, const W& kernel,
                                      std::size_t cluster) {
  const double smallest_sum = smallest_share * kernel.value(0.0);
  const std::size_t first = cluster * lane_count;
  Lanes sum_W = 0.0, sum_eta = 0.0;
  TensorLanes mean = zero_tensor();
  over_neighbours(kernel, boundary.list_for_wall.near(cluster), load(boundary.x, first), pointers(fluid.x),
                  [&](std::uint32_t i, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    const Lanes W_wi = kernel.value(n.r);
                    sum_W += W_wi;
                    sum_eta += fluid.eta[i] * W_wi;
                    for (int a = 0; a < dim; ++a)
                      for (int b = 0; b < dim; ++b) mean[a][b] += fluid.eta_grad_v[a][b][i] * W_wi;
                  });
  const Lanes share = inverse(max(sum_W, smallest_sum));
  for (auto& row : mean)
    for (auto& component : row) component *= share;
  store(sum_eta * share, boundary.eta, first);
  store(mean, boundary.eta_grad_v, first);
}

/// The same of viscosity and eta grad v.
template <class W>
void fit_viscosity_to_cluster(Boundary& boundary, const Particles& fluid, const W& kernel,
                              std::size_t cluster) {
  const std::size_t first = cluster * lane_count;
  const Face face = face_towards(boundary, fluid, kernel, cluster);
  LineFits<1 + dim * dim> fits;
  over_neighbours(kernel, boundary.list_for_wall.near(cluster), load(boundary.x, first), pointers(fluid.x),
                  [&](std::uint32_t i, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    const Lanes d = face.distance(n.x_ij);
                    std::array<double, 1 + dim * dim> values{std::log(fluid.eta[i])};
                    for (int a = 0; a < dim; ++a)
                      for (int b = 0; b < dim; ++b)
                        values[static_cast<std::size_t>(1 + dim * a + b)] = fluid.eta_grad_v[a][b][i];
                    fits.add(select(d > 0.0, kernel.value(n.r), 0.0), d, values);
                  });
  const auto values = fits.behind(face.depth, least_spread * load(boundary.V, first));
  Lanes eta = 0.0;
  for (std::size_t lane = 0; lane < lane_count; ++lane) eta.value[lane] = std::exp(values[0][lane]);
  store(select(face.found(), eta, load(boundary.eta, first)), boundary.eta, first);
  for (int a = 0; a < dim; ++a)
    for (int b = 0; b < dim; ++b)
      store(select(face.found(), values[static_cast<std::size_t>(1 + dim * a + b)],
                   load(boundary.eta_grad_v[a][b], first)),
            boundary.eta_grad_v[a][b], first);
}

/// Means of the polymer's stress, and in their place lines where there is a face.
template <class W>
void extrapolate_polymer_stress_to_cluster(Boundary& boundary, const Particles& fluid, const W& kernel,
                                           std::size_t cluster) {
  const std::size_t first = cluster * lane_count;
  const Face face = boundary.fitted ? face_towards(boundary, fluid, kernel, cluster) : Face{};
  const std::array<const double*, 3> stress = pointers(fluid.polymer_stress);
  Lanes sum_W = 0.0;
  std::array<Lanes, 3> mean{0.0, 0.0, 0.0};
  LineFits<3> fits;
  over_neighbours(kernel, boundary.list_for_wall.near(cluster), load(boundary.x, first), pointers(fluid.x),
                  [&](std::uint32_t i, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    const Lanes W_wi = kernel.value(n.r), d = face.distance(n.x_ij);
                    const std::array<double, 3> values{stress[0][i], stress[1][i], stress[2][i]};
                    sum_W += W_wi;
                    for (std::size_t k = 0; k < 3; ++k) mean[k] += W_wi * values[k];
                    fits.add(select(d > 0.0, W_wi, 0.0), d, values);
                  });
  const Lanes share = inverse(max(sum_W, smallest_share * kernel.value(0.0)));
  const auto lines = fits.behind(face.depth, least_spread * load(boundary.V, first));
  for (std::size_t k = 0; k < 3; ++k) mean[k] = select(face.found(), lines[k], share * mean[k]);
  store(Symmetric<Lanes>{mean[0], mean[1], mean[2]}, boundary.polymer_stress, first);
}

}  // namespace

void extrapolate(Boundary& boundary, const Particles& fluid, const Kernel& kernel, const Vec& gravity) {
  const auto& active = boundary.list_for_wall.active();
  kernel.visit([&](const auto& W) {
#pragma omp for schedule(dynamic, 4)
    for (std::size_t k = 0; k < active.size(); ++k) {
      extrapolate_to_cluster(boundary, fluid, W, gravity, active[k]);
      if (boundary.turns()) turn_cluster(boundary, fluid, W, active[k]);
      if (boundary.fitted) fit_velocity_to_cluster(boundary, fluid, W, active[k]);
    }
  });
}

void let_slide(Boundary& boundary, const Particles& fluid, const Kernel& kernel, const OptionalTerms& terms,
               double p_offset) {
  const bool rubs = terms.friction && boundary.is_work_piece();
  const auto most = [&](std::size_t w) {
    return rubs ? terms.friction->coefficient * std::max(boundary.p[w] + p_offset, 0.0)
                : std::numeric_limits<double>::infinity();
  };
  const auto& active = boundary.list_for_wall.active();
  kernel.visit([&](const auto& W) {
#pragma omp for schedule(dynamic, 4)
    for (std::size_t k = 0; k < active.size(); ++k)
      slide_along_cluster(boundary, fluid, W, terms, most, active[k]);
  });
}

void extrapolate_viscosity(Boundary& boundary, const Particles& fluid, const Kernel& kernel) {
  const auto& active = boundary.list_for_wall.active();
  kernel.visit([&](const auto& W) {
#pragma omp for schedule(dynamic, 4)
    for (std::size_t k = 0; k < active.size(); ++k) {
      extrapolate_viscosity_to_cluster(boundary, fluid, W, active[k]);
      if (boundary.fitted) fit_viscosity_to_cluster(boundary, fluid, W, active[k]);
    }
  });
}

void extrapolate_polymer_stress(Boundary& boundary, const Particles& fluid, const Kernel& kernel) {
  const auto& active = boundary.list_for_wall.active();
  kernel.visit([&](const auto& W) {
#pragma omp for schedule(dynamic, 4)
    for (std::size_t k = 0; k < active.size(); ++k)
      extrapolate_polymer_stress_to_cluster(boundary, fluid, W, active[k]);
  });
}

}  // namespace toryu::fluid
