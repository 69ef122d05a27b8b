/// Creeping flow at a density of another medium: what is chosen, what stands against it, and what it spares.
#include "fluid_solver/similarity.hpp"

#include <gmock/gmock.h>

#include "common/case/case_file.hpp"
#include "fluid_solver/stability_warnings.hpp"
#include "fluid_solver/weakly_compressible/weakly_compressible.hpp"
#include "tests/unit/fluid_solver/scenes.hpp"
#include "tests/validation/developed_flow.hpp"

namespace toryu::fluid {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;

constexpr double U = 0.05, w = 0.002;

Parameters putty() {
  Parameters p;
  p.density = 1200;
  p.spacing = 1e-4;
  p.regions = {{"medium", {Vec(0, 0), Vec(0.016, w)}, Vec::Zero()}};
  p.laminar_viscosity = LaminarViscosity{1000};
  p.similarity =
      Similarity{.mean_speed = U, .passage_width = w, .passage_length = 0.016, .reynolds_number = 0.5};
  p.kernel = KernelForm::wendland_c2;
  p.smoothing_ratio = 2.0;
  return p;
}

Scene pushed(double ramp) {
  Scene scene;
  scene.walls = {{"piston", {Vec(-0.001, 0), Vec(0, w)}, Motion{{{0, 0, 0}, {ramp, U, 0}}}}};
  return scene;
}

TEST(PassageFlow, IsThatOfTheExactSolutions) {
  Parameters p = putty();
  EXPECT_NEAR(passage_flow(p, U, w).wall_shear_rate, 6 * U / w, 1e-4);
  p.laminar_viscosity.reset();
  p.power_law = PowerLaw{25780, 0.4, 1e-3, 1e9};
  const PassageFlow thinning = passage_flow(p, U, w);  // (2n+1)/n 2U/w = 225 1/s
  EXPECT_NEAR(thinning.wall_shear_rate, 225, 0.01);
  EXPECT_NEAR(thinning.wall_stress, 25780 * std::pow(225, 0.4), 10);
  p.power_law.reset();
  p.carreau = Carreau{1000, 10, 0.05, 0.4};
  const auto eta = [&](double gdot) { return viscosity_of(p, gdot); };
  EXPECT_NEAR(passage_flow(p, U, w).wall_stress / DevelopedFlow(eta, w, U).wall_stress(), 1, 1e-4);
  p.carreau.reset();
  p.herschel_bulkley = HerschelBulkley{{1000, 1, 1, 1e6}, 50e3, 1};
  EXPECT_NEAR(passage_flow(p, U, w).wall_stress / DevelopedFlow(eta, w, U).wall_stress(), 1, 1e-3);
  // Bingham: U = w tau_w/(6 eta) (1 - 3/2 phi + phi^3/2), phi = tau_y/tau_w
  const double tau_w = passage_flow(p, U, w).wall_stress, phi = 50e3 / tau_w;
  EXPECT_NEAR(w * tau_w / 6000 * (1 - 1.5 * phi + 0.5 * phi * phi * phi), U, 0.01 * U);
}

TEST(PassageFlow, HasTheSpeedThatItsStressDrives) {
  Parameters p = putty();
  p.wall_slip = SlipLaw{.coefficient = 3e-7};
  for (const Geometry geometry : {Geometry::plane, Geometry::axisymmetric})
    EXPECT_NEAR(mean_speed(p, passage_flow(p, U, w, geometry).wall_stress, w, geometry) / U, 1, 1e-9);
}

TEST(PassageFlow, SlidesByTheLaw) {
  Parameters p = putty();
  p.wall_slip = SlipLaw{3e-7};  // 0.05 = G (b w/2 + w^2/(12 mu)), tau_w = G w/2
  const PassageFlow flow = passage_flow(p, U, w);
  const double tau_w = 0.05 / (3e-10 + 4e-6 / 12e3) * 1e-3;
  EXPECT_NEAR(flow.wall_stress / tau_w, 1, 1e-6);
  EXPECT_NEAR(flow.slip_speed / (3e-7 * tau_w), 1, 1e-6);
  EXPECT_NEAR(similar_medium(p).density / (0.5 * 1000 / (U * w) * (1 - 3e-7 * tau_w / U)), 1, 1e-6);
}

TEST(PassageFlow, IsThatOfATubeAboutAnAxis) {
  Parameters p = putty();
  EXPECT_NEAR(passage_flow(p, U, w, Geometry::axisymmetric).wall_shear_rate, 8 * U / w, 1e-4);
  const SimilarMedium similar = similar_medium(p, Geometry::axisymmetric);
  EXPECT_NEAR(similar.pressure_drop, 32 * 1000 * U / (w * w) * 0.016, 20);
  p.laminar_viscosity.reset();
  p.power_law = PowerLaw{29080, 0.4, 1e-3, 1e9};  // (3n+1)/(4n) 8U/w = 275 1/s
  EXPECT_NEAR(passage_flow(p, U, w, Geometry::axisymmetric).wall_shear_rate, 275, 0.01);
}

TEST(Similarity, ChoosesDensityAndSoundSpeedByHand) {
  const SimilarMedium similar = similar_medium(putty());
  EXPECT_NEAR(similar.passage.wall_stress, 150e3, 1);                     // 6 eta U/w
  EXPECT_NEAR(similar.pressure_drop, 2.4e6, 20);                          // 2 tau_w L/w
  EXPECT_NEAR(similar.density, 0.5 * 1000 / (U * w), 1);                  // Re eta/(U w)
  EXPECT_NEAR(similar.sound_speed, std::sqrt(2.4e6 / 0.01 / 5e6), 1e-4);  // sqrt(dp/(share rho))
  EXPECT_NEAR(similar.real_reynolds_number, 1.2e-4, 1e-9);
  Parameters own = putty();
  own.sound_speed = 30;
  EXPECT_EQ(similar_medium(own).sound_speed, 30);
}

TEST(Similarity, KeepsWeightAndWhatTheCaseSays) {
  Parameters p = putty();
  p.friction = Friction{.coefficient = 0.05};
  Scene scene = pushed(1);
  scene.gravity = Vec(0, -9.81);
  make_similar(p, scene);
  EXPECT_NEAR(p.density * scene.gravity[1], -1200 * 9.81, 1e-6);
  EXPECT_NEAR(p.background_pressure->pressure, 0.65 * 2.4e6, 20);
  EXPECT_DOUBLE_EQ(p.friction->regularisation_speed, 0.05 * U);
  Parameters said = putty();
  said.background_pressure = BackgroundPressure{7};
  said.friction = Friction{.coefficient = 0.05, .regularisation_speed = 3};
  make_similar(said, scene);
  EXPECT_EQ(said.background_pressure->pressure, 7);
  EXPECT_EQ(said.friction->regularisation_speed, 3);
}

Parameters read_slit(const std::vector<std::string>& overrides) {
  CaseFile file(std::string(CASES "/abrasive_slit"), overrides);
  const Scene scene = read_scene(file);
  Parameters p;
  file.read("fluid", p, "");
  file.throw_if_faulty();
  return p;
}

TEST(Similarity, TakesADiscretisationOfItsOwnUnlessTheCaseSaysAnother) {
  const Parameters chosen = read_slit({});
  EXPECT_EQ(chosen.kernel, KernelForm::wendland_c2);
  EXPECT_EQ(chosen.smoothing_ratio, 2);
  EXPECT_EQ(chosen.time_step_share, 4.5);
  const Parameters said = read_slit({"fluid.time_step_share=1.5", "fluid.kernel=\"cubic_spline\""});
  EXPECT_EQ(said.time_step_share, 1.5);
  EXPECT_EQ(said.kernel, KernelForm::cubic_spline);
}

TEST(Similarity, ChoosesNoShareThatItsIntegratorDoesNotBear) {
  const Parameters p = read_slit({"fluid.integrator=\"midpoint\""});
  EXPECT_EQ(p.time_step_share, 1);
  EXPECT_THAT(stability_warnings(p, {}), IsEmpty());
  EXPECT_THAT(
      stability_warnings(read_slit({"fluid.integrator=\"midpoint\"", "fluid.time_step_share=4.5"}), {}),
      ElementsAre(HasSubstr("time_step_share 4.5 is beyond")));
}

std::string fault_of(const Parameters& p, bool with_solid = false) {
  const auto faults = similarity_faults(p, Geometry::plane, with_solid);
  return faults.empty() ? "" : faults.front().key + ": " + faults.front().message;
}

TEST(Similarity, IsRefusedWhereInertiaCounts) {
  EXPECT_EQ(fault_of(putty()), "");
  EXPECT_THAT(fault_of(putty(), true), HasSubstr("fluid.similarity: an elastic solid"));
  Parameters p = putty();
  p.laminar_viscosity->dynamic_viscosity = 0.1;
  EXPECT_THAT(fault_of(p), HasSubstr("own Reynolds number 1.2 exceeds"));
  p.laminar_viscosity.reset();
  EXPECT_THAT(fault_of(p), HasSubstr("needs a viscosity"));
  p = putty();
  p.artificial_viscosity = ArtificialViscosity{};
  EXPECT_THAT(fault_of(p), HasSubstr("fluid.artificial_viscosity: "));
  p = putty();
  p.surface_tension = SurfaceTension{};
  EXPECT_THAT(fault_of(p), HasSubstr("fluid.surface_tension: "));
  p = putty();
  p.central_force = CentralForce{.rate = 10};
  EXPECT_THAT(fault_of(p), HasSubstr("fluid.central_force: "));
  p = putty();
  p.regions.front().velocity = Vec(U, 0);
  EXPECT_THAT(fault_of(p), HasSubstr("fluid.region: "));
  p = putty();
  p.similarity->passage_length = 1e306;
  EXPECT_THAT(fault_of(p), HasSubstr("a pressure drop of inf Pa"));
}

TEST(Similarity, WarnsOfPistonsThatStartSoonerThanSound) {
  Parameters p = putty();
  Scene gentle = pushed(0.01), hasty = pushed(0.005);
  make_similar(p, gentle);  // sound crosses 16 mm in 2.3 ms at 6.9 m/s
  EXPECT_THAT(similarity_warnings(p, gentle), IsEmpty());
  EXPECT_THAT(similarity_warnings(p, hasty), ElementsAre(HasSubstr("within 0.005 s")));
  EXPECT_THAT(similarity_warnings(p, pushed(0)), ElementsAre(HasSubstr("within 0 s")));
}

TEST(Similarity, WarnsOfAKernelWhoseRowsStickUnderThePressure) {
  Parameters p = putty();
  Scene scene = pushed(0.01);
  p.background_pressure = BackgroundPressure{6e6};  // 40 tau_w
  make_similar(p, scene);
  EXPECT_THAT(similarity_warnings(p, scene), IsEmpty());
  p.smoothing_ratio = 1.5;
  EXPECT_THAT(similarity_warnings(p, scene), ElementsAre(HasSubstr("48 times the wall's shear stress")));
  p.background_pressure = BackgroundPressure{1e6};
  EXPECT_THAT(similarity_warnings(p, scene), IsEmpty());
}

TEST(Similarity, WarnsOfRingsThatAPassageDrawsTooFarApart) {
  Parameters p = putty();  // of the radius w
  p.similarity->passage_width = w / 1.5;
  Scene scene = pushed(0.02);
  EXPECT_FALSE(beyond_thinnest_rings(p, scene)) << "in the plane nothing is drawn apart";
  scene.geometry = Geometry::axisymmetric;  // 2 w to w/1.5: sqrt(3) = 1.73
  EXPECT_THAT(beyond_thinnest_rings(p, scene), Optional(HasSubstr("has h/d0 1.2 there")));
  EXPECT_THAT(beyond_thinnest_rings(p, scene), Optional(HasSubstr("take smoothing_ratio = 3,")));
  p.smoothing_ratio = 3;
  EXPECT_FALSE(beyond_thinnest_rings(p, scene));
  p.smoothing_ratio = 2;
  p.similarity->passage_width = 2 * w;  // a tube
  EXPECT_FALSE(beyond_thinnest_rings(p, scene));
}

/// The step over 0.125 h^2 rho/eta, of a medium in which sound is slow.
double viscous_share(WallExtrapolation extrapolation) {
  Parameters p = putty();
  p.similarity.reset();
  p.density = 5e6;
  p.sound_speed = 0.01;
  p.time_step_share = 4.5;
  p.wall_model.extrapolation = extrapolation;
  p.limits.largest_density_change = 1;
  return WeaklyCompressible(p, pushed(1)).time_step_limit() / (0.125 * p.h() * p.h() * p.density / 1000);
}

TEST(Similarity, TakesShorterStepsWhereWallsAreFitted) {
  EXPECT_NEAR(viscous_share(WallExtrapolation::mean), 2, 0.02);
  EXPECT_NEAR(viscous_share(WallExtrapolation::fit), 1.2, 0.02);  // 1.37 is stable at 40 across, 1.44 not
}

TEST(Similarity, WarnsOfNumbersThatDoNotGoTogether) {
  Parameters p = putty();
  Scene scene = pushed(1);
  p.similarity->mean_speed = 0.01 * U;  // millimetres for metres, or so
  make_similar(p, scene);
  EXPECT_THAT(similarity_warnings(p, scene), ElementsAre(HasSubstr("walls move at 0.05 m/s, faster than")));
  p = putty();
  p.sound_speed = 0.3;
  make_similar(p, scene);
  EXPECT_THAT(similarity_warnings(p, scene), ElementsAre(HasSubstr("is 0.17 of the sound speed")));
}

TEST(Similarity, IsOfferedWhereTheFlowCreeps) {
  Parameters p = putty();
  EXPECT_FALSE(creeping(p, pushed(1)));
  p.similarity.reset();
  EXPECT_THAT(creeping(p, pushed(1)), Optional(HasSubstr("creeps, Re 0.00012")));
  EXPECT_FALSE(creeping(p, Scene{})) << "nothing moves";
  Scene heavy = pushed(1);
  heavy.gravity = Vec(0, -9.81);
  EXPECT_FALSE(creeping(p, heavy));
  Scene swinging = pushed(1e-7);  // faster than the profile follows
  EXPECT_FALSE(creeping(p, swinging));
  p.laminar_viscosity->dynamic_viscosity = 1;  // Re 0.12
  EXPECT_FALSE(creeping(p, pushed(1)));
}

/// A block that shears in empty space, far below the acoustic limit.
Setting sheared(Integrator integrator) {
  Setting s = empty_space();
  s.parameters.artificial_viscosity.reset();
  s.parameters.laminar_viscosity = LaminarViscosity{1e6};
  s.parameters.integrator = integrator;
  s.parameters.time_step_share = 10;
  s.parameters.regions = {{"block", {Vec(0, 0), Vec(1, 1)}, Vec::Zero()}};
  s.parameters.start_disorder = 0.2;
  s.parameters.initial_flow =
      InitialFlow{.profile = FlowProfile::strain, .speed = 0.01, .length = 0.5, .centre = Vec(0.5, 0.5)};
  return s;
}

TEST(ViscousSteps, AreStableWhateverTheShare) {
  for (const auto integrator : {Integrator::symplectic, Integrator::midpoint})
    for (const auto kernel : {KernelForm::cubic_spline, KernelForm::wendland_c2})
      for (const double ratio : {1.25, 2.0}) {
        Setting s = sheared(integrator);
        s.parameters.kernel = kernel;
        s.parameters.smoothing_ratio = ratio;
        auto solver = s.solver();
        EXPECT_EQ(solver.time_step_rule(), "viscous");
        const double before = solver.kinetic_energy();
        for (int n = 0; n < 40; ++n) solver.advance(solver.time_step_limit());
        EXPECT_LT(solver.kinetic_energy(), before);
        solver.check(solver.time());
      }
}

// (omega dt)^2/4 + lambda dt/2 = 0.9 where the limits are 6.7 and 2.4 times below the edges of either alone.
TEST(DampedSound, LimitsStepsNearBothEdges) {
  Setting s = sheared(Integrator::symplectic);
  s.parameters.time_step_share = 5;
  const double h = s.parameters.h(), acoustic = 0.25 * h / (s.parameters.sound_speed + 0.01);
  s.parameters.laminar_viscosity = LaminarViscosity{s.parameters.density * 0.125 * h * h / (3 * acoustic)};
  auto solver = s.solver();
  EXPECT_EQ(solver.time_step_rule(), "acoustic and viscous");
  const double dt = solver.time_step_limit(), sound = dt / (6.7 * acoustic);
  EXPECT_NEAR(sound * sound + dt / (2.4 * 3 * acoustic), 0.9, 2e-3);
}

TEST(EnclosedMedium, StandsAtTheMeanPressureThatIsAsked) {
  Setting s = colliding_drops();
  s.parameters.enclosed_medium = EnclosedMedium{3e6};
  s.parameters.observers = {{.name = "inside",
                             .quantity = Quantity::pressure,
                             .point = Vec(0.5, 0.25),
                             .box = {},
                             .axis = Axis::y}};
  Setting free = s;
  free.parameters.enclosed_medium.reset();
  auto held = s.solver(), floating = free.solver();
  run_until(held, 0.02), run_until(floating, 0.02);
  EXPECT_EQ(positions(held), positions(floating)) << "the motion must not depend on it";
  const auto field = [](const auto& solver, const std::string& name) {
    for (const auto& of : solver.frame().fields)
      if (of.name == name) return of.values;
    return std::vector<double>{};
  };
  const auto p = field(held, "pressure"), p_free = field(floating, "pressure");
  double volume = 0, sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double V = held.particles().m[i] / held.particles().rho[i];
    volume += V, sum += V * p[i];
    EXPECT_NEAR(p[i] - p_free[i], held.pressure_offset(), 1e-6);
  }
  EXPECT_NEAR(sum / volume, 3e6, 1e-5);
  const auto seen = [](const auto& solver) { return solver.observe().back().value; };
  EXPECT_NEAR(seen(held) - seen(floating), held.pressure_offset(), 1e-6);
}

}  // namespace
}  // namespace toryu::fluid
