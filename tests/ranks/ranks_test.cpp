// A fluid over MPI ranks is the fluid of one process, bit for bit. Started by mpirun.
#include <gtest/gtest.h>

#include "fluid_solver/held_volume.hpp"
#include "fluid_solver/ranks/zoltan_ranks.hpp"
#include "tests/validation/fluid_case.hpp"

namespace toryu::fluid {
namespace {

constexpr int steps = 600;

struct Seen {
  std::vector<double> time_steps;
  long builds = 0, balancings = 0;
  std::size_t most_held = 0, most_owned = 0;  ///< by a rank after the start
  std::size_t particles = 0;                  ///< of all
  int ranks = 1;
};

std::vector<double> advance(FluidModel& model, int count, const std::function<void()>& after_step = {}) {
  std::vector<double> time_steps;
  for (int n = 0; n < count; ++n) {
    time_steps.push_back(model.time_step_limit());
    model.advance(time_steps.back());
    if (after_step) after_step();
  }
  return time_steps;
}

/// The state of the particles, in the order of their numbers.
std::vector<std::vector<double>> states(Particles fluid) {
  std::vector<std::vector<double>> by_number(fluid.count);
  for_each_field(fluid, [&](auto& field) {
    if (field.kind != FieldKind::state) return;
    for_each_component(field, [&](const Field& component) {
      for (std::size_t i = 0; !component.empty() && i < fluid.count; ++i)
        by_number.at(fluid.id[i]).push_back(component[i]);
    });
  });
  return by_number;
}

/// The pressure that the fluid gives the particles of the walls.
void expect_the_same_at_walls(const FluidModel& found, const FluidModel& expected) {
  ASSERT_EQ(found.boundaries().size(), expected.boundaries().size());
  for (std::size_t b = 0; b < expected.boundaries().size(); ++b) {
    const Boundary &wall = found.boundaries()[b], &wanted = expected.boundaries()[b];
    for (std::size_t w = 0; w < wanted.count; ++w)
      EXPECT_EQ(wall.p[w], wanted.p[w]) << w << " of " << wanted.name << " at y = " << wanted.x[1][w];
  }
}

/// What walls have done to the fluid, and what terms take from it.
void expect_the_same_sums(FluidModel& part, FluidModel& whole, bool leads) {
  const auto wanted = whole.look().powers, found = part.look().powers;
  if (!leads) return;
  for (std::size_t k = 0; k < wanted.size(); ++k)
    EXPECT_EQ(found[k].value, wanted[k].value) << wanted[k].term;
  for (std::size_t b = 0; b < whole.boundaries().size(); ++b) {
    const Boundary &here = part.boundaries()[b], &there = whole.boundaries()[b];
    EXPECT_EQ(here.impulse.total, there.impulse.total) << there.name;
    EXPECT_EQ(here.impulse.friction, there.impulse.friction) << there.name;
    EXPECT_EQ(here.work, there.work) << there.name;
  }
}

Seen expect_the_same(const std::string& name, const std::vector<std::string>& overrides, int count = steps) {
  const FluidCase the_case(name, overrides);
  WeaklyCompressible whole = the_case.solver(), part = the_case.solver();
  const std::vector<double> time_steps = advance(whole, count);
  ZoltanRanks ranks(MPI_COMM_WORLD);
  part.spread_over(ranks);
  Seen seen;
  seen.time_steps = advance(part, count, [&] {
    seen.most_held = std::max(seen.most_held, part.particle_count());
    seen.most_owned = std::max(seen.most_owned, ranks.own_count());
  });
  EXPECT_EQ(seen.time_steps, time_steps);
  seen.builds = part.list_builds(), seen.balancings = ranks.balancings();
  EXPECT_EQ(seen.builds, whole.list_builds());
  WeaklyCompressible all = the_case.solver();
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  part.collect(rank == 0 ? &all : nullptr, true);
  expect_the_same_sums(part, whole, rank == 0);
  if (rank == 0) {
    const Particles& gathered = all.particles();
    EXPECT_EQ(gathered.count, whole.particle_count());
    EXPECT_EQ(gathered.id, whole.particles().id) << "in the same order";
    const auto found = states(gathered), expected = states(whole.particles());
    std::size_t others = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) others += i >= found.size() || found[i] != expected[i];
    EXPECT_EQ(others, 0u) << "particles in another state, of " << expected.size();
    expect_the_same_at_walls(all, whole);
    std::printf(
        "%s on %d ranks: %zu particles, %ld list builds, %ld balancings, rank 0 holds %zu and owns %zu\n",
        name.c_str(), ranks.size(), expected.size(), seen.builds, seen.balancings, seen.most_held,
        seen.most_owned);
  }
  seen.particles = whole.particle_count(), seen.ranks = ranks.size();
  return seen;
}

TEST(FluidOverRanks, FallsAsADamBreakDoes) {
  for (const std::string integrator : {"midpoint", "symplectic"}) {
    const Seen seen =
        expect_the_same("dam_break", {"fluid.spacing=0.0028575", "fluid.integrator=\"" + integrator + "\""});
    EXPECT_GT(seen.builds, 10);
    if (seen.ranks > 1) {
      EXPECT_LT(seen.most_held, seen.particles) << "a rank holds its own particles and ghosts alone";
    }
  }
}

TEST(FluidOverRanks, DiffusesItsDensityPlainly) {
  expect_the_same("dam_break", {"fluid.spacing=0.0028575", "fluid.density_diffusion.gradient=\"none\""});
}

TEST(FluidOverRanks, IsViscous) {
  expect_the_same("dam_break", {"fluid.spacing=0.0028575", "fluid.laminar_viscosity.dynamic_viscosity=1.0",
                                "fluid.wall_model.slip=\"no_slip\""});
}

TEST(FluidOverRanks, IsPressed) {
  expect_the_same("abrasive_throat/pressed.toml", {"fluid.spacing=0.0004"}, 100);
}

TEST(FluidOverRanks, IsViscoelastic) {
  expect_the_same("viscoelastic_channel", {"fluid.spacing=0.1"}, 100);
}

TEST(FluidOverRanks, RubsOnWorkPieces) {
  expect_the_same("abrasive_flow/rigid.toml", {}, 100);
}

TEST(FluidOverRanks, SlidesAtAMeanPressure) {
  expect_the_same("abrasive_slip/coulomb.toml", {"fluid.spacing=0.0002"}, 60);
}

TEST(FluidOverRanks, HoldsItsVolume) {
  const FluidCase the_case("lid_driven_cavity/re_400.toml", {"fluid.spacing=0.05"});
  WeaklyCompressible whole = the_case.solver(), part = the_case.solver();
  ZoltanRanks ranks(MPI_COMM_WORLD);
  part.spread_over(ranks);
  EXPECT_EQ(advance(part, steps), advance(whole, steps));
  EXPECT_EQ(volume(part.particles(), &ranks), volume(whole.particles()));
  const double found = part.density_of_packing();
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) {
    EXPECT_EQ(found, whole.density_of_packing());
  }
}

/// A cut through a high column may lie just above a low one, whose water reaches walls of the upper part.
TEST(FluidOverRanks, ActsOnWallsOfPartsThatHaveNoFluidThere) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  for (const std::string top : {"0.0314", "0.0343", "0.0371", "0.0400"}) {
    const FluidCase the_case(
        "dam_break",
        {"fluid.spacing=0.0028575", "fluid.hydrostatic_start=false",
         "wall=[{name=\"floor\",box={min=[-0.02,-0.02],max=[0.13,0.0]}},{name=\"left\",box={min=[-0.02,0.0],"
         "max=[0.0,0.2]}},{name=\"right\",box={min=[0.0986,0.0],max=[0.1186,0.2]}}]",
         "fluid.region=[{name=\"high\",box={min=[0.0,0.0],max=[0.0286,0.12]}},"
         "{name=\"low\",box={min=[0.07,0.0],max=[0.0986," +
             top + "]}}]"});
    WeaklyCompressible whole = the_case.solver(), part = the_case.solver(), all = the_case.solver();
    ZoltanRanks ranks(MPI_COMM_WORLD);
    part.spread_over(ranks);
    for (int n = 0; n < 40; ++n) {
      const double dt = whole.time_step_limit();
      whole.advance(dt);
      part.advance(dt);
      part.collect(rank == 0 ? &all : nullptr, true);
      if (rank == 0) expect_the_same_at_walls(all, whole);
    }
  }
}

TEST(FluidOverRanks, MayHaveRanksWithoutParticles) {
  const FluidCase the_case(
      "dam_break", {"fluid.spacing=0.0028575", "fluid.hydrostatic_start=false", "fluid.particle_shifting={}",
                    "fluid.region=[{name=\"left\",box={min=[0.0,0.0],max=[0.0028575,0.0028575]}},"
                    "{name=\"right\",box={min=[0.8001,0.1],max=[0.8029575,0.1028575]}}]"});
  WeaklyCompressible whole = the_case.solver(), part = the_case.solver();
  ZoltanRanks ranks(MPI_COMM_WORLD);
  part.spread_over(ranks);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  for (int n = 0; n < 20; ++n) {
    const double dt = whole.time_step_limit();
    EXPECT_EQ(part.time_step_limit(), dt);
    whole.advance(dt);
    part.advance(dt);
    const auto wanted = whole.look().powers, found = part.look().powers;
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t k = 0; rank == 0 && k < wanted.size(); ++k)
      EXPECT_EQ(found[k].value, wanted[k].value) << wanted[k].term;
  }
}

TEST(FluidOverRanks, IsAtRestInATank) {
  expect_the_same("hydrostatic_tank", {});
}

}  // namespace
}  // namespace toryu::fluid

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  const int failures = RUN_ALL_TESTS();
  MPI_Finalize();
  return failures;
}
