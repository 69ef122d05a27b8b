/// Particles that act on the fluid as a wall: rigid walls and pistons, or the elastic solid's interface.
/// Their pressure and velocity are extrapolated from the fluid (Adami, Hu & Adams 2012; thesis eq. 27-29). A
/// boundary owns its motion, and what it has given the fluid.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "common/sph/cluster_list.hpp"
#include "common/sph/kernel.hpp"
#include "fluid_solver/boundary_motion.hpp"
#include "fluid_solver/moving_interface.hpp"
#include "fluid_solver/particles.hpp"

namespace toryu::fluid {

inline Vec lane_sums(const Lanes& m, const VecLanes& v) {
  Vec sum;
  for (int a = 0; a < dim; ++a) sum[a] = sum_of(m * v[a]);
  return sum;
}

/// What a boundary did to the fluid in one evaluation.
struct ForceOnFluid {
  std::vector<Vec> by_cluster;           ///< force on each cluster of the fluid [N per metre depth]
  std::vector<Vec> friction_by_cluster;  ///< the same of the friction alone; empty where there is none
  /// Where the fluid is spread over ranks, whose clusters are others than those of the whole, in their place:
  /// the force over the mass of each particle by the pairs that are swept at once, and by a further one
  /// [m/s2]; that of the friction [N per metre depth]. Rank 0 makes those of the whole of them.
  VecField by_particle = {}, further_by_particle = {}, friction_by_particle = {};
  bool of_part = false;  ///< whether it is
  Vec friction() const;
  Vec force() const;  ///< the sum of both
  /// For what is done to so many clusters of the fluid, by a `further` force too.
  void make_room(std::size_t clusters, bool further);
  /// What is done to a cluster of masses `m`, by its accelerations [m/s2].
  void set(std::size_t cluster, const Lanes& m, const VecLanes& by_boundary) {
    if (of_part)
      store(by_boundary, by_particle, cluster * lane_count);
    else
      by_cluster[cluster] = lane_sums(m, by_boundary);
  }
  /// The same of a further one, of which there is at most one.
  void add(std::size_t cluster, const Lanes& m, const VecLanes& by_boundary) {
    if (of_part)
      store(by_boundary, further_by_particle, cluster * lane_count);
    else
      by_cluster[cluster] += lane_sums(m, by_boundary);
  }
  /// Those of friction [N per metre depth].
  void set_friction(std::size_t cluster, const VecLanes& forces) {
    if (of_part)
      store(forces, friction_by_particle, cluster * lane_count);
    else
      friction_by_cluster[cluster] = lane_sums(1.0, forces);
  }
  /// Nothing rubs on any of so many clusters.
  void forget_friction(std::size_t clusters);
  /// What the last evaluation did to a cluster. What it did to particles out of reach nobody asks for.
  void forget(std::size_t cluster) {
    if (!of_part) by_cluster[cluster].setZero();
  }
};

/// Impulse since the start [N.s per metre depth], and the friction's share of it.
struct Impulse {
  Vec total = Vec::Zero(), friction = Vec::Zero();
};
template <class Archive>
void serialize(Archive& archive, Impulse& impulse) {
  auto& [total, friction] = impulse;
  archive(total, friction);
}

/// Lengths of the open faces of a particle's cell [m per metre depth].
struct Faces {
  Vec lower = Vec::Zero(), upper = Vec::Zero();  ///< towards negative and towards positive x and y
};
/// Those of which `area_vector` [m per metre depth], outward, is the sum.
inline Faces faces_of(const Vec& area_vector) {
  return {(-area_vector).cwiseMax(0.0), area_vector.cwiseMax(0.0)};
}

/// Distance of each particle of a body from the end of the body along either direction of each axis [m].
struct FaceDepths {
  std::vector<Vec> up, down;
  /// From each to the nearest point of the body's outline [m]; zero where it has none. Empty: none has.
  std::vector<Vec> to_outline = {};
  /// Of the outline there, above 0 where the body is convex [1/m]; as many as `to_outline`.
  std::vector<double> curvature = {};
};

struct Boundary {
  std::string name;
  std::variant<Still, PrescribedMotion, PressedMotion, MovingInterface> motion;
  std::size_t count = 0;
  std::vector<std::uint32_t> id;  ///< number at the start: of a wall particle, or the interface's own order

  Declared<VecField> x{"position", "m", FieldKind::state}, v{"velocity", "m/s", FieldKind::state};
  /// Where it moves.
  Declared<VecField> acceleration{"acceleration", "m/s2", FieldKind::state, Presence::on_demand};
  Declared<Field> V{"volume", "m2", FieldKind::state};
  Declared<Field> m{"mass", "kg/m", FieldKind::state};  ///< of fluid in its place
  Declared<Field> rho{"density", "kg/m3", FieldKind::state};
  /// Lengths of the open faces of the cell at the start, towards negative and towards positive x and y; zero
  /// inside, empty if this is no work piece.
  Declared<VecField> lower_face{"lower_face", "m", FieldKind::state, Presence::on_demand};
  Declared<VecField> upper_face{"upper_face", "m", FieldKind::state, Presence::on_demand};
  /// Distance from where the body ends along either direction of each axis (wall_extrapolation.hpp).
  Declared<VecField> depth_up{"depth_up", "m", FieldKind::state, Presence::on_demand},
      depth_down{"depth_down", "m", FieldKind::state, Presence::on_demand};
  /// To the nearest point of its outline, for the particles of a body that is one.
  Declared<VecField> to_outline{"to_outline", "m", FieldKind::state, Presence::on_demand};
  /// Of the outline there, above 0 where the body is convex.
  Declared<Field> curvature{"curvature", "1/m", FieldKind::state, Presence::on_demand};
  // extrapolated from the fluid
  Declared<Field> p{"pressure", "Pa", FieldKind::derived},
      p_rho2{"p/rho^2", "m5/(kg.s2)", FieldKind::derived};
  /// v_w-f, which the viscous terms use (28).
  Declared<VecField> v_viscous{"viscous_velocity", "m/s", FieldKind::derived};
  /// As of the fluid's particles, where the medium is not Newtonian.
  Declared<Field> eta{"viscosity", "Pa.s", FieldKind::derived, Presence::on_demand};
  Declared<TensorField> eta_grad_v{"viscosity_times_velocity_gradient", "Pa", FieldKind::derived,
                                   Presence::on_demand};
  /// u_s and tau_w, where the medium slides as terms/wall_slip.hpp has it.
  Declared<VecField> slip_velocity{"slip_velocity", "m/s", FieldKind::derived, Presence::on_demand};
  Declared<Field> shear_stress{"shear_stress", "Pa", FieldKind::derived, Presence::on_demand};
  /// Where the medium is viscoelastic.
  Declared<Symmetric<Field>> polymer_stress{"polymer_stress", "Pa", FieldKind::derived, Presence::on_demand};
  /// What the fluid does to the particle, where asked for.
  Declared<VecField> force{"force", "N/m", FieldKind::derived, Presence::on_demand};
  // where there is friction, of a work piece alone
  Declared<Field> friction_length{"friction_length", "m", FieldKind::derived,
                                  Presence::on_demand};  ///< d_s of (33), see terms/friction.hpp
  Declared<VecField> friction_force{"friction_force", "N/m", FieldKind::derived, Presence::on_demand};

  bool fitted = false;  ///< see wall_extrapolation.hpp

  // of a wall that turns, as it was moved last
  Mat orientation = Mat::Identity();  ///< of its faces; of those of a rigid solid as well
  Vec pivot = Vec::Zero();            ///< about which it turns, and by which moments count [m]
  double angular_velocity = 0;        ///< [rad/s]
  double moment = 0;                  ///< on the fluid, when a force was counted last [N.m per metre depth]
  double power_given = 0;             ///< likewise [W per metre depth]

  ForceOnFluid force_on_fluid;  ///< of the last evaluation that asked for it
  Impulse impulse;              ///< of what was counted
  double work = 0;              ///< done on the fluid likewise [J per metre depth]
  bool counted = false;         ///< whether anything was

  ClusterList list_for_wall;   ///< for clusters of this boundary: the fluid's particles
  ClusterList list_for_fluid;  ///< for clusters of the fluid: this boundary's particles
  StripOrder strips{1.0};

  /// Sets `count` particles at `positions`, each of its volume [m2], at rest.
  void place(const std::vector<Vec>& positions, const std::vector<double>& volumes, double rest_density,
             double strip_width, Geometry geometry = Geometry::plane);
  /// Makes it a work piece with these open faces, by id.
  void make_work_piece(const std::vector<Faces>& faces);
  bool is_work_piece() const { return !lower_face[0].empty(); }
  /// Tells it where its body ends, by id, and whether what viscous terms see of it is fitted there.
  void know_faces(const FaceDepths& depths, bool fit = true);
  bool knows_faces() const { return !depth_up[0].empty(); }
  bool is_slippery() const { return !slip_velocity[0].empty(); }
  /// Whether its motion is prescribed and turns it.
  bool turns() const {
    const auto* prescribed = std::get_if<PrescribedMotion>(&motion);
    return prescribed && prescribed->motion.turns();
  }
  /// A direction of the body as it was at the start, as it is now, and the other way round.
  Vec turned(const Vec& of_body) const { return may_turn() ? Vec(orientation * of_body) : of_body; }
  Vec turned_back(const Vec& now) const { return may_turn() ? Vec(orientation.transpose() * now) : now; }
  bool may_turn() const { return turns() || is_interface(); }
  bool moves() const { return !std::holds_alternative<Still>(motion); }
  /// Whether a cluster of the fluid is in reach.
  bool acts_on(std::size_t cluster) const {
    const auto near = list_for_fluid.near(cluster);
    return near.size() > 1 || !near[0].sources.empty();
  }
  bool is_interface() const { return std::holds_alternative<MovingInterface>(motion); }
  /// Whether `point`, or its image in one of `shifts` [m], lies in the cell of a particle; cells are
  /// `spacing` [m] wide.
  bool covers(const Vec& point, double spacing, const std::vector<Vec>& shifts = {Vec::Zero()}) const;
  /// Takes away all particles but those at `kept`, which rises.
  void keep(const std::vector<std::uint32_t>& kept);
  /// Becomes `other` but for its lists, as another part of the same fluid is near it, and for what was told
  /// of it.
  void take_all_but_lists(const Boundary& other);
  /// Puts the particles in strip order again after they moved.
  void sort();
  /// Sets position, velocity and acceleration to those at `time` [s].
  void move(double time);
  /// The same to `kinematics(id)`.
  template <class Of>
  void move_to(Of&& kinematics);
  /// What the last evaluation does on the fluid, with the force `on_fluid` in all [W per metre depth].
  double power(const Vec& on_fluid) const;
  /// By `force` and `friction_force` of its particles, about its pivot [N.m per metre depth].
  double moment_on_fluid() const;
  /// Counts what the last evaluation did to the fluid for `dt` [s]; of the interface and of a wall that turns
  /// `force` and `friction_force` must be there.
  void count_force(double dt);
  /// The same of a moment on the fluid that is no force of particles [N.m per metre depth].
  void count_moment(double further, double dt);
};

template <class Of>
void Boundary::move_to(Of&& kinematics) {
  resize(acceleration, x[0].size());
  for (std::size_t k = 0; k < count; ++k) {
    const Kinematics now = kinematics(id[k]);
    set(x, k, now.x);
    set(v, k, now.v);
    set(acceleration, k, now.a);
  }
}

/// All but the lists, which follow from where they were built, and what one evaluation leaves.
template <class Archive>
void serialize(Archive& archive, Boundary& boundary) {
  auto& [name, motion, count, id, x, v, acceleration, V, m, rho, lower_face, upper_face, depth_up, depth_down,
         to_outline, curvature, p, p_rho2, v_viscous, eta, eta_grad_v, slip_velocity, shear_stress,
         polymer_stress, force, friction_length, friction_force, fitted, orientation, pivot, angular_velocity,
         moment, power_given, force_on_fluid, impulse, work, counted, list_for_wall, list_for_fluid, strips] =
      boundary;
  std::visit([&](auto& of_kind) { archive(of_kind); }, motion);
  archive(count, id, x, v, acceleration, V, m, rho, lower_face, upper_face, depth_up, depth_down, to_outline,
          curvature, p, p_rho2, v_viscous, eta, eta_grad_v, slip_velocity, shear_stress, polymer_stress,
          force, friction_length, friction_force, orientation, pivot, angular_velocity, moment, power_given,
          impulse, work, counted);
}

inline Sources sources(const Boundary& b) {
  return {.x = pointers(b.x),
          .v = pointers(b.v),
          .v_viscous = pointers(b.v_viscous),
          .grad_rho = {},
          .m = b.m.data(),
          .V = b.V.data(),
          .rho = b.rho.data(),
          .p_rho2 = b.p_rho2.data(),
          .eta = b.eta.data(),
          .eta_grad_v = pointers(b.eta_grad_v),
          .polymer_stress = pointers(b.polymer_stress)};
}

}  // namespace toryu::fluid
