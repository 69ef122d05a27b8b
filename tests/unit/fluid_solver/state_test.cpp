// A fluid that is put back, or read from a checkpoint, goes on bit by bit: over integrators, terms,
// boundaries.
#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>

#include "tests/unit/fluid_solver/plate.hpp"

namespace toryu::fluid {
namespace {

struct Variant {
  std::string name;
  void (*change)(Setting&);
  bool with_plate = false, with_impulse = false;
  bool symplectic_alone = false;  ///< no midpoint steps, or no steps of an integrator's
};

/// A fluid of this variant in its own folder, beside its plate if it has one.
class Tank {
 public:
  Tank(const Variant& variant, Integrator integrator)
      : with_plate_(variant.with_plate), with_impulse_(variant.with_impulse) {
    Setting setting = variant.with_plate ? tank_with_a_plate() : collapsing_column();
    setting.parameters.integrator = integrator;
    setting.parameters.neighbour_skin = 0.02;  // so that lists are built often
    variant.change(setting);
    solver_ = make_model(setting.parameters, setting.scene);
    if (with_plate_) solver_->attach(plate_);
    std::filesystem::create_directories(out_);
    solver_->record_surface(out_);
  }
  ~Tank() {
    solver_.reset();
    std::filesystem::remove_all(out_);
  }

  FluidModel& solver() { return *solver_; }

  /// All numbers that `steps` windows of a step each bring about.
  std::vector<double> after(int steps) {
    std::vector<double> numbers;
    for (int n = 0; n < steps; ++n) {
      const double dt = solver_->time_step_limit();
      if (with_plate_) begin_window(dt);
      solver_->advance(dt);
      numbers.push_back(dt);
      if (with_plate_) add(numbers, solver_->take_load());
      for (const auto& told : solver_->observe()) numbers.push_back(told.value);
    }
    const Frame frame = solver_->frame();
    numbers.insert(numbers.end(), frame.positions.begin(), frame.positions.end());
    for (const auto& field : frame.fields)
      numbers.insert(numbers.end(), field.values.begin(), field.values.end());
    for (const auto& wall : solver_->boundaries())
      for (const auto& component : wall.x) numbers.insert(numbers.end(), component.begin(), component.end());
    return numbers;
  }

 private:
  static void add(std::vector<double>& numbers, const InterfaceLoad& load) {
    for (const auto* values : {&load.pressure, &load.force, &load.friction_force})
      numbers.insert(numbers.end(), values->begin(), values->end());
    numbers.insert(numbers.end(), load.impulse_on_fluid.begin(), load.impulse_on_fluid.end());
  }

  static int runs_;
  void begin_window(double dt) {
    InterfaceMotion motion = moved(plate_, Vec(0.2, 0.1), solver_->time());
    if (with_impulse_) motion.impulse.assign(motion.velocity.size(), 1e-3);
    solver_->begin_window(motion, dt);
  }

  bool with_plate_, with_impulse_;
  Interface plate_ = plate();
  std::filesystem::path out_ = std::filesystem::path(testing::TempDir()) /
                               ("fluid_state_" + std::to_string(getpid()) + "_" + std::to_string(runs_++));
  std::unique_ptr<FluidModel> solver_;
};
int Tank::runs_ = 0;

class TankState : public testing::TestWithParam<std::tuple<Variant, Integrator>> {
 protected:
  TankState() { omp_set_num_threads(1); }
  Variant variant = std::get<0>(GetParam());
  Integrator integrator = std::get<1>(GetParam());
};

TEST_P(TankState, ThatIsPutBackGoesOnBitByBit) {
  Tank run(variant, integrator);
  run.after(7);
  run.solver().save();
  const long builds = run.solver().list_builds();
  const auto first = run.after(25);
  EXPECT_GT(run.solver().list_builds(), builds) << "lists that were built within the window are put back too";
  for (int repeat = 0; repeat < 2; ++repeat) {
    run.solver().restore();
    EXPECT_EQ(run.after(25), first);
  }
}

TEST_P(TankState, ThatWasWrittenGoesOnBitByBit) {
  Tank run(variant, integrator), other(variant, integrator);
  run.after(17);
  std::stringstream stream;
  run.solver().write_state(stream);
  other.solver().read_state(stream);
  for (const int steps : {1, 6, 25}) EXPECT_EQ(other.after(steps), run.after(steps)) << steps;
  EXPECT_GT(run.solver().list_builds(), 2);
}

TEST_P(TankState, IsSmall) {
  Tank run(variant, integrator);
  run.after(3);
  std::stringstream stream;
  run.solver().write_state(stream);
  std::size_t particles = run.solver().particle_count();
  for (const auto& wall : run.solver().boundaries()) particles += wall.count;
  EXPECT_LT(stream.str().size(), 150 * particles);
}

const Variant variants[] = {
    {"Plain", [](Setting& s) { s.parameters.density_diffusion->gradient = DiffusionGradient::none; }},
    {"Renormalised", [](Setting&) {}},
    {"Laminar", [](Setting& s) { s.parameters.laminar_viscosity = LaminarViscosity{2}; }},
    {"PowerLaw",
     [](Setting& s) {
       s.parameters.power_law = PowerLaw{5, 0.5, 0.1, 20};
     }},
    {"Carreau",
     [](Setting& s) {
       s.parameters.carreau = Carreau{5, 0.1, 0.1, 0.5};
     }},
    {"Press",
     [](Setting& s) {
       s.scene.walls[1].press =
           Press{.pressure = {{0, 0}, {0.05, 1e5}}, .force = {}, .travel = Vec(-0.1, 0.1)};
     },
     false, false, true},
    {"HerschelBulkley",
     [](Setting& s) {
       s.parameters.herschel_bulkley = HerschelBulkley{{5, 0.5, 0.1, 20}, 10, 0.5};
     }},
    {"ViscoelasticShifting",
     [](Setting& s) {
       s.parameters.laminar_viscosity = LaminarViscosity{2};
       s.parameters.viscoelasticity = Viscoelasticity{{{0.05, 5, 0.1}}};
       s.parameters.particle_shifting = ParticleShifting{};
     }},
    {"Viscoelastic",
     [](Setting& s) {
       s.parameters.laminar_viscosity = LaminarViscosity{2};
       s.parameters.viscoelasticity = Viscoelasticity{{{0.05, 5, 0.1}, {0.5, 20, 0}}};
     }},
    {"Wendland", [](Setting& s) { s.parameters.kernel = KernelForm::wendland_c2; }},
    {"WallDensity", [](Setting& s) { s.parameters.wall_model.density = WallDensity::from_pressure; }},
    {"FittedWalls",
     [](Setting& s) {
       s.parameters.wall_model.extrapolation = WallExtrapolation::fit;
       s.parameters.carreau = Carreau{5, 0.1, 0.1, 0.5};
       s.scene.walls[1].motion = Motion{{{0, 0, 0}, {0.1, 1, 0}}};
     }},
    {"NoSuction", [](Setting& s) { s.parameters.wall_model.suction = false; }},
    {"Repulsion", [](Setting& s) { s.parameters.wall_repulsion = WallRepulsion{}; }},
    {"Shifting", [](Setting& s) { s.parameters.particle_shifting = ParticleShifting{}; }},
    {"ShiftingConsistent",
     [](Setting& s) {
       s.parameters.particle_shifting = ParticleShifting{};
       s.parameters.consistent_gradients = ConsistentGradients{};
     }},
    {"SurfaceTension", [](Setting& s) { s.parameters.surface_tension = SurfaceTension{5}; }},
    {"TensileControl", [](Setting& s) { s.parameters.tensile_control = TensileControl{}; }},
    {"Piston",
     [](Setting& s) {
       s.scene.walls[1].motion = Motion{{{0, 0, 0}, {0.1, 1, 0}}};
     }},
    {"Turning",
     [](Setting& s) {
       s.parameters.wall_model.extrapolation = WallExtrapolation::fit;
       s.parameters.laminar_viscosity = LaminarViscosity{2};
       s.parameters.friction = Friction{0.3, FrictionForm::normalised, 0.5};
       s.parameters.removal = Removal{1e-9, {}, {}};
       s.scene.walls[1].work_piece = true;
       s.scene.walls[1].motion =
           Motion{.velocity = {{0, 0.1, 0}},
                  .rotation = Rotation{Vec(0, 0.4), {.sine = {{{.amplitude = -0.3, .frequency = 3}}}}}};
     }},
    {"GravityChange",
     [](Setting& s) {
       s.parameters.laminar_viscosity = LaminarViscosity{2};
       s.parameters.viscoelasticity = Viscoelasticity{{{0.05, 5, 0.1}}};
       s.scene.gravity_change =
           GravityChange{.acceleration = {{0, 0, 0}, {0.1, 9, 3}},
                         .turning = Turning{.sine = {{{.amplitude = 0.3, .frequency = 3}}}}};
     }},
    {"Periodic",
     [](Setting& s) {
       s.scene.domain = {Vec(0, -0.15), Vec(1, 2)};
       s.scene.periodic = Periodic::x;
       s.scene.walls = {{"floor", {Vec(0, -0.15), Vec(1, 0)}, Motion{{{0.0, 2.0, 0.0}}}}};
     }},
    {"Removal",
     [](Setting& s) {
       s.scene.walls[0].work_piece = true;
       s.parameters.friction = Friction{0.3, FrictionForm::normalised, 0.5};
       s.parameters.removal = Removal{1e-9, {}, {}};
     }},
    {"Implicit",
     [](Setting& s) {
       s.parameters.model = Model::implicit;
       s.parameters.density_diffusion.reset();
       s.parameters.artificial_viscosity.reset();
       s.parameters.carreau = Carreau{500, 10, 0.1, 0.5};
       s.parameters.particle_shifting = ParticleShifting{};
     },
     false, false, true},
    {"OpenEnds",
     [](Setting& s) {
       open_channel(s, 0, 1, 0.5);
       s.parameters.regions[0].velocity = Vec(1, 0);
       s.parameters.particle_shifting = ParticleShifting{};
       s.parameters.carreau = Carreau{5, 0.1, 0.1, 0.5};
     }},
    {"PlateBetweenOpenEnds",
     [](Setting& s) {
       open_channel(s, -0.75, 1.4, 0.8);
       s.parameters.regions[0].velocity = Vec(1, 0);
       s.parameters.holes = {{Box{Vec(0.5, 0), Vec(0.65, 0.6)}, "plate", {}}};
     },
     true},
    {"Plate", [](Setting&) {}, true},
    {"PlateWithImpulse", [](Setting&) {}, true, true},
    {"ConsistentPlateWithImpulse",
     [](Setting& s) { s.parameters.consistent_gradients = ConsistentGradients{}; }, true, true},
    {"RubbedPlate",
     [](Setting& s) {
       s.parameters.friction = Friction{0.3, FrictionForm::normalised, 0.5};
       s.parameters.removal = Removal{1e-9, {}, {}};
     },
     true},
};

std::vector<std::tuple<Variant, Integrator>> variants_with_integrators() {
  std::vector<std::tuple<Variant, Integrator>> all;
  for (const Variant& variant : variants)
    for (const Integrator integrator : {Integrator::midpoint, Integrator::symplectic})
      if (integrator == Integrator::symplectic || !variant.symplectic_alone)
        all.emplace_back(variant, integrator);
  return all;
}

INSTANTIATE_TEST_SUITE_P(OfAFluid, TankState, testing::ValuesIn(variants_with_integrators()),
                         [](const auto& setting) {
                           return std::get<0>(setting.param).name +
                                  (std::get<1>(setting.param) == Integrator::midpoint ? "Midpoint"
                                                                                      : "Symplectic");
                         });

}  // namespace
}  // namespace toryu::fluid
