#include "coupler/interface_record.hpp"

namespace toryu::coupling {

InterfaceRecord::InterfaceRecord(const std::filesystem::path& out, const Interface& interface)
    : file_(out / "interface.h5") {
  const hsize_t count = interface.size();
  file_.constant("id", "1", {count}, std::span(interface.id));
  file_.constant("reference_position", "m", {count, dim}, interface.position);
  file_.constant("volume", "m2", {count}, interface.volume);
  file_.constant("area_vector", "m", {count, dim}, interface.area_vector);
  file_.series("time", "s", {});
  file_.series("position", "m", {count, dim});
  file_.series("velocity", "m/s", {count, dim});
  file_.series("pressure", "Pa", {count});
  file_.series("force", "N/m", {count, dim});
  file_.series("friction_force", "N/m", {count, dim});
}

void InterfaceRecord::write(double time, const InterfaceMotion& motion, const InterfaceLoad& load) {
  const std::vector<double> none(motion.position.size(), 0.0);
  const auto row = [&](const std::vector<double>& values) {
    return values.empty() ? none.data() : values.data();
  };
  file_.append({&time, motion.position.data(), motion.velocity.data(), row(load.pressure), row(load.force),
                row(load.friction_force)});
}

}  // namespace toryu::coupling
