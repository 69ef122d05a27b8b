/// Whole runs of analytic sides: what each scheme makes of them, what is said and written of the windows, and
/// how a run ends.
#include <gmock/gmock.h>

#include "tests/unit/coupler/coupled_run_fixture.hpp"

namespace toryu::coupling {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

TEST_F(CoupledRunTest, EverySchemeMovesAHeavySolidAsBothTogether) {
  for (const auto& coupling :
       {explicit_scheme(SchemeKind::serial_robin), explicit_scheme(SchemeKind::serial_explicit),
        explicit_scheme(SchemeKind::serial_explicit, 1), explicit_scheme(SchemeKind::parallel_explicit),
        implicit(AccelerationKind::fixed), implicit(AccelerationKind::aitken),
        implicit(AccelerationKind::quasi_newton)}) {
    sides_ = {};
    run(1.5, coupling);
    EXPECT_LT(error_at(1.5), 0.05) << static_cast<int>(coupling.scheme) << coupling.extrapolation_order;
  }
}

TEST_F(CoupledRunTest, ExplicitSchemesDoNotBearALightSolidAndImplicitOnesDo) {
  sides_.added_mass = 4;
  for (const auto scheme : {SchemeKind::serial_explicit, SchemeKind::parallel_explicit}) {
    AnalyticSides fresh = sides_;
    std::swap(sides_, fresh);
    run(0.5, explicit_scheme(scheme));
    EXPECT_GT(error_at(0.5), 100);
    std::swap(sides_, fresh);
  }
  // The best fixed factor is 1/(1 + m_a/(2 m)).
  for (const auto& coupling : {implicit(AccelerationKind::fixed, 1 / 3.0), implicit(AccelerationKind::aitken),
                               implicit(AccelerationKind::quasi_newton)}) {
    const AnalyticSides fresh = sides_;
    auto figures = run(1.5, coupling);
    EXPECT_LT(error_at(1.5), 0.05);
    EXPECT_EQ(figures["unconverged_windows"], 0);
    EXPECT_LT(figures["iterations"], 4 * 150);
    sides_ = fresh;
  }
}

TEST_F(CoupledRunTest, SidesTakeTheirTurnsAsTheSchemeSays) {
  run(0.02, explicit_scheme(SchemeKind::serial_explicit));
  EXPECT_THAT(sides_.calls, ElementsAre("fluid 1", "solid 1", "fluid 2", "solid 2"));
  sides_ = {};
  run(0.02, explicit_scheme(SchemeKind::parallel_explicit));
  EXPECT_THAT(sides_.calls, ElementsAre("solid 1", "fluid 1", "solid 2", "fluid 2"));
}

TEST_F(CoupledRunTest, ParallelSchemePassesOnTheImpulseOfTheWindowBefore) {
  sides_.added_mass = 0;
  std::vector<double> impulses;
  sides_.before_answer = [&](const std::string& side, const Window& window) {
    if (side == "solid") impulses.push_back(sides_.force_on_solid * window.dt);
    sides_.time_step_limit = 2.0 / 64;  // of the windows to come
  };
  sides_.time_step_limit = 1.0 / 64;
  run(5.0 / 64, explicit_scheme(SchemeKind::parallel_explicit));
  EXPECT_THAT(column("dt[s]"), ElementsAre(1.0 / 64, 2.0 / 64, 2.0 / 64));
  EXPECT_THAT(impulses, ElementsAre(0, sides_.push / 64, sides_.push * 2 / 64));
}

TEST_F(CoupledRunTest, IterationsAreRepeatedWindowsOfTheSameNumber) {
  std::vector<std::uint32_t> iterations;
  sides_.before_answer = [&](const std::string& side, const Window& window) {
    if (side == "fluid") iterations.push_back(window.iteration);
  };
  auto figures = run(0.01, implicit(AccelerationKind::fixed));
  ASSERT_GT(iterations.size(), 2u);
  for (std::size_t k = 0; k < iterations.size(); ++k) EXPECT_EQ(iterations[k], k);
  EXPECT_EQ(figures["iterations"], static_cast<double>(iterations.size()));
  EXPECT_LE(column("residual[1]").back(), 1e-6);
}

TEST_F(CoupledRunTest, OnlyTheLoadsOfTheCaseArePassedOn) {
  Parameters coupling;
  coupling.loads = {"friction"};
  auto figures = run(0.1, coupling);
  EXPECT_EQ(sides_.solid.x, 0) << "the sides have no friction";
  EXPECT_LT(figures["largest_impulse_error"], 1e-15);
}

TEST_F(CoupledRunTest, RowsComeAtTheirIntervalAndWindowsFillTheTime) {
  settings_.series_interval = 0.05;
  Parameters coupling;
  coupling.fluid_steps_per_window = 2;
  auto figures = run(0.15, coupling);
  EXPECT_THAT(column("time[s]"),
              ElementsAre(testing::DoubleNear(0.06, 1e-12), testing::DoubleNear(0.1, 1e-12),
                          0.15));  // the end itself, to the last bit
  EXPECT_THAT(column("window[1]"), ElementsAre(3, 5, 8));
  EXPECT_THAT(column("dt[s]"), ElementsAre(0.02, 0.02, testing::DoubleNear(0.015, 1e-12)));  // two alike
  EXPECT_THAT(column("fluid_compute[s]"), testing::Each(testing::DoubleNear(1e-3, 1e-12)));  // means
  EXPECT_DOUBLE_EQ(figures["fluid_compute_total"], 8e-3);
}

TEST_F(CoupledRunTest, FramesOfTheInterfaceComeAtTheirInterval) {
  settings_.frame_interval = 0.02;
  settings_.series_interval = 1;
  run(0.04, {});
  EXPECT_TRUE(std::filesystem::exists(folder_.path / "interface.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path / "coupler.csv")) << "no row was due";
}

TEST_F(CoupledRunTest, ImpulseThatIsLostIsReportedOnce) {
  sides_.impulse_lost = 1e-3;
  run(0.05, {});
  EXPECT_THAT(said_, HasSubstr("window 1: impulse given and taken differ by 0.001 of"));
  EXPECT_THAT(said_, Not(HasSubstr("window 2: impulse")));
  EXPECT_THAT(column("impulse_error[1]"), testing::Each(testing::DoubleNear(1e-3, 1e-12)));
}

TEST_F(CoupledRunTest, WorkIsThatOfBothSides) {
  const auto figures = run(0.5, implicit(AccelerationKind::aitken));
  const double energy = 0.5 * sides_.mass * sides_.solid.v * sides_.solid.v +
                        0.5 * sides_.stiffness * sides_.solid.x * sides_.solid.x;
  EXPECT_NEAR(figures.at("work_taken"), energy, 0.02 * energy);
  EXPECT_NEAR(figures.at("work_given"), energy, 0.02 * energy);
}

TEST_F(CoupledRunTest, AnExchangeThatFeedsTheSolidIsReported) {
  sides_.added_mass = 2.1;  // a little more than the scheme bears
  run(1.5, explicit_scheme(SchemeKind::serial_explicit));
  EXPECT_THAT(said_, HasSubstr("the exchange feeds the solid"));
  sides_ = {};
  run(1.5, explicit_scheme(SchemeKind::serial_explicit));
  EXPECT_THAT(said_, Not(HasSubstr("the exchange feeds the solid")));
}

TEST_F(CoupledRunTest, AnExchangeThatMakesMoreThanTheFluidGivesEndsTheRun) {
  sides_.added_mass = 2.1;
  const Parameters coupling = explicit_scheme(SchemeKind::serial_explicit);
  largest_false_work_ = coupling.largest_false_work;
  EXPECT_THAT([&] { run(1.5, coupling); }, ThrowsMessage<PhysicsFailure>(HasSubstr("'largest_false_work'")));
  EXPECT_THAT(said_, HasSubstr("the exchange feeds the solid")) << "it was warned of before";
}

TEST_F(CoupledRunTest, TheLastWindowIsThereWhateverTheIntervalAndTheEnd) {
  settings_.frame_interval = settings_.series_interval = 0.05;
  settings_.end_time = 1;
  sides_.before_answer = [](const std::string& side, const Window& window) {
    if (side == "solid" && window.number == 9) throw PhysicsFailure("solid: it broke");
  };
  CoupledRun coupled(settings_, sides_);
  EXPECT_THROW(coupled.run(sides_.start()), PhysicsFailure);
  coupled.write_last();
  coupled.complete();
  EXPECT_THAT(column("window[1]"), ElementsAre(5, 8)) << "the one that was due, and the last, once";
}

TEST_F(CoupledRunTest, TimeThatStandsStillEndsTheRun) {
  sides_.time_step_limit = 1e-30;
  EXPECT_THAT([&] { run(1, {}); }, ThrowsMessage<PhysicsFailure>(HasSubstr("time stands still")));
}

TEST_F(CoupledRunTest, WindowsThatDoNotSettleEndTheRun) {
  sides_.added_mass = 30;
  Parameters coupling = implicit(AccelerationKind::fixed, 0.1);
  coupling.implicit->largest_iteration_count = 3;
  EXPECT_THAT(
      [&] { run(1, coupling); },
      ThrowsMessage<PhysicsFailure>(HasSubstr("5 windows in a row have not converged in 3 iterations")));
  EXPECT_THAT(said_, HasSubstr("window 1: not converged after 3 iterations"));
}

TEST_F(CoupledRunTest, AFailingSideEndsTheRunAndLeavesWhatWasWritten) {
  sides_.before_answer = [](const std::string& side, const Window& window) {
    if (side == "solid" && window.number == 4) throw PhysicsFailure("solid: it broke");
  };
  EXPECT_THAT([&] { run(1, {}); }, ThrowsMessage<PhysicsFailure>("solid: it broke"));
  EXPECT_THAT(column("window[1]"), ElementsAre(1, 2, 3));
}

TEST(WindowLength, FillsTheTimeLeftWithoutASplinter) {
  EXPECT_EQ(window_length(10, 1, 1), 1);
  EXPECT_EQ(window_length(10, 4, 1), 4);
  EXPECT_EQ(window_length(5, 4, 1), 2.5);  // 2.5 and 2.5 rather than 4 and 1
  EXPECT_EQ(window_length(2.5, 4, 1), 2.5);
}

}  // namespace
}  // namespace toryu::coupling
