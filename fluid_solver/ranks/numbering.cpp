#include "fluid_solver/ranks/numbering.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "fluid_solver/ranks/all_to_all.hpp"

namespace toryu::fluid {

namespace {

/// Of a particle by which it is sorted.
struct Key {
  double along;  ///< its strip [m]
  std::int32_t strip;
  std::uint32_t place_before;
  std::uint32_t number;  ///< of those that one rank sorts, as they came
  bool operator<(const Key& other) const {
    return std::tie(strip, along, place_before) < std::tie(other.strip, other.along, other.place_before);
  }
};

/// Strips of all ranks, and who sorts which.
struct Shares {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  int size = 1;

  Shares(MPI_Comm communicator, const std::vector<Key>& keys) {
    MPI_Comm_size(communicator, &size);
    if (!keys.empty()) first = keys.front().strip, last = keys.back().strip;
    double ends[2] = {-first, last};
    MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_DOUBLE, MPI_MAX, communicator);
    first = -ends[0], last = ends[1];
  }
  std::size_t rank_of(std::int32_t strip) const {
    return static_cast<std::size_t>((strip - first) * size / (last - first + 1));
  }
};

}  // namespace

void number(MPI_Comm communicator, const Particles& fluid, const StripOrder& strips,
            const std::vector<std::uint32_t>& own, std::vector<std::uint32_t>& place_in_whole) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  std::vector<Key> keys;  // of the own particles; then of those that this rank sorts
  keys.reserve(own.size());
  for (const auto i : own) {
    const auto [strip, along] = strips.place(fluid.x[0][i], fluid.x[1][i]);
    keys.push_back({along, static_cast<std::int32_t>(strip), place_in_whole[i], 0});
  }
  const Shares shares(communicator, keys);
  const auto ranks = static_cast<std::size_t>(shares.size), here = static_cast<std::size_t>(rank);
  // Keys of one rank are in order, and so are the ranks that sort them.
  std::vector<std::vector<double>> messages(ranks);
  std::vector<std::size_t> begin(ranks + 1, keys.size());
  for (std::size_t k = keys.size(); k-- > 0;) begin[shares.rank_of(keys[k].strip)] = k;
  for (std::size_t r = ranks; r-- > 0;) begin[r] = std::min(begin[r], begin[r + 1]);
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (const std::size_t r = shares.rank_of(keys[k].strip); r != here)
      messages[r].insert(messages[r].end(), {static_cast<double>(keys[k].strip), keys[k].along,
                                             static_cast<double>(keys[k].place_before)});
  keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(begin[here + 1]), keys.end());
  keys.erase(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(begin[here]));
  const auto count_here = static_cast<std::uint32_t>(keys.size());
  std::uint32_t count = 0;
  for (Key& key : keys) key.number = count++;
  const auto received = all_to_all(messages, communicator);
  for (const auto& of_rank : received) {
    const auto middle = static_cast<std::ptrdiff_t>(keys.size());
    for (std::size_t k = 0; k < of_rank.size(); k += 3)
      keys.push_back({of_rank[k + 1], static_cast<std::int32_t>(of_rank[k]),
                      static_cast<std::uint32_t>(of_rank[k + 2]), count++});
    std::inplace_merge(keys.begin(), keys.begin() + middle, keys.end());
  }
  std::uint32_t place = 0;  // of the first that this rank sorts
  MPI_Exscan(&count, &place, 1, MPI_UINT32_T, MPI_SUM, communicator);
  if (rank == 0) place = 0;  // MPI leaves it undefined there
  std::vector<std::uint32_t> places(count);
  for (const Key& key : keys) places[key.number] = place++;
  std::vector<std::vector<std::uint32_t>> answers(ranks);
  auto next = places.begin() + count_here;
  for (std::size_t r = 0; r < ranks; ++r) {
    const auto of_rank = static_cast<std::ptrdiff_t>(received[r].size() / 3);
    answers[r].assign(next, next + of_rank);
    next += of_rank;
  }
  const auto told = all_to_all(answers, communicator);
  for (std::size_t r = 0; r < ranks; ++r)
    for (std::size_t k = begin[r]; k < begin[r + 1]; ++k)
      place_in_whole[own[k]] = r == here ? places[k - begin[r]] : told[r][k - begin[r]];
}

}  // namespace toryu::fluid
