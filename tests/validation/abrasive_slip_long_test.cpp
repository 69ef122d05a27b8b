// cases/abrasive_slip/power_law.toml at its own spacing.
#include "tests/validation/abrasive_slip.hpp"

namespace toryu::fluid {
namespace {

TEST(AbrasiveSlipLong, HasThePressureDropAndSlipOfAPowerLaw) {
  expect_sliding("power_law.toml", 1e-4, 0.02, 0.02);
}

}  // namespace
}  // namespace toryu::fluid
