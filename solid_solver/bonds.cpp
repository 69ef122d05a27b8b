#include "solid_solver/bonds.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/error/failure.hpp"
#include "common/run/log.hpp"
#include "common/sph/sorted_points.hpp"

namespace toryu::solid {

namespace {

/// Over the spacing: side and diagonal of a lattice's cell, also where a region's cells are a little longer.
constexpr double reach_of_adjacent = 1.5;

}  // namespace

Bonds::Bonds(const Body& body, const BondLimits& limits) : limits_(limits) {
  const double reach = reach_of_adjacent * body.spacing;
  const SortedPoints points(body.X, reach);
  for (std::uint32_t i = 0; i < body.size(); ++i)
    points.near(body.X[i], reach, [&](std::uint32_t j) {
      const Vec first = body.X[j] - body.X[i];
      if (i < j && body.shape.joins(body.X[i], body.X[j])) bonds_.push_back({i, j, first, first.norm()});
    });
}

Stretches Bonds::stretches(const std::vector<Vec>& x) const {
  Stretches found;
  double least_cosine = 1.0;
  for (const auto& bond : bonds_) {
    const Vec now = x[bond.j] - x[bond.i];
    const double length = now.norm(), stretch = length / bond.length;
    if (length > 0) least_cosine = std::min(least_cosine, now.dot(bond.first) / (length * bond.length));
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
  found.turn = std::acos(std::max(least_cosine, -1.0));
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
        "the solid has {} at t = {:.6g} s: {} bonds are {} than {:g} times their first length, most "
        "that of particle {} at ({:.4g}, {:.4g}) m",
        what, time, count, than, limit, particle, x[particle][0], x[particle][1]);
  };
  warn_of_stress(state, found, time);
  worst.turn = std::max(worst.turn, found.turn);
  worst.largest = std::max(worst.largest, found.largest);
  worst.smallest = std::min(worst.smallest, found.smallest);
  warn(found.torn, state.warned_torn, "torn", "longer", limits_.torn_at, found.longest);
  warn(found.clumped, state.warned_clumped, "clumped", "shorter", limits_.clumped_at, found.shortest);
}

void BondWatch::warn_of_stress(const State& state, const Stretches& found, double time) const {
  if (found.turn > edges_.turn && state.worst.turn <= edges_.turn)
    log::warn(
        "bonds of the solid have turned by {:.3g} rad at t = {:.6g} s: plain gradients take a turn near a "
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
