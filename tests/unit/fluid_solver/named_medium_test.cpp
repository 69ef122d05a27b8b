/// Media by name: their law, their range, and what is told beyond it.
#include "fluid_solver/named_medium.hpp"

#include <gmock/gmock.h>

#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Optional;

Parameters c_11() {
  Parameters p;
  p.medium = NamedMedium{"trengove_c11"};
  return p;
}

TEST(NamedMedium, HasThePublishedLaw) {
  Parameters p = c_11();
  EXPECT_THAT(complete_medium(p), ElementsAre(HasSubstr("Trengove 1993")));
  EXPECT_NEAR(viscosity_of(p, 100), 989 * std::pow(100, -0.065), 1e-9);
  Parameters newtonian;
  newtonian.medium = NamedMedium{"newtonian_1000"};
  complete_medium(newtonian);
  EXPECT_EQ(viscosity_of(newtonian, 3), 1000);
  EXPECT_THROW(record_of(NamedMedium{"honey"}), std::logic_error);
}

TEST(NamedMedium, KeepsWhatItsBoundsDoBelowAThousandthOfTheStress) {
  // the bounds of C-11 act below 2e-5 and above 3e4 1/s
  const auto& law = std::get<PowerLaw>(record_of(NamedMedium{"trengove_c11"}).law);
  for (const double gdot : {1e-4, 1.0, 1e4})
    EXPECT_DOUBLE_EQ(viscosity(law, gdot), 989 * std::pow(gdot, -0.065)) << gdot;
}

TEST(NamedMedium, TellsOfAPassageThatShearsItBeyondItsRange) {
  Parameters p = c_11();
  complete_medium(p);
  p.similarity = Similarity{.mean_speed = 0.05, .passage_width = 0.002, .passage_length = 0.016};
  EXPECT_THAT(beyond_measured(p), Optional(HasSubstr("153 1/s, and 'trengove_c11' was measured up to 100")));
  p.similarity->mean_speed = 0.03;
  EXPECT_EQ(beyond_measured(p), std::nullopt);
}

TEST(NamedMedium, TellsOfFluidThatIsShearedBeyondItsRange) {
  const MediumRecord& record = record_of(NamedMedium{"trengove_c11"});
  Particles f;
  f.count = 300;
  EXPECT_EQ(beyond_measured(record, f, 1), std::nullopt);  // no shear rate is known
  f.gdot.assign(padded(300), 99);
  f.gdot[0] = f.gdot[1] = 101;
  EXPECT_EQ(beyond_measured(record, f, 1), std::nullopt);
  f.gdot[2] = 101;
  EXPECT_THAT(beyond_measured(record, f, 1), Optional(HasSubstr("1 % of the fluid")));
}

}  // namespace
}  // namespace toryu::fluid
