#include "fluid_solver/boundary.hpp"

#include <algorithm>
#include <numeric>

#include "fluid_solver/axis_images.hpp"
#include "fluid_solver/terms/axisymmetry.hpp"

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

void ForceOnFluid::make_room(std::size_t clusters, bool further) {
  if (!of_part) return by_cluster.resize(clusters);
  clusters = std::max<std::size_t>(clusters, 1);  // by whether there are any, all ranks tell what to collect
  resize(by_particle, clusters * lane_count);
  if (further) resize(further_by_particle, clusters * lane_count);
}

void ForceOnFluid::forget_friction(std::size_t clusters) {
  if (!of_part) return friction_by_cluster.assign(clusters, Vec::Zero());
  for (Field& component : friction_by_particle)
    component.assign(std::max<std::size_t>(clusters, 1) * lane_count, 0.0);
}

void Boundary::place(const std::vector<Vec>& positions, const std::vector<double>& volumes,
                     double rest_density, double strip_width, Geometry geometry) {
  count = positions.size();
  id.resize(count);
  std::iota(id.begin(), id.end(), 0u);
  const std::size_t size = room_of(count, geometry);
  resize_fields(*this, size);
  if (moves()) resize(acceleration, size);
  if (may_turn()) resize(force, size);
  for (std::size_t k = 0; k < count; ++k) {
    set(x, k, positions[k]);
    V[k] = volumes[k];
    m[k] = rest_density * volumes[k];
    if (geometry == Geometry::axisymmetric) m[k] *= circumference(positions[k][1]);
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

void Boundary::know_faces(const FaceDepths& depths, bool fit) {
  fitted = fit;
  resize(depth_up, padded(count));
  resize(depth_down, padded(count));
  for (std::size_t k = 0; k < count; ++k) {
    set(depth_up, k, depths.up[id[k]]);
    set(depth_down, k, depths.down[id[k]]);
  }
  if (depths.to_outline.empty()) return;
  resize(to_outline, padded(count));
  for (std::size_t k = 0; k < count; ++k) set(to_outline, k, depths.to_outline[id[k]]);
  curvature.assign(padded(count), 0.0);
  for (std::size_t k = 0; k < count; ++k) curvature[k] = depths.curvature[id[k]];
}

bool Boundary::covers(const Vec& point, double spacing, const std::vector<Vec>& shifts) const {
  const double half = 0.501 * spacing;
  bool found = false;
  for (const Vec& shift : shifts) {
    const Vec image = point + shift;
    strips.in_box(x[1], image[0] - half, image[0] + half, image[1] - half, image[1] + half,
                  [&](std::size_t first, std::size_t last) {
                    for (std::size_t k = first; k < last && !found; ++k)
                      found = (at(x, k) - image).lpNorm<Eigen::Infinity>() < half;
                  });
  }
  return found;
}

void Boundary::keep(const std::vector<std::uint32_t>& kept) {
  reorder_fields(*this, kept);
  for (std::size_t k = 0; k < kept.size(); ++k) id[k] = id[kept[k]];
  count = kept.size();
  id.resize(count);
  strips.index(x[0], count);
}

void Boundary::take_all_but_lists(const Boundary& other) {
  ClusterList for_wall = std::move(list_for_wall), for_fluid = std::move(list_for_fluid);
  const auto* pressed = std::get_if<PressedMotion>(&motion);
  const bool told = pressed && pressed->at_stop;
  *this = other;
  if (auto* now = std::get_if<PressedMotion>(&motion)) now->at_stop = told;
  list_for_wall = std::move(for_wall);
  list_for_fluid = std::move(for_fluid);
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
  if (!turns()) return;
  const Pose pose = std::get<PrescribedMotion>(motion).motion.pose_at(time);
  orientation = pose.rotation;
  pivot = pose.centre;
  angular_velocity = pose.angular_velocity;
}

void Boundary::count_force(double dt) {
  const Vec on_fluid = force_on_fluid.force();
  impulse.total += dt * on_fluid;
  impulse.friction += dt * force_on_fluid.friction();
  const double given = power(on_fluid);
  work += dt * given;
  if (turns()) moment = moment_on_fluid(), power_given = given;
  counted = true;
}

void Boundary::count_moment(double further, double dt) {
  moment += further;
  power_given += further * angular_velocity;
  work += dt * further * angular_velocity;
}

double Boundary::power(const Vec& on_fluid) const {
  if (!moves()) return 0;
  if (const auto* pressed = std::get_if<PressedMotion>(&motion))
    return pressed->mean_speed * on_fluid.dot(pressed->press.axis());
  if (!is_interface() && !turns()) return on_fluid.dot(at(v, 0));  // rigid, without a turn
  const bool rubbed = !friction_force[0].empty();
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    sum -= at(force, k).dot(at(v, k));
    if (rubbed) sum -= at(friction_force, k).dot(at(v, k));
  }
  return sum;
}

double Boundary::moment_on_fluid() const {
  const bool rubbed = !friction_force[0].empty();
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec across = Pose::across(at(x, k) - pivot);
    sum -= across.dot(at(force, k));
    if (rubbed) sum -= across.dot(at(friction_force, k));
  }
  return sum;
}

}  // namespace toryu::fluid
