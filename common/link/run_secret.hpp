/// What only the processes of one run know: who cannot read their results folder can neither meet them nor
/// speak as one of them.
#pragma once

#include <cstdint>
#include <filesystem>

namespace toryu {

struct RunSecret {
  std::uint64_t name;  ///< of the run among others, told to all on the same network
  std::uint64_t key;   ///< of the seals of its messages, told to nobody
};

/// The secret of the run whose results lie in `out`, in its file `run.secret`, which only its owner can read.
/// Who asks first makes it, and the folder. Throws MachineFailure if that fails.
RunSecret run_secret(const std::filesystem::path& out);

/// Whether the folder has a secret already.
bool has_run_secret(const std::filesystem::path& out);

/// Ends a run: the next one in `out` gets another secret.
void forget_run_secret(const std::filesystem::path& out) noexcept;

}  // namespace toryu
