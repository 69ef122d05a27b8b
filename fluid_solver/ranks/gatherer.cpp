#include "fluid_solver/ranks/gatherer.hpp"

#include <numeric>

namespace toryu::fluid {

namespace {

std::vector<int> sums_before(const std::vector<int>& counts) {
  std::vector<int> before(counts.size());
  std::exclusive_scan(counts.begin(), counts.end(), before.begin(), 0);
  return before;
}

}  // namespace

Gatherer::Gatherer(MPI_Comm communicator, std::vector<std::uint32_t> items,
                   const std::vector<std::uint32_t>& places)
    : communicator_(communicator), items_(std::move(items)) {
  int rank = 0, size = 1;
  MPI_Comm_rank(communicator_, &rank);
  MPI_Comm_size(communicator_, &size);
  const int count = static_cast<int>(items_.size());
  if (rank == 0) counts_.resize(static_cast<std::size_t>(size));
  MPI_Gather(&count, 1, MPI_INT, counts_.data(), 1, MPI_INT, 0, communicator_);
  places_.resize(static_cast<std::size_t>(std::accumulate(counts_.begin(), counts_.end(), 0)));
  MPI_Gatherv(places.data(), count, MPI_UINT32_T, places_.data(), counts_.data(), sums_before(counts_).data(),
              MPI_UINT32_T, 0, communicator_);
}

void Gatherer::gather(const std::vector<const Field*>& part, const std::vector<Field*>& whole) const {
  const std::vector<int> before = sums_before(counts_);
  std::vector<double> message(items_.size()), received(places_.size());
  for (std::size_t n = 0; n < part.size(); ++n) {  // one by one, for the memory
    for (std::size_t k = 0; k < items_.size(); ++k) message[k] = (*part[n])[items_[k]];
    MPI_Gatherv(message.data(), static_cast<int>(message.size()), MPI_DOUBLE, received.data(), counts_.data(),
                before.data(), MPI_DOUBLE, 0, communicator_);
    for (std::size_t k = 0; k < places_.size(); ++k) (*whole[n])[places_[k]] = received[k];
  }
}

}  // namespace toryu::fluid
