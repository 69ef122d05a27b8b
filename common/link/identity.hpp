/// What a program of a secured run proves itself by: a folder that `./run.sh --make-identities` made, with
/// the certificate of its CA (ca.pem), what protects the messages (governance.p7s), and of each part of the
/// run the certificate, the private key and what it may do (fluid.pem, fluid.key, fluid.p7s). A host needs
/// those of its own parts alone. Formats: OMG DDS Security 1.1, 8.4 and 9.4.
#pragma once

#include <ctime>
#include <limits>
#include <string>

#include "common/run/network.hpp"
#include "common/run/options.hpp"

namespace toryu {

/// The file of an identity that expires first, and when: no message passes from then on.
struct Expiry {
  std::string file = {};
  std::time_t time = std::numeric_limits<std::time_t>::max();
};
/// Throws BadInput if that is past or so near that only the last words still pass.
void check_expiry(const Expiry& expiry);

/// Throws BadInput with all that is wrong with the identity of `part` ("coupler", "fluid" or "solid") in the
/// folder of --secure: files that are missing or no such files, a key that others can read or that is not the
/// certificate's, a certificate of another part or CA, or that is not valid today. Nothing without --secure.
Expiry check_identity(const Network& network, const std::string& part);

/// The same of a solver under --check: in a run it looks at its identity as it joins. Where it computes alone
/// --secure is refused.
void check_secured(const Options& options, bool coupled, const std::string& part);

/// What a program shows of its identity, for the words by which it is refused: whose certificate it has, and
/// of which CA. Nothing without --secure, or where they cannot be read.
struct Credential {
  std::string part = {}, authority = {};
};
Credential credential_of(const Network& network, const std::string& part);

}  // namespace toryu
