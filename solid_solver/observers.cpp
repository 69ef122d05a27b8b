#include "solid_solver/observers.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>

#include "common/error/counted.hpp"
#include "common/scene/period.hpp"
#include "common/sph/kernel.hpp"

namespace toryu::solid {

void describe(ParameterTable& table, PointObserver& observer) {
  table.text("name", observer.name,
             {.required = true, .help = "prefix of the columns", .names_columns = true});
  table.vector("point", observer.point, {.unit = "m", .required = true, .help = "in the unloaded body"});
  table.flag("stress", observer.stress, "whether the stress there is reported too");
}

void describe(ParameterTable& table, Detachment& p) {
  table.number("bond_length", p.bond_length,
               {.minimum = 0,
                .maximum = 10,
                .help = "particles nearer than so many spacings hold each other; 0: the kernel's support"});
  table.number("interval", p.interval,
               {.unit = "s", .minimum = 0, .above_minimum = true, .help = "between two looks"});
}

void describe(ParameterTable& table, BondLimits& p) {
  table.number("torn_at", p.torn_at,
               {.minimum = 1, .above_minimum = true, .help = "present over first length of a torn bond"});
  table.number(
      "clumped_at", p.clumped_at,
      {.minimum = 0, .maximum = 1, .help = "present over first length where particles have clumped"});
  table.flag("stop", p.stop, "whether a bond that is torn or clumped ends the run as a failure of physics");
}

MaterialPoint::MaterialPoint(const Vec& point, const std::vector<Vec>& of_body, double reach,
                             const Shape& shape, const std::vector<Vec>& shifts) {
  const std::vector<Vec> X = with_images(of_body, shifts);
  using Basis = Eigen::Matrix<double, dim + 1, 1>;
  const CubicSpline W(0.5 * reach);
  Eigen::Matrix<double, dim + 1, dim + 1> moments = Eigen::Matrix<double, dim + 1, dim + 1>::Zero();
  std::vector<Basis> bases;
  // a point in a gap belongs to all that surrounds it
  const bool in_material = std::any_of(
      X.begin(), X.end(), [&](const Vec& x) { return (x - point).norm() < reach && shape.sees(point, x); });
  for (std::size_t j = 0; j < X.size(); ++j) {
    const Vec r = (X[j] - point) / reach;
    if (r.norm() >= 1.0 || (in_material && !shape.joins(point, X[j]))) continue;
    Basis basis;
    basis << 1.0, r;
    const double weight = W.value(r.norm() * reach) / W.value(0.0);
    moments += weight * basis * basis.transpose();
    particles_.push_back(static_cast<std::uint32_t>(j % of_body.size()));
    bases.push_back(basis);
    weights_.push_back(weight);
  }
  const Eigen::FullPivLU<decltype(moments)> solver(moments);
  if (particles_.size() <= dim || !solver.isInvertible())
    throw std::invalid_argument(fmt::format("the point ({:g}, {:g}) is not in the solid: {} within {:g} m",
                                            point[0], point[1], counted(particles_.size(), "particle"),
                                            reach));
  const Basis at_point = Basis::Unit(0);
  const Basis solution = solver.solve(at_point);
  for (std::size_t k = 0; k < weights_.size(); ++k) weights_[k] *= solution.dot(bases[k]);
}

}  // namespace toryu::solid
