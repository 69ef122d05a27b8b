/// The seal of a message: a check sum of all that it says, keyed with the secret of the run (run_secret.hpp).
/// A bit that was flipped on the way breaks it, and who does not know the secret cannot make it.
#pragma once

#include <cstdint>

#include "messages.h"

namespace toryu::dds {

/// Of every field but `seal` itself: XXH3 of 64 bits with `secret` as its seed.
std::uint64_t seal_of(const toryu_Hello& message, std::uint64_t secret);
std::uint64_t seal_of(const toryu_Session& message, std::uint64_t secret);
std::uint64_t seal_of(const toryu_Status& message, std::uint64_t secret);
std::uint64_t seal_of(const toryu_Interface& message, std::uint64_t secret);
std::uint64_t seal_of(const toryu_Motion& message, std::uint64_t secret);
std::uint64_t seal_of(const toryu_Load& message, std::uint64_t secret);
std::uint64_t seal_of(const toryu_CheckpointRequest& message, std::uint64_t secret);
std::uint64_t seal_of(const toryu_CheckpointReport& message, std::uint64_t secret);

}  // namespace toryu::dds
