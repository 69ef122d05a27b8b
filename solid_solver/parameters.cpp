#include "solid_solver/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/case/nearest_word.hpp"
#include "common/scene/worn_box.hpp"

namespace toryu::solid {

void describe(ParameterTable& table, NamedBox& box) {
  table.text("name", box.name, {.required = true, .help = "as the log calls it"});
  describe_shape(table, box.shape, box.box, "its corners");
}

void describe(ParameterTable& table, Clamp& clamp) {
  table.text("name", clamp.name, {.required = true, .help = "as the log calls it"});
  describe_shape(table, clamp.shape, clamp.box, "its corners");
  if (table.wants(!clamp.moves_with.empty()))
    table.text("moves_with", clamp.moves_with,
               {.help = "the [[motion]] that it shares, by name; without it the clamp goes with a wall that "
                        "holds it, else it stands still"});
}

void describe(ParameterTable& table, Pulse& pulse) {
  describe_sine(table, pulse, "1");
}

double BoxLoad::factor_at(double t) const {
  if (!changes()) return 1;
  double sum = value_in(factor, t);
  for (const Pulse& pulse : sine) sum += pulse.value_at(t);
  return sum;
}

void describe(ParameterTable& table, Region& region) {
  table.text("name", region.name, {.required = true, .help = "name of the region", .names_columns = true});
  describe_shape(table, region.shape, region.box, "its corners");
  table.optional("initial_velocity", region.initial_velocity,
                 "velocity of this region at the start; absent: that of the whole solid");
  if (table.wants(!region.material.empty()))
    table.text("material", region.material,
               {.help = "the [[solid.material]] that it is made of, by name; without it that of [solid]"});
  if (table.wants(!region.body.empty()))
    table.text("body", region.body, {.help = "the rigid [[solid.body]] that it belongs to"});
  table.flag("observed", region.observed,
             "whether the displacement and the velocity of its centre of mass go to solid.csv");
  table.list("worn", region.worn, "faces that lie behind those of the box: what has come off");
  require_remains(table, region.box, region.worn, "region");
  table.require(std::all_of(region.worn.begin(), region.worn.end(),
                            [&](const WornFace& worn) { return worn.axis() == region.worn.front().axis(); }),
                "worn", "a region has one worn face, or two opposite ones: make the body of two regions");
}

void describe(ParameterTable& table, BoxLoad& load) {
  table.text("name", load.name, {.required = true, .help = "name of the load"});
  describe_shape(table, load.shape, load.box, "the particles in it share the force equally");
  if (table.wants(load.pressure != 0))
    table.number(
        "pressure", load.pressure,
        {.unit = "Pa",
         .help = "in the place of a force: on the surface that lies in the box, as large and directed "
                 "as that is in the unloaded body"});
  table.vector("force", load.force,
               {.unit = "N/m", .required = load.pressure == 0, .help = "force per metre of depth"});
  table.require(load.pressure == 0 || load.force.isZero(0), "pressure",
                "a load is a 'force' or a 'pressure', not both");
  table.rows("factor", load.factor, {"time [s]", "factor [1]"},
             {.help = "multiplies the force; linear in between, constant before and after"});
  require_rising(table, "factor", load.factor, "times");
  table.list("sine", load.sine, "factors that swing, added to the rows of 'factor'");
  table.require(load.pressure == 0 || !load.changes(), "pressure",
                "a 'pressure' is constant: 'factor' and 'sine' go with a 'force'");
}

void describe(ParameterTable& table, SolidLimits& limits) {
  table.number("speed", limits.speed,
               {.unit = "m/s",
                .minimum = 0,
                .help = "largest speed of a particle; 0: the longitudinal sound speed, of a rigid body any"});
  table.number("strain", limits.strain,
               {.minimum = 0,
                .above_minimum = true,
                .help = "largest relative change of density (updated) or of length (total Lagrangian)"});
}

namespace {

constexpr double not_used = std::numeric_limits<double>::quiet_NaN();

/// The elastic constants, or a law that has constants of its own. `elastic`: whether E and nu must be there.
void describe_material(ParameterTable& table, Material& material, bool elastic) {
  table.choice("law", material.law, {"saint_venant_kirchhoff", "neo_hookean"},
               {.help = "total Lagrangian: stress from strain, with E and nu for small strains"});
  table.optional("yeoh", material.yeoh,
                 "rubber (total Lagrangian); takes the place of law, youngs_modulus and poissons_ratio");
  ElasticMaterial& given = material.elastic;
  elastic = elastic && !material.yeoh;
  if (material.yeoh) given.youngs_modulus = given.poissons_ratio = not_used;
  table.number("density", given.density,
               {.unit = "kg/m3",
                .minimum = 0,
                .above_minimum = true,
                .required = true,
                .help = "of the unloaded solid"});
  table.number("youngs_modulus", given.youngs_modulus,
               {.unit = "Pa", .minimum = 0, .above_minimum = true, .required = elastic, .help = "E"});
  table.number("poissons_ratio", given.poissons_ratio,
               {.minimum = -0.9, .maximum = 0.499, .required = elastic, .help = "nu; plane strain"});
  if (material.yeoh) given = material.yeoh->small_strain(given.density);
}

/// What the whole solid is made of, but for regions that name another material.
void describe_material(ParameterTable& table, Parameters& p) {
  const bool rigid = p.formulation == Formulation::rigid;
  Material own{.law = p.law, .yeoh = p.yeoh, .elastic = p.material};
  if (rigid) own.elastic.youngs_modulus = own.elastic.poissons_ratio = not_used;
  describe_material(table, own, !rigid);
  ElasticMaterial& given = own.elastic;
  const std::string no_use = "a rigid body has a density alone: formulation = \"rigid\" takes no '";
  table.require(!rigid || own.yeoh || std::isnan(given.youngs_modulus), "youngs_modulus",
                no_use + "youngs_modulus'");
  table.require(!rigid || own.yeoh || std::isnan(given.poissons_ratio), "poissons_ratio",
                no_use + "poissons_ratio'");
  if (rigid && !own.yeoh) given.youngs_modulus = given.poissons_ratio = 0;
  p.law = own.law, p.yeoh = own.yeoh, p.material = given;
  table.list("material", p.materials, "what regions are made of that name it");
}

/// Whether no elastic region may be made of a material.
bool is_of_rigid(const Parameters& p, const std::string& material) {
  if (p.formulation == Formulation::rigid) return true;
  const auto uses = [&](const Region& region) { return region.material == material; };
  return std::any_of(p.regions.begin(), p.regions.end(), uses) &&
         std::none_of(p.regions.begin(), p.regions.end(),
                      [&](const Region& region) { return uses(region) && region.body.empty(); });
}

/// The form knows several materials, and each has what the form needs.
void require_materials(ParameterTable& table, const Parameters& p) {
  for (std::size_t k = 0; k < p.materials.size(); ++k) {
    const auto& [name, law, yeoh, elastic] = p.materials[k];
    const std::string place = fmt::format("material.{}", k);
    const bool rigid = is_of_rigid(p, name);
    table.require(rigid || p.formulation != Formulation::updated_lagrangian, place,
                  "[[solid.material]] is for formulation = \"total_lagrangian\" or \"rigid\"; the updated "
                  "form has one material");
    for (const auto& [key, value] : {std::pair("youngs_modulus", elastic.youngs_modulus),
                                     std::pair("poissons_ratio", elastic.poissons_ratio)})
      table.require(rigid || !std::isnan(value), place,
                    fmt::format("missing key '{}' in [[solid.material]] '{}'", key, name));
    const bool density_alone = std::isnan(elastic.youngs_modulus) && std::isnan(elastic.poissons_ratio) &&
                               law == Material{}.law && !yeoh;
    table.require(!rigid || density_alone, place, "a material of a rigid body has a density alone");
  }
}

/// The material of each region is there.
void require_named_materials(ParameterTable& table, const Parameters& p) {
  std::vector<std::string> names;
  for (const Material& material : p.materials) names.push_back(material.name);
  for (std::size_t k = 0; k < p.regions.size(); ++k) {
    const std::string& asked = p.regions[k].material;
    const bool found = asked.empty() || std::find(names.begin(), names.end(), asked) != names.end();
    table.require(found, fmt::format("region.{}.material", k),
                  fmt::format("no [[solid.material]] is named '{}'{}", asked, what_there_is(asked, names)));
  }
}

void describe_discretisation(ParameterTable& table, Parameters& p) {
  table.number("spacing", p.spacing,
               {.unit = "m",
                .minimum = 0,
                .above_minimum = true,
                .required = true,
                .help = "of the particles; each region takes the nearest that divides its sides"});
  table.number("smoothing_ratio", p.smoothing_ratio,
               {.minimum = 1.0, .maximum = 2.0, .help = "smoothing length over spacing, h/d0"});
  table.number(
      "time_step_share", p.time_step_share,
      {.minimum = 0, .maximum = 1, .above_minimum = true, .help = "of the largest stable time step"});
  table.number(
      "courant_number", p.courant_number,
      {.minimum = 0,
       .maximum = 4,
       .above_minimum = true,
       .help = "updated Lagrangian: acoustic limit of the time step, times h/(c_L + |v|); artificial "
               "viscosity bears more than 0.25"});
  table.choice(
      "gradients", p.gradients, {"plain", "renormalised"},
      {.help = "updated Lagrangian: whether velocity gradient and stress divergence are renormalised; "
               "total Lagrangian always does"});
  table.choice("integrator", p.integrator, {"midpoint", "symplectic"},
               {.help = "updated Lagrangian: two evaluations a step, or one and no growth of undamped "
                        "modes; the total Lagrangian form's is symplectic"});
}

/// Its shape, what holds and loads it, and how it starts.
void describe_body(ParameterTable& table, Parameters& p) {
  table.list("region", p.regions, "boxes filled with the solid; they may touch but not overlap");
  table.list("hole", p.holes, "boxes cut out of the regions");
  table.list("clamp", p.clamps, "boxes whose particles are held, or moved as prescribed");
  table.list("load", p.loads, "forces or constant pressures on the particles of a box");
  table.list("observer", p.observers, "material points whose displacement goes to solid.csv");
  table.optional("initial_velocity", p.initial_velocity, "velocity at the start; absent: at rest");
}

void describe_terms(ParameterTable& table, Parameters& p) {
  table.optional("hourglass", p.hourglass,
                 "pair penalty on modes the strain does not see (total Lagrangian)");
  table.optional("artificial_viscosity", p.artificial_viscosity, "damps approaching pairs");
  table.optional("artificial_stress", p.artificial_stress,
                 "keeps stretched particles apart (updated Lagrangian)");
  table.optional("damping", p.damping, "slows all motion down, to find a state of rest");
  table.optional("wall_contact", p.wall_contact, "rigid walls act on the solid");
  table.optional("body_contact", p.body_contact,
                 "bodies that are not joined push each other (total Lagrangian)");
  table.optional("mounting", p.mounting, "what holds a rigid body: fixed coordinates, springs, dampers");
  table.list("body", p.bodies, "rigid bodies, several or beside elastic regions");
  table.optional("detachment", p.detachment,
                 "looks for particles that no chain of neighbours joins to a clamp");
  table.optional(
      "bonds", p.bonds,
      "columns that tell whether the body tears or its particles clump: stretches of pairs adjacent "
      "at the start");
}

/// Each of several rigid bodies has regions, and each region has a body or, beside rigid ones, is elastic.
void require_bodies(ParameterTable& table, const Parameters& p) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < p.bodies.size(); ++k) {
    const std::string& name = names.emplace_back(p.bodies[k].name);
    const bool used = std::any_of(p.regions.begin(), p.regions.end(),
                                  [&](const Region& region) { return region.body == name; });
    table.require(used, fmt::format("body.{}", k),
                  fmt::format("no [[solid.region]] has body = \"{}\"", name));
  }
  for (std::size_t k = 0; k < p.regions.size(); ++k) {
    const std::string& asked = p.regions[k].body;
    const std::string place = fmt::format("region.{}", k);
    if (asked.empty()) {
      table.require(
          names.empty() || p.is_mixed(), place,
          fmt::format("region '{}' needs a 'body': there are {}", p.regions[k].name, quoted_list(names)));
      continue;
    }
    table.require(std::find(names.begin(), names.end(), asked) != names.end(), place + ".body",
                  fmt::format("no [[solid.body]] is named '{}'{}", asked, what_there_is(asked, names)));
  }
  table.require(p.bodies.empty() || !p.mounting, "mounting",
                "[solid.mounting] is of a rigid body that is the only one: each [[solid.body]] has its own "
                "[solid.body.mounting]");
}

/// A rigid body moves in three coordinates alone.
void require_rigid_motion(ParameterTable& table, const Parameters& p) {
  for (std::size_t k = 0; k < p.regions.size(); ++k)
    table.require(!p.regions[k].initial_velocity || (p.is_mixed() && p.regions[k].body.empty()),
                  fmt::format("region.{}.initial_velocity", k),
                  "all regions of a rigid body move as one: it has [solid.initial_velocity] alone");
  const auto& v = p.initial_velocity;
  table.require(
      !v || v->is_rigid(), "initial_velocity",
      "a rigid body starts with profile = \"uniform\", or with \"linear\" and gradient = [[0, -w], [w, "
      "0]], a turn");
  table.require(
      !p.wall_contact || p.wall_contact->modulus > 0, "wall_contact",
      "[solid.wall_contact] of a rigid body needs a 'modulus' [Pa] in the place of its bulk modulus");
}

/// It has neither stress nor bonds.
void require_rigid(ParameterTable& table, const Parameters& p) {
  require_bodies(table, p);
  table.require(p.clamps.empty(), "clamp",
                "[[solid.clamp]] holds particles of a solid that deforms; what holds a body of formulation = "
                "\"rigid\" is [solid.mounting]");
  const Parameters usual;
  const std::pair<const char*, bool> of_others[] = {
      {"law", p.law != usual.law},
      {"yeoh", p.yeoh.has_value()},
      {"hourglass", p.hourglass.has_value()},
      {"artificial_viscosity", p.artificial_viscosity.has_value()},
      {"artificial_stress", p.artificial_stress.has_value()},
      {"damping", p.damping.has_value()},
      {"body_contact", p.body_contact.has_value()},
      {"detachment", p.detachment.has_value()},
      {"bonds", p.bonds.has_value()},
      {"courant_number", p.courant_number != usual.courant_number},
      {"integrator", p.integrator != usual.integrator},
      {"gradients", p.gradients != usual.gradients},
      {"limits.strain", p.limits.strain != usual.limits.strain}};
  for (const auto& [key, given] : of_others)
    table.require(
        !given, key,
        fmt::format("'{}' in [solid] is for a solid that deforms, not for formulation = \"rigid\"", key));
  for (std::size_t k = 0; k < p.observers.size(); ++k)
    table.require(!p.observers[k].stress, fmt::format("observer.{}.stress", k),
                  "there is no stress in a body of formulation = \"rigid\"");
  require_rigid_motion(table, p);
}

void require_rigid_beside_elastic(ParameterTable& table, const Parameters& p) {
  require_rigid_motion(table, p);
  const bool any_elastic = std::any_of(p.regions.begin(), p.regions.end(),
                                       [](const Region& region) { return region.body.empty(); });
  table.require(any_elastic, "body",
                "every region belongs to a rigid [[solid.body]]: give [solid] formulation = \"rigid\"");
}

void require_consistency(ParameterTable& table, const Parameters& p) {
  if (p.formulation == Formulation::rigid) return require_rigid(table, p);
  const bool total = p.formulation == Formulation::total_lagrangian;
  require_bodies(table, p);
  if (p.is_mixed()) require_rigid_beside_elastic(table, p);
  table.require(
      !p.mounting || p.is_mixed(), "mounting",
      "[solid.mounting] is for formulation = \"rigid\" only; what deforms is held by [[solid.clamp]]");
  table.require(total || (p.law == ElasticLaw::saint_venant_kirchhoff && !p.yeoh), p.yeoh ? "yeoh" : "law",
                "'law' and [solid.yeoh] are for formulation = \"total_lagrangian\" only; the other has "
                "Hooke's law");
  table.require(total || !p.hourglass, "hourglass",
                "[solid.hourglass] is for formulation = \"total_lagrangian\" only");
  table.require(
      total || !p.body_contact, "body_contact",
      "[solid.body_contact] is for formulation = \"total_lagrangian\" only; in the other, bodies see "
      "each other as neighbours");
  table.require(!total || !p.artificial_stress, "artificial_stress",
                "[solid.artificial_stress] is for formulation = \"updated_lagrangian\" only");
  table.require(
      !total || p.courant_number == Parameters{}.courant_number, "courant_number",
      "'courant_number' in [solid] is for formulation = \"updated_lagrangian\" only; the other finds its "
      "limit");
  table.require(!p.detachment || !p.clamps.empty(), "detachment",
                "[solid.detachment] needs a [[solid.clamp]]: detached is what no chain joins to one");
  table.require(
      !total || p.integrator == Integrator::midpoint, "integrator",
      "'integrator' in [solid] is for formulation = \"updated_lagrangian\" only; the other is always "
      "symplectic");
  table.require(!total || p.gradients == Gradients::plain, "gradients",
                "'gradients' in [solid] is for formulation = \"updated_lagrangian\" only; the other always "
                "renormalises");
}

}  // namespace

void describe(ParameterTable& table, NamedBody& body) {
  table.text("name", body.name, {.required = true, .help = "as its columns begin", .names_columns = true});
  table.optional("mounting", body.mounting, "what holds it: fixed coordinates, springs, dampers");
}

void describe(ParameterTable& table, Material& material) {
  table.text("name", material.name, {.required = true, .help = "as regions name it"});
  describe_material(table, material, false);
}

void describe(ParameterTable& table, Parameters& p) {
  table.choice("formulation", p.formulation, {"total_lagrangian", "updated_lagrangian", "rigid"},
               {.help = "total: neighbours of the unloaded body for ever, stiff plates of few rows come out "
                        "right; updated: present neighbours, can tear; rigid: one body that floats, falls or "
                        "hangs on springs"});
  describe_material(table, p);
  describe_discretisation(table, p);
  describe_body(table, p);
  describe_terms(table, p);
  table.group("limits", p.limits, "bounds beyond which the run stops");
  table.require(!p.regions.empty(), "region", "[solid] needs at least one [[solid.region]]");
  require_materials(table, p);
  require_named_materials(table, p);
  require_consistency(table, p);
}

}  // namespace toryu::solid
