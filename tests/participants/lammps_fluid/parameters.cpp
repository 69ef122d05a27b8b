#include "parameters.hpp"

#include <fmt/format.h>

namespace toryu::lammps_fluid {

// Not in a namespace without a name, where the parameter table would not find them.
static void describe(ParameterTable& table, Box& box) {
  table.vector("min", box.min, {.unit = "m", .required = true, .help = "smallest corner"});
  table.vector("max", box.max, {.unit = "m", .required = true, .help = "largest corner"});
  table.require((box.max.array() > box.min.array()).all(), "max", "'max' must exceed 'min'");
}
static void describe(ParameterTable& table, Wall& wall) {
  table.text("name", wall.name, {.required = true, .help = "name in the log"});
  table.group("box", wall.box, "its two corners");
}
static void describe(ParameterTable& table, Region& region) {
  describe(table, static_cast<Wall&>(region));
  table.vector("velocity", region.velocity, {.unit = "m/s", .help = "at the start"});
}
static void describe(ParameterTable& table, Scene& s) {
  const auto time = [&](const char* key, double& value, const char* help) {
    table.number(key, value, {.unit = "s", .minimum = 0, .help = help});
  };
  table.text("title", s.title, {.required = true, .help = "of the case"});
  table.vector("gravity", s.gravity, {.unit = "m/s2", .help = "acceleration of gravity"});
  table.number(
      "end_time", s.end_time,
      {.unit = "s", .minimum = 0, .above_minimum = true, .required = true, .help = "end of the run"});
  time("frame_interval", s.frame_interval, "not used: there are no frames");
  time("series_interval", s.series_interval, "between rows of fluid.csv; 0: every step");
  time("checkpoint_interval", s.checkpoint_interval, "the coupler's");
  time("checkpoint_every", s.checkpoint_every, "the coupler's");
  table.group("domain", s.domain, "a particle outside it stops the run");
}
static void describe(ParameterTable& table, Diffusion& d) {
  table.number("delta", d.delta, {.minimum = 0, .maximum = 1, .help = "coefficient (Marrone et al. 2011)"});
  table.choice("gradient", d.gradient, {"renormalised", "none"}, {.help = "linear part left alone"});
}
static void describe(ParameterTable& table, ArtificialViscosity& a) {
  table.number("alpha", a.alpha, {.minimum = 0, .maximum = 10, .help = "linear (Monaghan 1992)"});
  table.number("beta", a.beta, {.minimum = 0, .maximum = 10, .help = "quadratic (Monaghan 1992)"});
}
static void describe(ParameterTable& table, LaminarViscosity& l) {
  table.number("dynamic_viscosity", l.dynamic_viscosity,
               {.unit = "Pa.s", .minimum = 0, .required = true, .help = "mu (Morris, Fox & Zhu 1997)"});
}
static void describe(ParameterTable& table, HydrostaticStart& start) {
  table.number("surface_level", start.surface_level,
               {.unit = "m", .required = true, .help = "height of the free surface"});
}
static void describe(ParameterTable& table, WallModel& model) {
  int rest = 0, mean = 0;
  table.choice("slip", model.slip, {"no_slip", "free_slip"}, {.help = "whether viscous terms act at walls"});
  table.flag("suction", model.suction, "whether walls hold a fluid whose pressure is negative");
  table.choice("density", rest, {"rest"}, {.help = "of wall particles"});
  table.choice("extrapolation", mean, {"mean"}, {.help = "kernel means (Adami, Hu & Adams 2012)"});
}
static void describe(ParameterTable& table, Limits& limits) {
  table.number("largest_speed", limits.speed,
               {.unit = "m/s", .minimum = 0, .help = "a faster particle stops the run; 0: sound"});
  table.number("largest_density_change", limits.density_change,
               {.minimum = 0, .maximum = 1, .above_minimum = true, .help = "share of the rest density"});
}
static void describe(ParameterTable& table, Observer& o) {
  table.text("name", o.name, {.required = true, .help = "of the column", .names_columns = true});
  table.choice("quantity", o.quantity, {"front_x", "pressure"},
               {.required = true, .help = "largest x, or kernel mean of the pressure about `point`"});
  table.vector("point", o.point, {.unit = "m", .help = "where the pressure is probed"});
}

static void describe_numbers(ParameterTable& table, Parameters& p) {
  const auto positive = [&](const char* key, double& value, const char* unit, const char* help) {
    table.number(key, value,
                 {.unit = unit, .minimum = 0, .above_minimum = true, .required = true, .help = help});
  };
  positive("density", p.density, "kg/m3", "at rest");
  positive("sound_speed", p.sound_speed, "m/s", "at rest density");
  positive("spacing", p.spacing, "m", "of particles");
  table.integer("stiffness_exponent", p.stiffness_exponent, {.minimum = 1, .maximum = 7, .help = "gamma"});
  table.choice("kernel", p.kernel, {"cubic_spline", "wendland_c2"}, {.help = "of support 2h"});
  table.number("smoothing_ratio", p.smoothing_ratio, {.minimum = 1, .maximum = 4, .help = "h/d_0"});
  table.choice("integrator", p.integrator, {"midpoint", "symplectic"}, {.help = "of the steps"});
  table.number("time_step_share", p.time_step_share,
               {.minimum = 0, .maximum = 10, .above_minimum = true, .help = "of the stable step"});
  table.number("neighbour_skin", p.neighbour_skin,
               {.minimum = 0.01, .maximum = 1, .help = "margin of the lists over the support"});
}

namespace {

/// The keys that fluid_solver knows and this program does not, by the section in which they stand.
const std::vector<std::pair<std::string, std::vector<std::string>>> unknown_here{
    {"case", {"periodic", "geometry", "gravity_change"}},
    {"fluid",
     {"medium",
      "temperature",
      "similarity",
      "start_disorder",
      "hole",
      "initial_flow",
      "inlet",
      "outlet",
      "model",
      "implicit",
      "central_force",
      "background_pressure",
      "enclosed_medium",
      "held_volume",
      "particle_shifting",
      "tensile_control",
      "consistent_gradients",
      "power_law",
      "herschel_bulkley",
      "carreau",
      "viscoelasticity",
      "wall_slip",
      "friction",
      "wall_repulsion",
      "surface_tension",
      "removal"}},
    {"fluid.limits", {"largest_mean_density_change", "largest_share_in_walls", "largest_energy_gain"}}};
const std::vector<std::string> unknown_of_bodies{
    "circle", "polygon", "holes",     "file",   "tolerance",  "about", "mirror",     "scale",
    "rotate", "array",   "translate", "motion", "moves_with", "press", "work_piece", "worn"};

void refuse(CaseFile& file, const std::string& key, const std::string& name) {
  if (file.has(key)) file.fault(key, fmt::format("lammps_fluid does not know '{}'; fluid_solver does", name));
}

}  // namespace

static void describe(ParameterTable& table, Parameters& p) {
  describe_numbers(table, p);
  table.optional("hydrostatic_start", p.hydrostatic_start, "start at rest under gravity");
  table.optional("density_diffusion", p.diffusion, "delta-SPH", Absence::takes_defaults);
  table.optional("artificial_viscosity", p.artificial, "between approaching pairs");
  table.optional("laminar_viscosity", p.laminar, "of a Newtonian medium");
  table.group("wall_model", p.wall_model, "how walls act on the fluid");
  table.group("limits", p.limits, "bounds of physics");
  table.list("region", p.regions, "where there is fluid at the start");
  table.list("observer", p.observers, "numbers in fluid.csv");
  table.require(!p.regions.empty(), "region", "a fluid needs at least one [[fluid.region]]");
}

Case read_case(CaseFile& file) {
  Case read;
  file.ignore_sections({"case", "fluid", "wall", "solid", "coupling", "reference"});
  for (const auto& [section, keys] : unknown_here)
    for (const auto& key : keys) refuse(file, section + '.' + key, key);
  for (const std::string list : {"wall", "fluid.region"})
    for (std::size_t k = 0; k < file.count(list); ++k)
      for (const auto& key : unknown_of_bodies) {
        const std::string place = fmt::format("{}[{}]", list, k);
        if (file.has(place + '.' + key))
          file.fault(fmt::format("{}.{}.{}", list, k, key),
                     fmt::format("lammps_fluid does not know '{}'; fluid_solver does", key));
      }
  file.throw_if_faulty();
  file.read("case", read.scene, "the scene");
  file.read_list("wall", read.walls, "rigid walls at rest");
  file.read("fluid", read.parameters, "a weakly compressible fluid by delta-SPH");
  file.throw_if_faulty();
  return read;
}

}  // namespace toryu::lammps_fluid
