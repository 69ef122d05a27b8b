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
  std::vector<double> message;
  message.reserve(part.size() * items_.size());
  for (const Field* field : part)
    for (const auto item : items_) message.push_back((*field)[item]);
  std::vector<int> counts = counts_;
  for (int& count : counts) count *= static_cast<int>(part.size());
  std::vector<double> received(part.size() * places_.size());
  MPI_Gatherv(message.data(), static_cast<int>(message.size()), MPI_DOUBLE, received.data(), counts.data(),
              sums_before(counts).data(), MPI_DOUBLE, 0, communicator_);
  auto value = received.begin();
  auto first = places_.begin();
  for (const int count : counts_) {  // rank by rank, field by field
    for (Field* field : whole)
      for (auto place = first; place != first + count; ++place) (*field)[*place] = *value++;
    first += count;
  }
}

}  // namespace toryu::fluid
