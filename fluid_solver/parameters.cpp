#include "fluid_solver/parameters.hpp"

#include <cmath>

#include "common/sph/lanes.hpp"

namespace toryu::fluid {

namespace {

bool flow_is_there(const Parameters& p) {
  const bool known = p.initial_flow && p.initial_flow->profile == FlowProfile::taylor_green &&
                     p.laminar_viscosity.has_value();
  for (const auto& observer : p.observers)
    if ((observer.quantity == Quantity::flow_amplitude && !p.initial_flow) ||
        (observer.quantity == Quantity::flow_error && !known))
      return false;
  return true;
}

/// The keys by which the case gives its medium a viscosity, the Newtonian one last.
std::vector<std::string> keys_of_viscosity(const Parameters& p) {
  std::vector<std::string> keys;
  if (p.power_law) keys.emplace_back(PowerLaw::section);
  if (p.herschel_bulkley) keys.emplace_back(HerschelBulkley::section);
  if (p.carreau) keys.emplace_back(Carreau::section);
  if (p.medium) keys.emplace_back("medium");
  if (p.laminar_viscosity) keys.emplace_back(LaminarViscosity::section);
  return keys;
}

}  // namespace

double Parameters::strip_width() const {
  return std::sqrt(static_cast<double>(lane_count)) * spacing;
}

void describe(ParameterTable& table, Region& region) {
  table.text("name", region.name, {.required = true, .help = "name in the log"});
  describe_shape(table, region.shape, region.box, "filled with fluid at the start");
  table.vector("velocity", region.velocity, {.unit = "m/s", .help = "velocity at the start"});
}

void describe(ParameterTable& table, Hole& hole) {
  table.text("name", hole.name, {.help = "by which a case with this one as its base means it"});
  if (!describe_optional_shape(table, hole.shape, hole, "cut out of the fluid, as by 'min' and 'max'"))
    describe(table, static_cast<Box&>(hole));
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

void describe(ParameterTable& table, HydrostaticStart& start) {
  table.number("surface_level", start.surface_level,
               {.unit = "m", .required = true, .help = "height of the free surface, against gravity"});
}

void describe(ParameterTable& table, WallModel& model) {
  table.choice("slip", model.slip, {"no_slip", "free_slip"},
               {.help = "whether viscous terms act at walls (Adami, Hu & Adams 2012)"});
  table.choice("density", model.density, {"rest", "from_pressure"},
               {.help = "density of wall particles: the rest density, or that of their pressure (Adami, Hu & "
                        "Adams 2012)"});
  table.choice(
      "extrapolation", model.extrapolation, {"mean", "fit"},
      {.help = "velocity and viscosity that rigid walls show to viscous terms: kernel means (Adami, Hu "
               "& Adams 2012), or a parabola and a line fitted through the wall's face"});
  table.flag("suction", model.suction,
             "whether walls hold a fluid whose pressure is negative; false where air can come between them");
  table.require(model.extrapolation == WallExtrapolation::mean || model.slip == WallSlip::no_slip,
                "extrapolation",
                "a 'fit' is of what viscous terms see at walls: it needs slip = \"no_slip\"");
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
  table.number(
      "largest_mean_density_change", limits.largest_mean_density_change,
      {.minimum = 0,
       .above_minimum = true,
       .help = "a mean density that differs by a larger share from that at the start stops the run"});
  table.number("largest_share_in_walls", limits.largest_share_in_walls,
               {.minimum = 0,
                .help = "a larger share of the particles inside walls or the solid, and ten at least, stops "
                        "the run"});
  table.number("largest_energy_gain", limits.largest_energy_gain,
               {.minimum = 0,
                .above_minimum = true,
                .help = "energy that no boundary gave the fluid stops the run where it exceeds so many times "
                        "the largest that it has turned over"});
}

void describe(ParameterTable& table, Observer& observer) {
  table.text("name", observer.name,
             {.required = true, .help = "name of the column in fluid.csv", .names_columns = true});
  table.choice(
      "quantity", observer.quantity,
      {"front_x", "pressure", "flow_rate", "flow_amplitude", "flow_error", "largest_void", "volume_flux"},
      {.required = true,
       .help =
           "front_x: largest x of the fluid; pressure: kernel mean about `point`; flow_rate: along `axis`, "
           "cross-section of `box` times mean velocity in it; flow_amplitude: share of the initial flow that "
           "the velocity holds; flow_error: of a Taylor-Green flow, root mean square difference from the "
           "exact "
           "velocity over the initial speed; largest_void: farthest that a point of `box` lies from any "
           "particle, walls' too, in spacings, at most 2 (0.71 in a lattice); volume_flux: along `axis`, of "
           "what is "
           "in `box`, however wide the passage is in it"});
  table.vector("point", observer.point, {.unit = "m", .help = "where the pressure is probed"});
  Box box = observer.box.value_or(Box{});
  if (describe_optional_shape(table, observer.shape, box,
                              "where a flow rate or a void is taken, to be full of fluid, or a volume flux"))
    observer.box = box;
  table.choice("axis", observer.axis, {"x", "y"}, {.help = "direction in which a flow counts"});
  table.require(observer.quantity != Quantity::flow_rate || observer.box, "quantity",
                "a flow rate needs a 'box'");
  table.require(observer.quantity != Quantity::volume_flux || observer.box, "quantity",
                "a volume flux needs a 'box'");
  table.require(observer.quantity == Quantity::largest_void || !observer.box || !observer.box->outline,
                "quantity", "of an outline there is a largest_void alone: a flow is taken in a 'box'");
  table.require(observer.quantity != Quantity::largest_void || observer.box, "quantity",
                "a largest void needs a 'box'");
}

namespace {

void describe_medium(ParameterTable& table, Parameters& p) {
  table.number(
      "density", p.density,
      {.unit = "kg/m3", .minimum = 0, .above_minimum = true, .required = true, .help = "rest density rho_0"});
  table.optional("medium", p.medium, "a medium of which the viscosity was published, by its name");
  table.optional("temperature", p.temperature, "of the medium, where it is not that of its constants");
  table.optional("similarity", p.similarity,
                 "creeping flow of a very viscous medium at a density that makes its steps long");
  table.number("sound_speed", p.sound_speed,
               {.unit = "m/s",
                .minimum = 0,
                .above_minimum = !p.similarity,
                .required = !p.similarity,
                .help = "c_0 at rest density (Monaghan 1994), at least ten times the largest speed; 0 with "
                        "[fluid.similarity]: chosen"});
  table.integer("stiffness_exponent", p.stiffness_exponent,
                {.minimum = 1, .maximum = 7, .help = "gamma of the equation of state (Monaghan 1994)"});
}

/// The discretisation that bears a high pressure over the shear stress, unless the case says another.
void take_defaults_of_similarity(Parameters& p) {
  p.kernel = KernelForm::wendland_c2;
  p.smoothing_ratio = 2.0;
}

/// Unless the case says another: the edge of such a flow lies between 5 and 6.5 by symplectic steps, far
/// lower by others.
void take_share_of_similarity(Parameters& p) {
  if (p.integrator == Integrator::symplectic) p.time_step_share = 4.5;
}

void describe_discretisation(ParameterTable& table, Parameters& p, bool chosen_by_similarity) {
  if (chosen_by_similarity) take_defaults_of_similarity(p);
  table.number(
      "spacing", p.spacing,
      {.unit = "m", .minimum = 0, .above_minimum = true, .required = true, .help = "particle spacing d_0"});
  table.choice("kernel", p.kernel, {"cubic_spline", "wendland_c2"},
               {.help = "cubic spline (Monaghan & Lattanzio 1985) or Wendland C2 (1995), support 2h"});
  table.number("smoothing_ratio", p.smoothing_ratio, {.minimum = 1.0, .maximum = 4.0, .help = "h/d_0"});
  table.choice("integrator", p.integrator, {"midpoint", "symplectic"},
               {.help = "a leapfrog that finds each rate once a step, or the midpoint rule"});
  if (chosen_by_similarity) take_share_of_similarity(p);
  table.number("time_step_share", p.time_step_share,
               {.minimum = 0,
                .maximum = 10,
                .above_minimum = true,
                .help = "share of the stable time step that is taken"});
  table.number("neighbour_skin", p.neighbour_skin,
               {.minimum = 0.01,
                .maximum = 1,
                .help = "largest margin of the neighbour lists over the kernel's support"});
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
  table.list("inlet", p.inlets, "open ends of channels where fluid comes in");
  table.list("outlet", p.outlets, "open ends of channels where fluid leaves");
}

void describe_model(ParameterTable& table, Parameters& p) {
  table.choice("model", p.model, {"weakly_compressible", "implicit"},
               {.help = "how the state advances: explicitly by delta-SPH, or velocity and pressure implicit "
                        "together in long steps, for creeping media without free surface"});
  table.optional("implicit", p.implicit, "how model = \"implicit\" solves its steps");
  table.require(!p.implicit || p.model == Model::implicit, "implicit",
                "[fluid.implicit] is for model = \"implicit\"");
}

void describe_terms(ParameterTable& table, Parameters& p) {
  const bool is_implicit = p.model == Model::implicit;
  for_each_term(p, [&]<class Term>(std::optional<Term>& term) {
    table.optional(Term::section, term, Term::help, is_implicit ? Absence::leaves_out : absence_of<Term>());
  });
  table.group("wall_model", p.wall_model, "how walls act on the fluid (Adami, Hu & Adams 2012)");
}

/// Whether the fluid is one square without holes.
bool is_square(const Parameters& p) {
  if (p.regions.size() != 1 || !p.holes.empty() || !p.regions.front().box.is_rectangle()) return false;
  const Vec side = p.regions.front().box.max - p.regions.front().box.min;
  return std::abs(side[0] - side[1]) < 0.5 * p.spacing;
}

/// What the elastic stress of a medium needs.
void require_of_viscoelasticity(ParameterTable& table, const Parameters& p) {
  if (!p.viscoelasticity) return;
  table.require(!keys_of_viscosity(p).empty(), "viscoelasticity",
                "a polymer needs a solvent, which damps what its stress does not see: give a "
                "[fluid.laminar_viscosity]");
  table.require(
      p.wall_model.slip == WallSlip::no_slip, "viscoelasticity",
      "walls take the polymer's stress along with the fluid's before them: it needs [fluid.wall_model] "
      "slip = \"no_slip\"");
}

void require_consistency(ParameterTable& table, const Parameters& p) {
  table.require(
      !p.initial_flow || p.initial_flow->profile != FlowProfile::rotation || p.regions.empty() ||
          is_square(p),
      "initial_flow",
      "the pressure of a rotation is known of a square alone: one [[fluid.region]] with equal sides, "
      "neither round nor with holes");
  table.require(!p.regions.empty(), "region", "a fluid needs at least one [[fluid.region]]");
  table.require(!p.consistent_gradients || p.particle_shifting, "consistent_gradients",
                "consistent gradients do not drive particles apart: they need [fluid.particle_shifting]");
  const auto viscosities = keys_of_viscosity(p);
  table.require(
      viscosities.size() <= 1, viscosities.empty() ? "" : viscosities.front(),
      "only one of 'laminar_viscosity', 'power_law', 'herschel_bulkley', 'carreau' and 'medium' may "
      "be given");
  table.require(!p.temperature || !viscosities.empty(), "temperature",
                "a temperature changes a viscosity, and none is given");
  require_of_viscoelasticity(table, p);
  table.require(flow_is_there(p), "observer",
                "a flow_amplitude needs [fluid.initial_flow]; a flow_error one of Taylor-Green with a "
                "[fluid.laminar_viscosity]");
}

/// Beyond it the shear stress of a wall is lost in rounding [m/s/Pa^m].
constexpr double largest_slip_coefficient = 1e6;

void require_slip_to_act(ParameterTable& table, const Parameters& p) {
  table.require(
      !p.wall_slip || p.wall_model.slip == WallSlip::no_slip, "wall_slip",
      "[fluid.wall_slip] acts on the shear stress of walls that are no-slip otherwise; under slip = "
      "\"free_slip\" there is none: leave one of the two out");
  table.require(!p.wall_slip || is_viscous(p), "wall_slip",
                "[fluid.wall_slip] needs a medium with a viscosity, of which the walls' shear stress comes: "
                "[fluid.laminar_viscosity], [fluid.power_law], [fluid.herschel_bulkley] or [fluid.carreau]");
  table.require(!p.wall_slip || p.wall_slip->coefficient <= largest_slip_coefficient, "wall_slip",
                fmt::format("'coefficient' in [fluid.wall_slip] must be at most {:g}: walls without shear "
                            "stress are slip = \"free_slip\" of [fluid.wall_model]",
                            largest_slip_coefficient));
  table.require(
      !p.wall_slip || !p.artificial_viscosity, "wall_slip",
      "artificial viscosity brakes the medium at walls whatever [fluid.wall_slip] says: leave one of "
      "the two out");
  table.require(!p.removal || !p.viscoelasticity, "removal",
                "[fluid.removal] knows the shear stress of the viscosity alone: it does not go with "
                "[fluid.viscoelasticity]");
  table.require(!p.wall_slip || !p.viscoelasticity, "wall_slip",
                "[fluid.wall_slip] knows the shear stress of the viscosity alone: it does not go with "
                "[fluid.viscoelasticity]");
  table.require(
      !p.wall_slip || !p.friction || p.friction->form == FrictionForm::normalised, "wall_slip",
      "beside [fluid.wall_slip] the friction of a work piece is mu_A p: [fluid.friction] takes form = "
      "\"normalised\"");
}

}  // namespace

void describe(ParameterTable& table, Parameters& p) {
  const bool was_similar = p.similarity.has_value();  // what was read is only written then
  describe_model(table, p);
  describe_medium(table, p);
  describe_discretisation(table, p, p.similarity && !was_similar);
  describe_start(table, p);
  describe_terms(table, p);
  table.group("limits", p.limits, "bounds of physics");
  table.list("observer", p.observers, "numbers reported over time in fluid.csv");
  require_consistency(table, p);
  require_slip_to_act(table, p);
}

std::vector<std::string> complete_medium(Parameters& p) {
  std::vector<std::string> said;
  if (p.medium) said.push_back(take_named_medium(p));
  if (p.temperature) said.push_back(take_temperature(p));
  return said;
}

}  // namespace toryu::fluid
