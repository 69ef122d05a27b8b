#include "fluid_solver/named_medium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "fluid_solver/parameters.hpp"

namespace toryu::fluid {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The bounds of the power laws are no data: they lie where machines do not shear a medium.
const std::vector<MediumRecord>& media() {
  static const std::vector<MediumRecord> list{
      {"trengove_c11", PowerLaw{989, 0.935, 500, 2000}, 100,
       "polyborosiloxane C-11 without grain, 30 C, up to 100 1/s: m 989 Pa s^n, n 0.935 (Trengove 1993)"},
      {"newtonian_1000", LaminarViscosity{1000}, unlimited, "a medium for exercises: 1000 Pa s"},
      {"thinning_1000", PowerLaw{25780, 0.4, 10, 16000}, unlimited,
       "a medium for exercises: a power law of exponent 0.4, 1000 Pa s at 225 1/s"}};
  return list;
}

}  // namespace

void describe(ParameterTable& table, NamedMedium& medium) {
  std::vector<std::string> names;
  for (const MediumRecord& record : media()) names.push_back(record.name);
  table.text("name", medium.name,
             {.required = true,
              .help = "sets the viscosity to what was published of the medium; the log tells the law, its "
                      "range and the source",
              .allowed = names});
}

const MediumRecord& record_of(const NamedMedium& medium) {
  for (const MediumRecord& record : media())
    if (record.name == medium.name) return record;
  throw std::logic_error("no medium is called '" + medium.name + "'");
}

std::string take_named_medium(Parameters& p) {
  const MediumRecord& record = record_of(*p.medium);
  if (const auto* newtonian = std::get_if<LaminarViscosity>(&record.law)) p.laminar_viscosity = *newtonian;
  if (const auto* power_law = std::get_if<PowerLaw>(&record.law)) p.power_law = *power_law;
  return fmt::format("medium {}: {}", record.name, record.source);
}

std::optional<std::string> beyond_measured(const Parameters& p, Geometry geometry) {
  if (!p.medium || !p.similarity) return {};
  const MediumRecord& record = record_of(*p.medium);
  const double rate =
      passage_flow(p, p.similarity->mean_speed, p.similarity->passage_width, geometry).wall_shear_rate;
  if (rate <= record.largest_shear_rate) return {};
  return fmt::format(
      "the walls of the passage shear the medium at {:.3g} 1/s, and '{}' was measured up to {:g} 1/s: beyond "
      "that its law is a guess",
      rate, record.name, record.largest_shear_rate);
}

std::optional<std::string> beyond_measured(const MediumRecord& medium, const Particles& fluid, double time) {
  if (fluid.gdot.empty()) return {};
  const auto count = static_cast<std::size_t>(
      std::count_if(fluid.gdot.begin(), fluid.gdot.begin() + static_cast<std::ptrdiff_t>(fluid.count),
                    [&](double gdot) { return gdot > medium.largest_shear_rate; }));
  if (count < std::max<std::size_t>(1, fluid.count / 100)) return {};
  return fmt::format(
      "t = {:.3g} s: {:.2g} % of the fluid is sheared faster than the {:g} 1/s up to which '{}' was "
      "measured: "
      "beyond that its law is a guess",
      time, 100.0 * static_cast<double>(count) / static_cast<double>(fluid.count), medium.largest_shear_rate,
      medium.name);
}

}  // namespace toryu::fluid
