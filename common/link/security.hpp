/// DDS Security as Cyclone DDS has it: the plugins and files by which a participant proves itself, and who
/// was refused.
#pragma once

#include <dds/dds.h>

#include <string>

namespace toryu::dds {

/// Has a DDS participant prove itself by the identity of `part` in `folder`, and ask it of all others. Throws
/// MachineFailure where Cyclone DDS has no plugins for that.
void set_identity(dds_qos_t* participant, const std::string& folder, const std::string& part);

}  // namespace toryu::dds
