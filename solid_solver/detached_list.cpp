#include "solid_solver/detached_list.hpp"

#include <fmt/format.h>

#include "common/output/atomic_file.hpp"
#include "common/run/log.hpp"

namespace toryu::solid {

static_assert(dim == 2, "the table has two coordinates");

namespace {

constexpr std::size_t warned_one_by_one = 5;

std::string table(const std::vector<DetachedParticle>& particles) {
  std::string text = fmt::format("{}\n", fmt::join(DetachedList::columns().names, ","));
  for (const auto& p : particles)
    text += fmt::format("{},{},{},{},{},{},{}\n", p.time, p.particle, p.mass, p.start[0], p.start[1],
                        p.position[0], p.position[1]);
  return text;
}

}  // namespace

SeriesColumns DetachedList::columns() {
  return {"detached.csv",
          {"time[s]", "particle[1]", "mass[kg/m]", "start_x[m]", "start_y[m]", "x[m]", "y[m]"}};
}

DetachedList::DetachedList(const std::filesystem::path& out) : path_(out / "detached.csv") {
  std::filesystem::create_directories(out);
}

void DetachedList::write(const std::vector<DetachedParticle>& all) {
  write_atomically(path_, table(all));
  for (; warned_ < std::min(all.size(), warned_one_by_one); ++warned_) {
    const auto& p = all[warned_];
    log::warn("particle {} of the solid has come off at t = {:.6g} s: {:.4g} kg/m from ({:.4g}, {:.4g}) m",
              p.particle, p.time, p.mass, p.start[0], p.start[1]);
  }
  if (all.size() > warned_ && all.size() >= 2 * warned_) {
    log::warn("{} particles of the solid have come off by t = {:.6g} s; detached.csv lists them", all.size(),
              all.back().time);
    warned_ = all.size();
  }
}

}  // namespace toryu::solid
