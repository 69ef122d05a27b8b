#include "fluid_solver/surface_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fluid_solver/work_piece.hpp"

namespace toryu::fluid {

namespace {

/// Below this sum of V_f W_sf (0.25 at a plane interface) there is no contact to speak of.
constexpr double least_contact_sum = 1e-3;
/// Below this share rows differ too little in their distance to tell the bend of the velocity.
constexpr double least_spread_of_rows = 0.01;
constexpr double first_row = 1.0;  ///< what is nearer to the face, over the spacing

/// Kernel means about one surface particle.
struct Contact {
  bool there = false;
  double pressure = 0;         ///< [Pa]
  Vec velocity = Vec::Zero();  ///< of the medium against the surface [m/s]
};

/// `side`: the normal of the side whose fluid counts; zero: all fluid does.
Contact contact_of(const Boundary& surface, std::size_t k, const Vec& side, const Particles& fluid,
                   double p_offset, const Kernel& kernel) {
  const Vec v_s = at(surface.v, k);
  Contact mean;
  double sum = 0;
  for (const ShiftedNeighbours& near : surface.list_for_wall.near(k / lane_count)) {
    const Vec x_s = at(surface.x, k) + near.shift;
    for (const std::uint32_t f : near.sources) {
      const Vec x_fs = at(fluid.x, f) - x_s;
      const double r = x_fs.norm();
      if (r >= kernel.support() || side.dot(x_fs) < 0) continue;
      const double V_W = fluid.V[f] * kernel.value(r);
      sum += V_W;
      mean.pressure += V_W * std::max(fluid.p[f] + p_offset, 0.0);
      mean.velocity += V_W * (at(fluid.v, f) - v_s);
    }
  }
  if (sum < least_contact_sum) return {};
  mean.there = true;
  mean.pressure /= sum;
  mean.velocity /= sum;
  return mean;
}

/// Of a surface particle at rest or in motion, where the medium sticks to it.
struct SeenFace {
  Vec x, v, normal;
  double spacing;
  /// Distance of a place from the face, which is half a spacing in front of the particle [m].
  double distance(const Vec& place) const { return normal.dot(place - x) - 0.5 * spacing; }
};

/// Fits v = g y + c y^2 to velocities against the face at the distances y from it; v = g y to a single row.
class ShearFit {
 public:
  void add(double w, double y, const Vec& v) {
    y2_ += w * y * y;
    y3_ += w * y * y * y;
    y4_ += w * y * y * y * y;
    yv_ += w * y * v;
    y2v_ += w * y * y * v;
  }
  /// Whether its rows differ enough in their distance to tell the bend of the velocity.
  bool bends() const { return determinant() > least_spread_of_rows * y2_ * y4_; }
  Vec rate() const {
    if (y2_ == 0) return Vec::Zero();
    return bends() ? Vec((y4_ * yv_ - y3_ * y2v_) / determinant()) : Vec(yv_ / y2_);
  }

 private:
  double determinant() const { return y2_ * y4_ - y3_ * y3_; }
  double y2_ = 0, y3_ = 0, y4_ = 0;
  Vec yv_ = Vec::Zero(), y2v_ = Vec::Zero();
};

/// A particle of the fluid and where it is seen from the face.
struct Seen {
  std::uint32_t f;
  Vec x;
};

/// Calls visit(Seen) for what the lists of `near` hold, seen as far from `origin` as from the cluster's
/// targets.
template <class Visit>
void over_seen(std::span<const ShiftedNeighbours> near, const Vec& shift, const Particles& fluid,
               Visit&& visit) {
  for (const ShiftedNeighbours& list : near)
    for (const std::uint32_t f : list.sources) visit(Seen{f, at(fluid.x, f) - list.shift - shift});
}

/// The rate of shear along the surface [1/s]. The row beside a wall is 5 to 10 % too fast at any spacing
/// (what walls extrapolate to themselves is a kernel mean), so the fit is to the next rows, about the
/// particle nearest to a place two spacings from the face, and to the first one only where there are no
/// others.
double shear_rate_at(const Boundary& surface, std::size_t k, const SeenFace& face, const Particles& fluid,
                     const ClusterList& neighbours, const Kernel& kernel) {
  ShearFit beside, farther;
  const Vec middle = face.x + 2.5 * face.spacing * face.normal;
  std::optional<Seen> nearest;
  const auto near = surface.list_for_wall.near(k / lane_count);
  over_seen(near, Vec::Zero(), fluid, [&](const Seen& seen) {
    const double y = face.distance(seen.x), r = (seen.x - face.x).norm();
    if (r < kernel.support() && y > 0)
      beside.add(fluid.V[seen.f] * kernel.value(r), y, at(fluid.v, seen.f) - face.v);
    if (!nearest || (seen.x - middle).norm() < (nearest->x - middle).norm()) nearest = seen;
  });
  if (nearest) {
    const Vec shift = at(fluid.x, nearest->f) - nearest->x;
    over_seen(neighbours.near(nearest->f / lane_count), shift, fluid, [&](const Seen& seen) {
      const double y = face.distance(seen.x), r = (seen.x - middle).norm();
      if (r < kernel.support() && y > first_row * face.spacing)
        farther.add(fluid.V[seen.f] * kernel.value(r), y, at(fluid.v, seen.f) - face.v);
    });
  }
  const Vec g = (farther.bends() ? farther : beside).rate();
  return (g - face.normal.dot(g) * face.normal).norm();
}

}  // namespace

void SurfaceRecord::attach(const std::vector<Boundary>& boundaries) {
  first_.assign(boundaries.size(), {});
  std::uint32_t work_piece = 0;
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    const Boundary& body = boundaries[b];
    if (!body.is_work_piece()) continue;
    names_ += (names_.empty() ? "" : ";") + body.name;
    std::vector<std::size_t> slot(
        body.count);  // by id, so that the record has one order however particles are sorted
    for (std::size_t k = 0; k < body.count; ++k) slot[body.id[k]] = k;
    for (const std::size_t k : slot) {
      first_[b].push_back(size());
      const Faces faces{at(body.lower_face, k), at(body.upper_face, k)};
      for (const auto& point : surface_points(faces)) {
        work_piece_.push_back(work_piece);
        length_.push_back(point.area_vector.norm());
        circumference_.push_back(
            geometry_ == Geometry::plane ? 1.0 : circumference_of(point, faces, at(body.x, k)));
        alone_.push_back(point.alone);
        const Vec n = point.area_vector.normalized(), x = at(body.x, k) + point.shift;
        normal_.insert(normal_.end(), n.begin(), n.end());
        position_.insert(position_.end(), x.begin(), x.end());
      }
    }
    first_[b].push_back(size());
    ++work_piece;
  }
  for (auto* sum : {&state_.pressure, &state_.speed, &state_.shear, &state_.friction_work,
                    &state_.sliding_pressure, &state_.shear_work})
    sum->assign(size(), 0.0);
  state_.traction.assign(dim * size(), 0.0);
  state_.wetted.assign(size(), 0);
}

void SurfaceRecord::add(const std::vector<Boundary>& boundaries, const Particles& fluid, double p_offset,
                        const ClusterList& neighbours, const Kernel& kernel, double dt) {
  add(find(boundaries, fluid, p_offset, neighbours, kernel), dt);
}

std::vector<SurfaceContact> SurfaceRecord::find(const std::vector<Boundary>& boundaries,
                                                const Particles& fluid, double p_offset,
                                                const ClusterList& neighbours, const Kernel& kernel) const {
  std::vector<SurfaceContact> found(size());
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    const Boundary& body = boundaries[b];
    if (first_[b].empty()) continue;
    for (std::size_t k = 0; k < body.count; ++k) {
      const std::size_t first = first_[b][body.id[k]], end = first_[b][body.id[k] + 1];
      double sum = 0;
      for (std::size_t s = first; s < end; ++s) sum += area(s);
      for (std::size_t s = first; s < end; ++s)
        found[s] = find_at(s, body, k, sum, fluid, p_offset, neighbours, kernel);
    }
  }
  return found;
}

SurfaceContact SurfaceRecord::find_at(std::size_t s, const Boundary& body, std::size_t k, double area,
                                      const Particles& fluid, double p_offset, const ClusterList& neighbours,
                                      const Kernel& kernel) const {
  const Vec n_s = body.turned(Eigen::Map<const Vec>(&normal_[dim * s]));
  const Contact contact =
      contact_of(body, k, alone_[s] ? Vec(Vec::Zero()) : Vec(n_s), fluid, p_offset, kernel);
  SurfaceContact found{.there = contact.there, .pressure = contact.pressure};
  if (body.is_slippery()) {
    if (contact.there) found.sliding = at(body.slip_velocity, k).norm(), found.shear = body.shear_stress[k];
  } else if (sticks_) {
    const double gdot = shear_rate_at(body, k, {at(body.x, k), at(body.v, k), n_s, sticks_->spacing}, fluid,
                                      neighbours, kernel);
    found.sliding = removal_.grain_length * gdot;
    found.shear = sticks_->viscosity(gdot) * gdot;
  } else {
    found.sliding = (contact.velocity - n_s.dot(contact.velocity) * n_s).norm();
  }
  if (body.friction_force[0].empty()) return found;
  const Vec tau = at(body.friction_force, k) / area;
  found.shear += tau.norm();
  found.traction = body.turned_back(tau);
  found.friction_power = tau.dot(contact.velocity);
  return found;
}

void SurfaceRecord::collect(std::vector<SurfaceContact>& found, const std::vector<Boundary>& boundaries,
                            const Ranks& ranks) const {
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    if (first_[b].empty()) continue;
    const Boundary& body = boundaries[b];
    bool any = true;
    for (std::size_t n = 0; any; ++n) {  // the n-th point of each particle
      std::array<Field, 5 + dim> values;
      std::vector<Field*> fields;
      for (Field& field : values) field.resize(padded(body.count)), fields.push_back(&field);
      const auto over_points = [&](auto&& visit) {
        any = false;
        for (std::size_t k = 0; k < body.count; ++k)
          if (const std::size_t s = first_[b][body.id[k]] + n; s < first_[b][body.id[k] + 1])
            visit(k, found[s]), any = true;
      };
      over_points([&](std::size_t k, const SurfaceContact& now) {
        const double all[] = {now.there ? 1.0 : 0.0, now.pressure,    now.sliding,       now.shear,
                              now.traction[0],       now.traction[1], now.friction_power};
        for (std::size_t c = 0; c < values.size(); ++c) values[c][k] = all[c];
      });
      if (any) ranks.collect_at(b, fields);
      over_points([&](std::size_t k, SurfaceContact& now) {
        now = {.there = values[0][k] == 1,
               .pressure = values[1][k],
               .sliding = values[2][k],
               .shear = values[3][k],
               .traction = {values[4][k], values[5][k]},
               .friction_power = values[6][k]};
      });
    }
  }
}

void SurfaceRecord::add(const std::vector<SurfaceContact>& found, double dt) {
  for (std::size_t s = 0; s < size(); ++s) {
    const SurfaceContact& now = found[s];
    if (now.there) state_.wetted[s] = 1;
    state_.pressure[s] += now.pressure * dt;
    state_.speed[s] += now.sliding * dt;
    state_.shear[s] += now.shear * dt;
    state_.sliding_pressure[s] += now.pressure * now.sliding * dt;
    state_.shear_work[s] += now.shear * now.sliding * dt;
    Eigen::Map<Vec>(&state_.traction[dim * s]) += now.traction * dt;
    state_.friction_work[s] += now.friction_power * dt;
  }
  state_.since_row += dt;
}

void SurfaceRecord::open(const std::filesystem::path& out) {
  file_ = std::make_shared<HdfSeriesFile>(out / "surface.h5");
  const hsize_t count = size();
  file_->constant("start_position", "m", {count, dim}, position_);
  file_->constant("normal", "1", {count, dim}, normal_);
  file_->constant("area", "m", {count}, length_);
  if (geometry_ == Geometry::axisymmetric) file_->constant("circumference", "m", {count}, circumference_);
  file_->constant("work_piece", "1", {count}, std::span<const std::uint32_t>(work_piece_));
  file_->attribute("work_piece", "names", names_);
  file_->series("time", "s", {});
  file_->series("contact_pressure", "Pa", {count});
  file_->series("sliding_speed", "m/s", {count});
  file_->series("shear_stress", "Pa", {count});
  file_->series("friction_traction", "Pa", {count, dim});
  file_->series("friction_work", "J/m2", {count});
  file_->series("sliding_pressure", "Pa.m", {count});
  for (const DepthLaw& law : laws_) file_->series(law.column, "m", {count});
}

void SurfaceRecord::write(double time) {
  const auto scaled = [](std::vector<double> values, double factor) {
    for (double& value : values) value *= factor;
    return values;
  };
  const double share = state_.since_row > 0 ? 1 / state_.since_row : 0.0;
  const auto p = scaled(state_.pressure, share), v = scaled(state_.speed, share),
             tau = scaled(state_.shear, share), traction = scaled(state_.traction, share);
  std::array<std::vector<double>, 3> depths;
  for (std::size_t k = 0; k < laws_.size(); ++k) depths[k] = scaled(integral_of(laws_[k]), laws_[k].rate);
  // the last three, as many of them as there are laws
  file_->append({&time, p.data(), v.data(), tau.data(), traction.data(), state_.friction_work.data(),
                 state_.sliding_pressure.data(), depths[0].data(), depths[1].data(), depths[2].data()});
  for (auto* sum : {&state_.pressure, &state_.speed, &state_.shear, &state_.traction})
    std::fill(sum->begin(), sum->end(), 0.0);
  state_.since_row = 0;
}

std::vector<Observation> SurfaceRecord::observe() const {
  double wetted = 0, rough = 0;
  const auto& ra = removal_.roughness;
  for (std::size_t k = 0; k < size(); ++k) {
    if (!state_.wetted[k]) continue;
    wetted += area(k);
    if (ra)
      rough += area(k) * (ra->final + (ra->initial - ra->final) * std::exp(-depth(k) / ra->decay_depth));
  }
  const auto sums_of = [&](const DepthLaw& law) {
    struct {
      double integral = 0, largest = 0;
    } sums;
    const auto& values = integral_of(law);
    for (std::size_t k = 0; k < size(); ++k)
      if (state_.wetted[k]) {
        sums.integral += area(k) * values[k];
        sums.largest = std::max(sums.largest, values[k]);
      }
    return sums;
  };
  const auto mean = [&](double integral) { return wetted > 0 ? integral / wetted : 0.0; };
  const DepthLaw& counts = laws_.front();
  const bool in_plane = geometry_ == Geometry::plane;
  const auto removed = sums_of(counts);
  std::vector<Observation> row{
      {"removed_depth_mean", "m", counts.rate * mean(removed.integral)},
      {"removed_depth_largest", "m", counts.rate * removed.largest},
      in_plane ? Observation{"removed_area", "m2", counts.rate * removed.integral}
               : Observation{"removed_volume", "m3", counts.rate * removed.integral},
      in_plane ? Observation{"wetted_length", "m", wetted} : Observation{"wetted_area", "m2", wetted}};
  for (const DepthLaw& law : std::span(laws_).subspan(1)) {
    const auto sums = sums_of(law);
    row.push_back({law.column + std::string("_mean"), "m", law.rate * mean(sums.integral)});
    row.push_back({law.column + std::string("_largest"), "m", law.rate * sums.largest});
  }
  if (ra) row.push_back({"roughness_mean", "m", wetted > 0 ? rough / wetted : ra->initial});
  return row;
}

}  // namespace toryu::fluid
