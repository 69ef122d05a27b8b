#include "solid_solver/bonds.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "common/error/counted.hpp"
#include "common/error/failure.hpp"
#include "common/run/log.hpp"
#include "common/sph/sorted_points.hpp"

namespace toryu::solid {

namespace {

/// Over the spacing: side and diagonal of a lattice's cell, also where a region's cells are a little longer.
constexpr double reach_of_adjacent = 1.5;
/// Of the moment of a particle's bonds, over the square of its trace: those of a corner have 3/16.
constexpr double least_determinant = 0.01;

}  // namespace

Bonds::Bonds(const Body& body, const BondLimits& limits) : limits_(limits) {
  const double reach = reach_of_adjacent * body.spacing;
  const SortedPoints points(body.X, reach);
  for (std::uint32_t i = 0; i < body.size(); ++i)
    for (const Vec& shift : body.shifts)
      points.near(body.X[i] - shift, reach, [&](std::uint32_t j) {
        const Vec first = body.X[j] + shift - body.X[i];
        if (i < j && body.shape.joins(body.X[i], body.X[j] + shift))
          bonds_.push_back({i, j, shift, first, first.norm()});
      });
  inverse_moment_.assign(body.size(), Mat::Zero());
  for (const auto& bond : bonds_)
    for (const std::uint32_t k : {bond.i, bond.j}) inverse_moment_[k] += bond.first * bond.first.transpose();
  for (Mat& moment : inverse_moment_) {
    const double size = moment.trace();
    moment = moment.determinant() > least_determinant * size * size ? Mat(moment.inverse()) : Mat::Zero();
  }
}

std::vector<Mat> Bonds::deformations(const std::vector<Vec>& x) const {
  std::vector<Mat> F(x.size(), Mat::Zero());
  for (const auto& bond : bonds_) {
    const Mat product = bond.now(x) * bond.first.transpose();  // the same from either side
    F[bond.i] += product;
    F[bond.j] += product;
  }
  for (std::size_t k = 0; k < F.size(); ++k)
    F[k] = inverse_moment_[k].isZero(0) ? Mat(Mat::Identity()) : Mat(F[k] * inverse_moment_[k]);
  return F;
}

double Bonds::largest_turn(const std::vector<Mat>& F) const {
  static_assert(dim == 2, "a rotation is one angle");
  std::vector<Vec> direction(F.size()), mean;
  for (std::size_t k = 0; k < F.size(); ++k)
    direction[k] = Vec(F[k](0, 0) + F[k](1, 1), F[k](1, 0) - F[k](0, 1)).normalized();
  mean = direction;
  for (const auto& bond : bonds_) {
    mean[bond.i] += direction[bond.j];
    mean[bond.j] += direction[bond.i];
  }
  double largest = 0;
  for (const Vec& d : mean) largest = std::max(largest, std::abs(std::atan2(d[1], d[0])));
  return largest;
}

Stretches Bonds::stretches(const std::vector<Vec>& x) const {
  Stretches found;
  const std::vector<Mat> F = deformations(x);
  found.turn = largest_turn(F);
  for (const auto& bond : bonds_) {
    const Vec now = bond.now(x);
    const double stretch = now.norm() / bond.length;
    const Vec deformed = 0.5 * (F[bond.i] + F[bond.j]) * bond.first;
    if (const double rest = (now - deformed).norm() / bond.length; rest > found.rearranged) {
      found.rearranged = rest;
      found.displaced = bond.i;
    }
    if (stretch > found.largest) {
      found.largest = stretch;
      found.longest = bond.i;
    }
    if (stretch < found.smallest) {
      found.smallest = stretch;
      found.shortest = bond.i;
    }
    found.torn += stretch > limits_.torn_at;
    found.clumped += stretch < limits_.clumped_at;
  }
  return found;
}

void BondWatch::check(State& state, const std::vector<Vec>& x, double time) const {
  const Stretches found = bonds_.stretches(x);
  Stretches& worst = state.worst;
  worst.torn = std::max(worst.torn, found.torn);
  worst.clumped = std::max(worst.clumped, found.clumped);
  if (limits_.stop && found.torn > 0)
    throw PhysicsFailure("solid", found.longest, time, "stretch of a bond",
                         fmt::format("{:.4g}", found.largest), fmt::format("{:g}", limits_.torn_at));
  if (limits_.stop && found.clumped > 0)
    throw PhysicsFailure("solid", found.shortest, time, "stretch of a bond",
                         fmt::format("{:.4g}", found.smallest), fmt::format("{:g}", limits_.clumped_at));
  const auto warn = [&](long count, long& warned, const char* what, const char* than, double limit,
                        std::uint32_t particle) {
    if (count == 0 || count < 2 * warned) return;
    warned = count;
    log::warn(
        "the solid has {} at t = {:.6g} s: {} {} {} than {:g} times the first length, most "
        "that of particle {} at ({:.4g}, {:.4g}) m",
        what, time, counted(count, "bond"), count == 1 ? "is" : "are", than, limit, particle, x[particle][0],
        x[particle][1]);
  };
  warn_of_stress(state, found, time);
  if (found.torn + found.clumped == 0) warn_of_rearrangement(state, found, x[found.displaced], time);
  worst.turn = std::max(worst.turn, found.turn);
  worst.rearranged = std::max(worst.rearranged, found.rearranged);
  worst.largest = std::max(worst.largest, found.largest);
  worst.smallest = std::min(worst.smallest, found.smallest);
  warn(found.torn, state.warned_torn, "torn", "longer", limits_.torn_at, found.longest);
  warn(found.clumped, state.warned_clumped, "clumped", "shorter", limits_.clumped_at, found.shortest);
}

void BondWatch::warn_of_rearrangement(const State& state, const Stretches& found, const Vec& place,
                                      double time) const {
  if (!(found.rearranged > edges_.rearranged && state.worst.rearranged <= edges_.rearranged)) return;
  log::warn(
      "particles of the solid have left their arrangement at t = {:.6g} s: near ({:.4g}, {:.4g}) m bonds "
      "differ by {:.2g} of their length from what the body around them does, beyond the edge at {:g}; "
      "artificial stress, or tension without enough of it, moves them, and shape and stiffness drift from "
      "then "
      "on; take formulation = \"total_lagrangian\" or more artificial viscosity",
      time, place[0], place[1], found.rearranged, edges_.rearranged);
}

void BondWatch::warn_of_stress(const State& state, const Stretches& found, double time) const {
  if (found.turn > edges_.turn && state.worst.turn <= edges_.turn)
    log::warn(
        "the solid has turned by {:.3g} rad at t = {:.6g} s: plain gradients take a turn near a "
        "surface for a strain, beyond the edge at {:g} rad; take gradients = \"renormalised\" or formulation "
        "= "
        "\"total_lagrangian\", see cases/rigid_rotation/turn_map.toml",
        found.turn, time, edges_.turn);
  if (found.strain() > edges_.strain && state.worst.strain() <= edges_.strain)
    log::warn(
        "bonds of the solid are strained by {:.3g} at t = {:.6g} s: stress under the Jaumann rate is then 5 "
        "% "
        "short in shear, or more, beyond the edge at {:g}; see cases/patch_test/jaumann_map.toml",
        found.strain(), time, edges_.strain);
}

}  // namespace toryu::solid
