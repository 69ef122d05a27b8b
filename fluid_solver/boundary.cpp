#include "fluid_solver/boundary.hpp"

#include <numeric>

#include "common/sph/neighbour_loop.hpp"

namespace toryu::fluid {

Vec ForceOnFluid::force() const {
  Vec sum = friction();
  for (const auto& part : by_cluster) sum += part;
  return sum;
}

Vec ForceOnFluid::friction() const {
  Vec sum = Vec::Zero();
  for (const auto& part : friction_by_cluster) sum += part;
  return sum;
}

void Boundary::place(const std::vector<Vec>& positions, const std::vector<double>& volumes,
                     double rest_density, double strip_width) {
  count = positions.size();
  id.resize(count);
  std::iota(id.begin(), id.end(), 0u);
  resize_fields(*this, padded(count));
  for (std::size_t k = 0; k < count; ++k) {
    set(x, k, positions[k]);
    V[k] = volumes[k];
    m[k] = rest_density * volumes[k];
    rho[k] = rest_density;
  }
  strips = StripOrder(strip_width);
  sort();
}

void Boundary::make_work_piece(const std::vector<Faces>& faces) {
  for (auto* face : {&lower_face, &upper_face}) resize(*face, padded(count));
  for (std::size_t k = 0; k < count; ++k) {
    set(lower_face, k, faces[id[k]].lower);
    set(upper_face, k, faces[id[k]].upper);
  }
}

void Boundary::sort() {
  const auto order = strips.sort(x[0], x[1], count);
  reorder_fields(*this, order);
  std::vector<std::uint32_t> sorted_id(count);
  for (std::size_t k = 0; k < count; ++k) sorted_id[k] = id[order[k]];
  id.swap(sorted_id);
  strips.index(x[0], count);
}

void Boundary::move(double time) {
  std::visit(
      [&]<class Kind>(const Kind& of_kind) {
        if constexpr (!std::is_same_v<Kind, Still>) move_to(of_kind.at(time));
      },
      motion);
}

void Boundary::count_force(double dt) {
  impulse.total += dt * force_on_fluid.force();
  impulse.friction += dt * force_on_fluid.friction();
  work += dt * power();
  counted = true;
}

double Boundary::power() const {
  if (!moves()) return 0;
  if (!is_interface()) return force_on_fluid.force().dot(at(v, 0));  // rigid
  const bool rubbed = !friction_force[0].empty();
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    sum -= at(force, k).dot(at(v, k));
    if (rubbed) sum -= at(friction_force, k).dot(at(v, k));
  }
  return sum;
}

namespace {

// A sum of kernel values below this share of W(0) means that no fluid is in reach.
constexpr double smallest_share = 1e-9;

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
  const VecLanes a_w = load(boundary.acceleration, first), v_w = load(boundary.v, first);
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

}  // namespace

void extrapolate(Boundary& boundary, const Particles& fluid, const Kernel& kernel, const Vec& gravity) {
  const auto& active = boundary.list_for_wall.active();
  kernel.visit([&](const auto& W) {
#pragma omp for schedule(dynamic, 4)
    for (std::size_t k = 0; k < active.size(); ++k)
      extrapolate_to_cluster(boundary, fluid, W, gravity, active[k]);
  });
}

void extrapolate_viscosity(Boundary& boundary, const Particles& fluid, const Kernel& kernel) {
  const auto& active = boundary.list_for_wall.active();
  kernel.visit([&](const auto& W) {
#pragma omp for schedule(dynamic, 4)
    for (std::size_t k = 0; k < active.size(); ++k)
      extrapolate_viscosity_to_cluster(boundary, fluid, W, active[k]);
  });
}

}  // namespace toryu::fluid
