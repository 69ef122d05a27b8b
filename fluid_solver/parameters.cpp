#include "fluid_solver/parameters.hpp"

#include <cmath>
#include <set>

#include "common/sph/lanes.hpp"

namespace toryu::fluid {

namespace {

bool names_differ(const std::vector<Observer>& observers) {
  std::set<std::string> names;
  for (const auto& observer : observers) names.insert(observer.name);
  return names.size() == observers.size();
}

bool flow_is_there(const Parameters& p) {
  const bool known = p.initial_flow && p.initial_flow->profile == FlowProfile::taylor_green &&
                     p.laminar_viscosity.has_value();
  for (const auto& observer : p.observers)
    if ((observer.quantity == Quantity::flow_amplitude && !p.initial_flow) ||
        (observer.quantity == Quantity::flow_error && !known))
      return false;
  return true;
}

bool one_viscosity(const Parameters& p) {
  return p.laminar_viscosity.has_value() + p.power_law.has_value() + p.carreau.has_value() <= 1;
}

}  // namespace

double Parameters::strip_width() const {
  return std::sqrt(static_cast<double>(lane_count)) * spacing;
}

void describe(ParameterTable& table, Region& region) {
  table.text("name", region.name, {.required = true, .help = "name in the log"});
  table.group("box", region.box, "filled with fluid at the start");
  table.vector("velocity", region.velocity, {.unit = "m/s", .help = "velocity at the start"});
}

void describe(ParameterTable& table, InitialFlow& flow) {
  table.choice("profile", flow.profile, {"taylor_green", "rotation", "strain", "standing_wave"},
               {.required = true, .help = "added to the velocity of the regions, with its pressure"});
  table.number("speed", flow.speed, {.unit = "m/s", .required = true, .help = "the largest of a period"});
  table.number("length", flow.length,
               {.unit = "m",
                .minimum = 0,
                .above_minimum = true,
                .required = true,
                .help = "of a period; of rotation and strain the distance at which `speed` is reached"});
  table.number("depth", flow.depth,
               {.unit = "m", .minimum = 0, .help = "of the water under a standing wave"});
  table.vector("centre", flow.centre,
               {.unit = "m", .help = "of the flow; of a standing wave on the surface, where it moves most"});
  table.require(flow.profile != FlowProfile::standing_wave || flow.depth > 0, "depth",
                "a standing wave needs a 'depth' above 0");
}

void describe(ParameterTable& table, CentralForce& force) {
  table.number(
      "rate", force.rate,
      {.unit = "1/s", .minimum = 0, .required = true, .help = "acceleration is rate^2 times distance"});
  table.vector("centre", force.centre, {.unit = "m", .help = "towards which it pulls"});
}

void describe(ParameterTable& table, HydrostaticStart& start) {
  table.number("surface_level", start.surface_level,
               {.unit = "m", .required = true, .help = "height of the free surface, against gravity"});
}

void describe(ParameterTable& table, BackgroundPressure& background) {
  table.number("pressure", background.pressure,
               {.unit = "Pa",
                .minimum = 0,
                .required = true,
                .help = "of the medium at rest density; keeps a closed medium from tearing under suction"});
}

void describe(ParameterTable& table, DensityDiffusion& diffusion) {
  table.number(
      "delta", diffusion.delta,
      {.minimum = 0, .maximum = 1, .help = "coefficient of the diffusion; Marrone et al. 2011 take 0.1"});
  table.choice(
      "gradient", diffusion.gradient, {"renormalised", "none"},
      {.help =
           "linear part left alone: renormalised (Marrone et al. 2011) or none (Molteni & Colagrossi 2009)"});
}

void describe(ParameterTable& table, ParticleShifting& shifting) {
  table.number(
      "strength", shifting.strength,
      {.minimum = 0, .maximum = 10, .help = "A of the shift -A h u_max dt grad C; Sun et al. 2017 take 2"});
}

void describe(ParameterTable&, TensileControl&) {}

void describe(ParameterTable&, ConsistentGradients&) {}

void describe(ParameterTable& table, ArtificialViscosity& viscosity) {
  table.number("alpha", viscosity.alpha,
               {.minimum = 0,
                .maximum = 10,
                .help = "linear coefficient (Monaghan 1992); 0.02 in delta-SPH, 1 in Kato's thesis"});
  table.number("beta", viscosity.beta,
               {.minimum = 0, .maximum = 10, .help = "quadratic coefficient (Monaghan 1992)"});
}

void describe(ParameterTable& table, LaminarViscosity& viscosity) {
  table.number("dynamic_viscosity", viscosity.dynamic_viscosity,
               {.unit = "Pa.s", .minimum = 0, .required = true, .help = "mu (Morris, Fox & Zhu 1997)"});
}

void describe(ParameterTable& table, PowerLaw& law) {
  const auto bound = [&](const std::string& key, double& value, const std::string& help) {
    table.number(key, value,
                 {.unit = "Pa.s", .minimum = 0, .above_minimum = true, .required = true, .help = help});
  };
  table.number("consistency", law.consistency,
               {.unit = "Pa.s^n",
                .minimum = 0,
                .above_minimum = true,
                .required = true,
                .help = "m of eta = m gdot^(n-1)"});
  table.number(
      "exponent", law.exponent,
      {.minimum = 0, .maximum = 2, .above_minimum = true, .required = true, .help = "n; below 1 thins"});
  bound("smallest_viscosity", law.smallest_viscosity, "the medium is never thinner");
  bound("largest_viscosity", law.largest_viscosity, "never thicker, as at rest; limits the time step");
  table.require(law.smallest_viscosity <= law.largest_viscosity, "largest_viscosity",
                "'largest_viscosity' must be at least 'smallest_viscosity'");
}

void describe(ParameterTable& table, Carreau& law) {
  table.number(
      "zero_shear_viscosity", law.zero_shear_viscosity,
      {.unit = "Pa.s", .minimum = 0, .above_minimum = true, .required = true, .help = "eta_0, at rest"});
  table.number(
      "infinite_shear_viscosity", law.infinite_shear_viscosity,
      {.unit = "Pa.s", .minimum = 0, .required = true, .help = "eta_inf, under the strongest shear"});
  table.number("relaxation_time", law.relaxation_time,
               {.unit = "s",
                .minimum = 0,
                .required = true,
                .help = "lambda: shear rates above 1/lambda thin the medium"});
  table.number(
      "exponent", law.exponent,
      {.minimum = 0, .maximum = 2, .above_minimum = true, .required = true, .help = "n; below 1 thins"});
  table.require(
      law.infinite_shear_viscosity <= law.zero_shear_viscosity, "infinite_shear_viscosity",
      "'infinite_shear_viscosity' must not exceed 'zero_shear_viscosity'; what thickens under shear has "
      "an exponent above 1");
}

void describe(ParameterTable& table, Friction& friction) {
  table.number("coefficient", friction.coefficient,
               {.minimum = 0, .required = true, .help = "mu_A, traction over pressure (Kato's thesis)"});
  table.choice(
      "form", friction.form, {"normalised", "as_printed"},
      {.help = "normalised: a plane interface transmits mu_A p; as_printed: with d_f = d_0, which "
               "transmits only about 0.22 mu_A p at h = 1.2 d_0 (0.16 at 1.0, 0.25 at 1.3, 0.30 at 1.5)"});
  table.number("regularisation_speed", friction.regularisation_speed,
               {.unit = "m/s",
                .minimum = 0,
                .help = "below about this sliding speed friction is a linear drag; 0: c_0/1000"});
}

void describe(ParameterTable& table, WallRepulsion& repulsion) {
  table.number(
      "strength", repulsion.strength,
      {.minimum = 0, .maximum = 10, .help = "B, of the order of 1: the stiffness of the fluid itself"});
  table.number(
      "range", repulsion.range,
      {.minimum = 0.1, .maximum = 1.0, .help = "r_0/d_0 below which it is felt; a corner lies 0.71 away"});
}

void describe(ParameterTable& table, Archard& law) {
  table.number("wear_coefficient", law.wear_coefficient,
               {.minimum = 0, .required = true, .help = "K of dh/dt = (K/H) p v (Archard 1953)"});
  table.number(
      "hardness", law.hardness,
      {.unit = "Pa", .minimum = 0, .above_minimum = true, .required = true, .help = "H of the work piece"});
}

void describe(ParameterTable& table, Roughness& roughness) {
  table.number("initial", roughness.initial,
               {.unit = "m", .minimum = 0, .required = true, .help = "Ra at the start"});
  table.number("final", roughness.final,
               {.unit = "m", .minimum = 0, .required = true, .help = "Ra that the grain leaves in the end"});
  table.number("decay_depth", roughness.decay_depth,
               {.unit = "m",
                .minimum = 0,
                .above_minimum = true,
                .required = true,
                .help = "removed depth after which Ra - Ra_final has fallen to 1/e"});
}

void describe(ParameterTable& table, Removal& removal) {
  table.number("preston_coefficient", removal.preston_coefficient,
               {.unit = "1/Pa", .minimum = 0, .help = "k of dh/dt = k p v (Preston 1927); 0: not used"});
  table.optional("archard", removal.archard, "Archard's law beside or instead of Preston's");
  table.optional("roughness", removal.roughness, "decay of the roughness with the removed depth");
  table.require(removal.preston_coefficient > 0 || removal.archard, "preston_coefficient",
                "[fluid.removal] needs a preston_coefficient or [fluid.removal.archard]");
}

void describe(ParameterTable& table, WallModel& model) {
  table.choice("slip", model.slip, {"no_slip", "free_slip"},
               {.help = "whether viscous terms act at walls (Adami, Hu & Adams 2012)"});
  table.choice("density", model.density, {"rest", "from_pressure"},
               {.help = "density of wall particles: the rest density, or that of their pressure (Adami, Hu & "
                        "Adams 2012)"});
  table.flag("suction", model.suction,
             "whether walls hold a fluid whose pressure is negative; false where air can come between them");
}

void describe(ParameterTable& table, Limits& limits) {
  table.number(
      "largest_speed", limits.largest_speed,
      {.unit = "m/s", .minimum = 0, .help = "a faster particle stops the run; 0: the speed of sound"});
  table.number("largest_density_change", limits.largest_density_change,
               {.minimum = 0,
                .maximum = 1,
                .above_minimum = true,
                .help = "a particle whose |rho/rho_0 - 1| is larger stops the run"});
}

void describe(ParameterTable& table, Observer& observer) {
  table.text("name", observer.name,
             {.required = true, .help = "name of the column in fluid.csv", .names_columns = true});
  table.choice(
      "quantity", observer.quantity,
      {"front_x", "pressure", "flow_rate", "flow_amplitude", "flow_error", "largest_void"},
      {.required = true,
       .help =
           "front_x: largest x of the fluid; pressure: kernel mean about `point`; flow_rate: along `axis`, "
           "cross-section of `box` times mean velocity in it; flow_amplitude: share of the initial flow that "
           "the velocity holds; flow_error: of a Taylor-Green flow, root mean square difference from the "
           "exact "
           "velocity over the initial speed; largest_void: farthest that a point of `box` lies from any "
           "particle, walls' too, in spacings, at most 2 (0.71 in a lattice)"});
  table.vector("point", observer.point, {.unit = "m", .help = "where the pressure is probed"});
  table.optional("box", observer.box, "where flow rate or void is taken, to be full of fluid");
  table.choice("axis", observer.axis, {"x", "y"}, {.help = "direction in which the flow rate counts"});
  table.require(observer.quantity != Quantity::flow_rate || observer.box, "quantity",
                "a flow rate needs a 'box'");
  table.require(observer.quantity != Quantity::largest_void || observer.box, "quantity",
                "a largest void needs a 'box'");
}

namespace {

void describe_medium(ParameterTable& table, Parameters& p) {
  table.number(
      "density", p.density,
      {.unit = "kg/m3", .minimum = 0, .above_minimum = true, .required = true, .help = "rest density rho_0"});
  table.number("sound_speed", p.sound_speed,
               {.unit = "m/s",
                .minimum = 0,
                .above_minimum = true,
                .required = true,
                .help = "c_0 at rest density (Monaghan 1994), at least ten times the largest speed"});
  table.integer("stiffness_exponent", p.stiffness_exponent,
                {.minimum = 1, .maximum = 7, .help = "gamma of the equation of state (Monaghan 1994)"});
}

void describe_discretisation(ParameterTable& table, Parameters& p) {
  table.number(
      "spacing", p.spacing,
      {.unit = "m", .minimum = 0, .above_minimum = true, .required = true, .help = "particle spacing d_0"});
  table.choice("kernel", p.kernel, {"cubic_spline", "wendland_c2"},
               {.help = "cubic spline (Monaghan & Lattanzio 1985) or Wendland C2 (1995), support 2h"});
  table.number("smoothing_ratio", p.smoothing_ratio, {.minimum = 1.0, .maximum = 2.0, .help = "h/d_0"});
  table.choice("integrator", p.integrator, {"midpoint", "symplectic"},
               {.help = "the midpoint rule, or a leapfrog that finds each rate once a step"});
  table.number("time_step_share", p.time_step_share,
               {.minimum = 0,
                .maximum = 10,
                .above_minimum = true,
                .help = "share of the stable time step that is taken"});
  table.number(
      "neighbour_skin", p.neighbour_skin,
      {.minimum = 0.01, .maximum = 1, .help = "margin of the neighbour lists over the kernel's support"});
  table.number(
      "start_disorder", p.start_disorder,
      {.minimum = 0,
       .maximum = 0.3,
       .help = "largest random distance of a particle from the lattice at the start, over the spacing; "
               "a lattice that is strained stays one, and shifting finds nothing to mend"});
}

void describe_start(ParameterTable& table, Parameters& p) {
  table.list("region", p.regions, "where there is fluid at the start");
  table.list("hole", p.holes, "cut out of the regions");
  table.optional("hydrostatic_start", p.hydrostatic_start, "start at rest under gravity");
  table.optional("initial_flow", p.initial_flow, "a flow to start with");
}

void describe_terms(ParameterTable& table, Parameters& p) {
  table.optional("central_force", p.central_force, "pulls the fluid towards a point");
  table.optional("background_pressure", p.background_pressure,
                 "added to the pressure; for a medium enclosed on all sides, a free surface would burst");
  table.optional("density_diffusion", p.density_diffusion, "delta-SPH (Marrone et al. 2011)");
  table.optional("particle_shifting", p.particle_shifting, "spreads particles evenly (Sun et al. 2017)");
  table.optional("tensile_control", p.tensile_control, "no pairing under suction (Sun et al. 2018)");
  table.optional("consistent_gradients", p.consistent_gradients,
                 "divergence and pressure gradient exact in linear fields (Randles & Libersky 1996)");
  table.optional("artificial_viscosity", p.artificial_viscosity, "between approaching pairs (Monaghan 1992)");
  table.optional("laminar_viscosity", p.laminar_viscosity, "viscosity of a Newtonian medium");
  table.optional("power_law", p.power_law, "viscosity of a medium that thins or thickens under shear");
  table.optional("carreau", p.carreau, "the same between two plateaus (Carreau 1972)");
  table.optional("friction", p.friction, "of the abrasive on the work pieces (Kato's thesis)");
  table.optional("wall_repulsion", p.wall_repulsion, "keeps particles off the sharp corners of walls");
  table.optional("removal", p.removal, "what comes off the work pieces; writes surface.h5");
  table.group("wall_model", p.wall_model, "how walls act on the fluid (Adami, Hu & Adams 2012)");
}

void require_consistency(ParameterTable& table, const Parameters& p) {
  table.require(!p.regions.empty(), "region", "a fluid needs at least one [[fluid.region]]");
  table.require(!p.consistent_gradients || p.particle_shifting, "consistent_gradients",
                "consistent gradients do not drive particles apart: they need [fluid.particle_shifting]");
  table.require(one_viscosity(p), p.power_law ? "power_law" : "carreau",
                "only one of 'laminar_viscosity', 'power_law' and 'carreau' may be given");
  table.require(flow_is_there(p), "observer",
                "a flow_amplitude needs [fluid.initial_flow]; a flow_error one of Taylor-Green with a "
                "[fluid.laminar_viscosity]");
  table.require(names_differ(p.observers), "observer", "two [[fluid.observer]] have the same name");
}

}  // namespace

void describe(ParameterTable& table, Parameters& p) {
  describe_medium(table, p);
  describe_discretisation(table, p);
  describe_start(table, p);
  describe_terms(table, p);
  table.group("limits", p.limits, "bounds of physics");
  table.list("observer", p.observers, "numbers reported over time in fluid.csv");
  require_consistency(table, p);
}

}  // namespace toryu::fluid
