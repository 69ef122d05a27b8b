#include "solid_solver/bonds.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "common/run/failure.hpp"
#include "solid_solver/sorted_points.hpp"

namespace toryu {

namespace {

/// Over the spacing: side and diagonal of a lattice's cell, also where a region's cells are a little longer.
constexpr double reach_of_adjacent = 1.5;

}  // namespace

Bonds::Bonds(const SolidBody& body, const BondLimits& limits) : limits_(limits) {
  const double reach = reach_of_adjacent * body.spacing;
  const SortedPoints points(body.X, reach);
  for (std::uint32_t i = 0; i < body.size(); ++i)
    points.near(body.X[i], reach, [&](std::uint32_t j) {
      if (i < j) bonds_.push_back({i, j, (body.X[i] - body.X[j]).norm()});
    });
}

Stretches Bonds::stretches(const std::vector<Vec>& x) const {
  Stretches found;
  for (const auto& bond : bonds_) {
    const double stretch = (x[bond.i] - x[bond.j]).norm() / bond.length;
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

void BondWatch::look(const std::vector<Vec>& x, double time) {
  const Stretches found = bonds_.stretches(x);
  most_torn_ = std::max(most_torn_, found.torn);
  most_clumped_ = std::max(most_clumped_, found.clumped);
  if (limits_.stop && found.torn > 0)
    throw PhysicsFailure("solid", found.longest, time, "stretch of a bond",
                         fmt::format("{:.4g}", found.largest), fmt::format("{:g}", limits_.torn_at));
  if (limits_.stop && found.clumped > 0)
    throw PhysicsFailure("solid", found.shortest, time, "stretch of a bond",
                         fmt::format("{:.4g}", found.smallest), fmt::format("{:g}", limits_.clumped_at));
  const auto tell = [&](long count, long& told, const char* what, const char* than, double limit,
                        std::uint32_t particle) {
    if (count == 0 || count < 2 * told) return;
    told = count;
    spdlog::warn(
        "the solid has {} at t = {:.6g} s: {} bonds are {} than {:g} times their first length, most "
        "that of particle {} at ({:.4g}, {:.4g}) m",
        what, time, count, than, limit, particle, x[particle][0], x[particle][1]);
  };
  tell(found.torn, told_torn_, "torn", "longer", limits_.torn_at, found.longest);
  tell(found.clumped, told_clumped_, "clumped", "shorter", limits_.clumped_at, found.shortest);
}

}  // namespace toryu
