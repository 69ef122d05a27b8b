#include "common/link/security.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "common/error/machine.hpp"

namespace toryu::dds {

namespace {

/// Where Debian keeps the plugins, and where a build of Cyclone DDS by hand does: by its library.
std::filesystem::path plugin(const std::string& name) {
  Dl_info library{};
  std::error_code error;
  if (dladdr(reinterpret_cast<void*>(&dds_create_participant), &library) == 0) library.dli_fname = "";
  const auto folder = std::filesystem::canonical(library.dli_fname, error).parent_path();
  for (const char* place : {"libddsc0debian", "."})
    if (auto path = folder / place / name; std::filesystem::exists(path, error)) return path;
  throw MachineFailure(
      fmt::format("--secure: Cyclone DDS has no plugins for security here: {} is not beside "
                  "its library in {}; they are in Debian's package libddsc0debian",
                  name, folder.string()));
}

}  // namespace

void set_identity(dds_qos_t* participant, const std::string& folder, const std::string& part) {
  const auto set = [&](const std::string& property, const std::string& value) {
    dds_qset_prop(participant, ("dds.sec." + property).c_str(), value.c_str());
  };
  const auto file = [&](const std::string& name) {
    return "file:" + std::filesystem::absolute(std::filesystem::path(folder) / name).string();
  };
  const auto load = [&](const std::string& kind, const std::string& name, const std::string& function) {
    set(kind + ".library.path", plugin("libdds_security_" + name + ".so").string());
    set(kind + ".library.init", "init_" + function);
    set(kind + ".library.finalize", "finalize_" + function);
  };
  load("auth", "auth", "authentication");
  load("access", "ac", "access_control");
  load("crypto", "crypto", "crypto");
  set("auth.identity_ca", file("ca.pem"));
  set("auth.identity_certificate", file(part + ".pem"));
  set("auth.private_key", file(part + ".key"));
  set("access.permissions_ca", file("ca.pem"));
  set("access.governance", file("governance.p7s"));
  set("access.permissions", file(part + ".p7s"));
}

}  // namespace toryu::dds
