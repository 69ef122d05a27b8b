#include "solid_solver/stability_warnings.hpp"

#include <gmock/gmock.h>

#include "samples.hpp"

namespace toryu::solid {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Parameters updated(double epsilon, double alpha) {
  Parameters p = free_plate(4);
  p.formulation = Formulation::updated_lagrangian;
  p.artificial_stress = ArtificialStress{.epsilon = epsilon};
  p.artificial_viscosity = ArtificialViscosity{.alpha = alpha};
  return p;
}

TEST(Guards, LeaveTheMiddleAndTheOtherFormulationAlone) {
  EXPECT_THAT(stability_warnings(updated(0.3, 1.0)), ElementsAre());
  EXPECT_THAT(stability_warnings(free_plate(4)), ElementsAre());
}

TEST(Guards, TellOfBodiesThatStandLessThanASpacingApart) {
  Parameters p = free_plate(6);
  const double d = p.spacing;
  p.regions = {{"a", {Vec(0, 0), Vec(6 * d, 6 * d)}}, {"b", {Vec(6.8 * d, 0), Vec(13 * d, 6 * d)}}};
  EXPECT_THAT(stability_warnings(p), ElementsAre(HasSubstr("regions 'a' and 'b' stand")));
  p.body_contact = Contact{};
  EXPECT_THAT(stability_warnings(p), ElementsAre());
  p.body_contact.reset();
  p.regions[1].box.min[0] = 6 * d;
  EXPECT_THAT(stability_warnings(p), ElementsAre()) << "they touch";
}

TEST(Guards, TakeTheThicknessOfAllRegionsTogether) {
  Parameters p = free_plate(6);
  const double d = p.spacing;
  const auto box = [&](double x0, double y0, double x1, double y1) -> Box {
    return {d * Vec(x0, y0), d * Vec(x1, y1)};
  };
  p.regions = {{"lower", box(0, 0, 40, 1)}, {"upper", box(0, 1, 40, 6)}};
  EXPECT_THAT(stability_warnings(p), ElementsAre());
  p.regions = {{"long", box(0, 0, 40, 6)}, {"slice", box(40, 0, 41, 6)}, {"end", box(41, 0, 60, 6)}};
  EXPECT_THAT(stability_warnings(p), ElementsAre());
  p.regions = {{"lower", box(0, 0, 40, 1)}, {"upper", box(0, 1, 40, 2)}};
  EXPECT_THAT(stability_warnings(p), ElementsAre(HasSubstr("a plate of 2 rows bends")));
  p.regions = {{"lower", box(0, 0, 40, 1)}, {"upper", box(0, 1.5, 40, 7)}};
  EXPECT_THAT(stability_warnings(p), testing::Contains(HasSubstr("a plate of 1 row bends"))) << "a gap";
}

TEST(Guards, NameTheMapBeyondWhoseEdgeACaseLies) {
  EXPECT_THAT(stability_warnings(updated(0.1, 1.0)),
              ElementsAre(HasSubstr("cases/stretched_bar/tensile_map.toml")));
  EXPECT_THAT(stability_warnings(updated(0.7, 1.0)),
              ElementsAre(HasSubstr("cases/stretched_bar/tensile_window_map.toml")));
  Parameters p = updated(0.3, 1.0);
  p.artificial_stress.reset();
  EXPECT_THAT(stability_warnings(p), ElementsAre(HasSubstr("epsilon 0 is below the 0.18 that")));
  p = updated(0.3, 0.2);
  p.courant_number = 1.0;
  EXPECT_THAT(stability_warnings(p), ElementsAre(HasSubstr("cases/oscillating_plate/time_step_map.toml")));
  p.integrator = Integrator::symplectic;
  EXPECT_THAT(stability_warnings(p), ElementsAre());
  p.courant_number = 2.4;
  EXPECT_THAT(stability_warnings(p), ElementsAre(HasSubstr("is 1.92, beyond the edge of stability at 1.84")));
  p = updated(0.3, 1.0);
  p.artificial_viscosity.reset();
  EXPECT_THAT(stability_warnings(p), ElementsAre(HasSubstr("midpoint steps amplify")));
}

TEST(Guards, KnowWhichFormBearsATurn) {
  Parameters p = updated(0.3, 1.0);
  EXPECT_DOUBLE_EQ(stress_edges(p).turn, 0.2);
  // The diagonal of a square that is sheared until sin(gamma)/gamma is 0.95.
  const double gamma = 0.5519;
  EXPECT_NEAR(std::sin(gamma) / gamma, 0.95, 1e-5);
  EXPECT_NEAR(stress_edges(p).strain, std::sqrt(((1 + gamma) * (1 + gamma) + 1) / 2) - 1, 0.006);
  p.gradients = Gradients::renormalised;
  EXPECT_GT(stress_edges(p).turn, 10);
  EXPECT_GT(stress_edges(free_plate(4)).strain, 10) << "the total Lagrangian form";
}

TEST(Guards, ThinPlatesWantHourglassControlAndNotTooHighAPoissonsRatio) {
  Parameters p = free_plate(4);
  p.hourglass.reset();
  EXPECT_THAT(stability_warnings(p), ElementsAre(HasSubstr("4 rows without [solid.hourglass] bends")));
  p.clamps = {{"all", {Vec(-1, -1), Vec(1, 1)}}};
  EXPECT_THAT(stability_warnings(p), ElementsAre()) << "what is held does not bend";
  p = free_plate(12);
  p.hourglass.reset();
  EXPECT_THAT(stability_warnings(p), ElementsAre());
  EXPECT_THAT(stability_warnings(free_plate(3)), ElementsAre());
  EXPECT_THAT(stability_warnings(free_plate(2)),
              ElementsAre(HasSubstr("cases/oscillating_plate/thin_map.toml")));
  p = free_plate(4);
  p.material.poissons_ratio = 0.49;
  EXPECT_THAT(stability_warnings(p), ElementsAre(HasSubstr("cases/oscillating_plate/poisson_map.toml")));
}

TEST(ArtificialStress, MustOutweighWhatTensionDrivesInALattice) {
  // From sums over the lattice by another program.
  EXPECT_NEAR(least_epsilon(1.3, 4, 0.0), 0.150, 1e-3);
  EXPECT_NEAR(least_epsilon(1.3, 4), 0.185, 1e-3);
  EXPECT_NEAR(least_epsilon(1.2, 2), 0.320, 1e-3);
  EXPECT_NEAR(least_epsilon(1.5, 6), 0.063, 1e-3);
}

}  // namespace
}  // namespace toryu::solid
