/// A medium at another temperature: the table, and what it does to each law.
#include "fluid_solver/temperature.hpp"

#include <gmock/gmock.h>

#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {
namespace {

const Temperature table{310, {{290, 4.0}, {300, 1.0}, {320, 0.25}}};

Temperature at_temperature(double value) {
  Temperature temperature = table;
  temperature.value = value;
  return temperature;
}

TEST(Temperature, ReadsItsTableByALineInTheLogarithm) {
  EXPECT_DOUBLE_EQ(shift_factor(at_temperature(290)), 4);
  EXPECT_DOUBLE_EQ(shift_factor(at_temperature(295)), 2);
  EXPECT_DOUBLE_EQ(shift_factor(at_temperature(300)), 1);
  EXPECT_DOUBLE_EQ(shift_factor(at_temperature(310)), 0.5);
  EXPECT_DOUBLE_EQ(shift_factor(at_temperature(320)), 0.25);
}

/// eta(gdot, T) = a_T eta(a_T gdot).
void expect_superposition(Parameters p) {
  const Parameters before = p;
  p.temperature = table;
  complete_medium(p);
  for (const double gdot : {0.0, 1e-3, 0.2, 7.0, 1e3, 1e9})
    EXPECT_NEAR(viscosity_of(p, gdot) / (0.5 * viscosity_of(before, 0.5 * gdot)), 1, 1e-12) << gdot;
}

TEST(Temperature, ScalesTimesAndNoStress) {
  Parameters newtonian, thinning, plastic, carreau;
  newtonian.laminar_viscosity = LaminarViscosity{3};
  thinning.power_law = PowerLaw{20, 0.4, 0.1, 200};
  plastic.herschel_bulkley = HerschelBulkley{{20, 0.4, 0.1, 2000}, 30, 5};
  carreau.carreau = Carreau{10, 1, 2, 0.5};
  for (const Parameters& p : {newtonian, thinning, plastic, carreau}) expect_superposition(p);
  Parameters elastic;
  elastic.viscoelasticity = Viscoelasticity{{{2, 6, 0.1}}};
  elastic.temperature = table;
  complete_medium(elastic);
  const PolymerMode& mode = elastic.viscoelasticity->modes[0];
  EXPECT_DOUBLE_EQ(mode.relaxation_time, 1);
  EXPECT_DOUBLE_EQ(mode.polymer_viscosity, 3);
  EXPECT_DOUBLE_EQ(mode.mobility, 0.1);
}

TEST(Temperature, ScalesAMediumOfAName) {
  Parameters p;
  p.medium = NamedMedium{"newtonian_1000"};
  p.temperature = table;
  EXPECT_EQ(complete_medium(p).size(), 2u);
  EXPECT_DOUBLE_EQ(viscosity_of(p, 1), 500);
}

}  // namespace
}  // namespace toryu::fluid
