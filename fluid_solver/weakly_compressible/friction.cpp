#include "fluid_solver/weakly_compressible/friction.hpp"

#include <fmt/format.h>

#include "common/sph/neighbour_loop.hpp"
#include "fluid_solver/axis_images.hpp"
#include "fluid_solver/terms/axisymmetry.hpp"

namespace toryu::fluid {

WorkPieceFriction::WorkPieceFriction(const Friction& parameters, double spacing, double sound_speed,
                                     const Kernel& kernel, Geometry geometry)
    : form_(parameters.form),
      spacing_(spacing),
      term_{parameters.coefficient, regularisation_speed(parameters, sound_speed)},
      kernel_(kernel),
      geometry_(geometry) {}

double WorkPieceFriction::volume(const Particles& fluid, std::size_t f) const {
  return geometry_ == Geometry::plane ? fluid.V[f] : fluid.V[f] * circumference(fluid.x[1][f]);
}
Lanes WorkPieceFriction::volumes(const Particles& fluid, std::size_t first) const {
  const Lanes V = load(fluid.V, first);
  return geometry_ == Geometry::plane ? V : V * circumference(load(fluid.x[1], first));
}

void WorkPieceFriction::measure_contact(Boundary& work_piece, const Particles& fluid) const {
  auto& d = work_piece.friction_length;
  d.assign(work_piece.V.size(), spacing_);
  if (form_ == FrictionForm::as_printed) return;
  const auto& active = work_piece.list_for_wall.active();
  kernel_.visit([&](const auto& W) {
#pragma omp parallel for schedule(dynamic, 4)
    for (std::size_t k = 0; k < active.size(); ++k) {
      const std::size_t first = active[k] * lane_count;
      const VecLanes lower = load(work_piece.lower_face, first), upper = load(work_piece.upper_face, first);
      VecLanes A_s = lower;
      add_product(A_s, 1.0, upper);
      Lanes least = least_contact;
      if (const VecLanes x_s = load(work_piece.x, first); geometry_ == Geometry::axisymmetric)
        A_s = ring_areas(lower, upper, x_s), least *= circumference(x_s[1]);
      Lanes sum = 0.0;
      over_neighbours(W, work_piece.list_for_wall.near(active[k]), load(work_piece.x, first),
                      pointers(fluid.x), [&](std::uint32_t f, const Neighbour& n) TORYU_INLINE_LAMBDA {
                        sum += volume(fluid, f) * W.value(n.r);
                      });
      store(square_root(dot(A_s, A_s)) * inverse(max(sum, least)), d, first);
    }
  });
  if (geometry_ == Geometry::axisymmetric) mirror(d);
}

void WorkPieceFriction::brake_fluid(Particles& fluid, double p_offset, Boundary& work_piece) const {
  work_piece.force_on_fluid.forget_friction(fluid.clusters());
  const auto& active = work_piece.list_for_fluid.active();
  kernel_.visit([&](const auto& W) {
#pragma omp parallel for schedule(dynamic, 4)
    for (std::size_t k = 0; k < active.size(); ++k) brake_cluster(W, fluid, p_offset, work_piece, active[k]);
  });
}

template <class W>
void WorkPieceFriction::brake_cluster(const W& kernel, Particles& fluid, double p_offset,
                                      Boundary& work_piece, std::size_t cluster) const {
  const std::size_t first = cluster * lane_count;
  const VecLanes v_f = load(fluid.v, first);
  const Lanes p_f = load(fluid.p, first) + p_offset, V_f = volumes(fluid, first);
  VecLanes sum = zero_vector();
  over_neighbours(kernel, work_piece.list_for_fluid.near(cluster), load(fluid.x, first),
                  pointers(work_piece.x), [&](std::uint32_t s, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    VecLanes v_fs;
                    for (int a = 0; a < dim; ++a) v_fs[a] = v_f[a] - work_piece.v[a][s];
                    const VecLanes on_s =
                        term_.per_volume(kernel, work_piece.friction_length[s], p_f, n.r, v_fs);
                    for (int a = 0; a < dim; ++a) sum[a] -= on_s[a];
                  });
  const Lanes inverse_rho = inverse(load(fluid.rho, first));
  for (int a = 0; a < dim; ++a) store(load(fluid.a[a], first) + sum[a] * inverse_rho, fluid.a[a], first);
  work_piece.force_on_fluid.set_friction(cluster, product(V_f, sum));  // V_f = 0 in idle lanes
}

void WorkPieceFriction::drag_work_piece(Boundary& work_piece, const Particles& fluid, double p_offset) const {
  for (auto& component : work_piece.friction_force) component.assign(padded(work_piece.count), 0.0);
  const auto& active = work_piece.list_for_wall.active();
  kernel_.visit([&](const auto& W) {
#pragma omp parallel for schedule(dynamic, 4)
    for (std::size_t k = 0; k < active.size(); ++k) drag_cluster(W, work_piece, fluid, p_offset, active[k]);
  });
}

template <class W>
void WorkPieceFriction::drag_cluster(const W& kernel, Boundary& work_piece, const Particles& fluid,
                                     double p_offset, std::size_t cluster) const {
  const std::size_t first = cluster * lane_count;
  const VecLanes v_s = load(work_piece.v, first);
  const Lanes d_s = load(work_piece.friction_length, first);
  VecLanes sum = zero_vector();
  over_neighbours(kernel, work_piece.list_for_wall.near(cluster), load(work_piece.x, first),
                  pointers(fluid.x), [&](std::uint32_t f, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    VecLanes v_fs;
                    for (int a = 0; a < dim; ++a) v_fs[a] = fluid.v[a][f] - v_s[a];
                    const VecLanes on_s = term_.per_volume(kernel, d_s, fluid.p[f] + p_offset, n.r, v_fs);
                    for (int a = 0; a < dim; ++a) sum[a] += volume(fluid, f) * on_s[a];
                  });
  store(sum, work_piece.friction_force, first);
}

double WorkPieceFriction::power(const Particles& fluid, double p_offset,
                                const std::vector<Boundary>& boundaries, const Ranks* ranks) const {
  double sum = 0;
  kernel_.visit([&](const auto& W) {
    for (const Boundary& boundary : boundaries) {
      if (!boundary.is_work_piece()) continue;
      Field powers(padded(fluid.count));
      for (const auto c : boundary.list_for_fluid.active())
        store(power_of_cluster(W, fluid, p_offset, boundary, c), powers, c * lane_count);
      if (ranks) powers = ranks->of_whole(powers);
      for (std::size_t first = 0; first < powers.size(); first += lane_count)
        sum += sum_of(load(powers, first));
    }
  });
  return sum;
}

template <class W>
Lanes WorkPieceFriction::power_of_cluster(const W& kernel, const Particles& fluid, double p_offset,
                                          const Boundary& work_piece, std::size_t cluster) const {
  const std::size_t first = cluster * lane_count;
  const VecLanes v_f = load(fluid.v, first);
  const Lanes p_f = load(fluid.p, first) + p_offset;
  const Positions v_s = pointers(work_piece.v);
  Lanes sum = 0.0;
  over_neighbours(kernel, work_piece.list_for_fluid.near(cluster), load(fluid.x, first),
                  pointers(work_piece.x), [&](std::uint32_t s, const Neighbour& n) TORYU_INLINE_LAMBDA {
                    const VecLanes v_fs = difference(v_f, v_s, s);
                    sum += dot(term_.per_volume(kernel, work_piece.friction_length[s], p_f, n.r, v_fs), v_fs);
                  });
  return volumes(fluid, first) * sum;  // V_f = 0 in idle lanes
}

double WorkPieceFriction::rate(double p, double rho) const {
  const double share = form_ == FrictionForm::as_printed ? printed_share(kernel_, spacing_) : 1.0;
  return share * term_.mu_A * std::max(p, 0.0) / (rho * spacing_ * term_.eps);
}

}  // namespace toryu::fluid
