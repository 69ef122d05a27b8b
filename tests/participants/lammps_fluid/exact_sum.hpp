/// Sums that have the same bits in whatever order, and over however many ranks, their parts are added.
#pragma once

#include <mpi.h>

#include <array>
#include <cmath>
#include <vector>

namespace toryu::lammps_fluid {

/// Sums of `count` values as whole multiples of 2^-80: parts are cut there, and sums below 2^47 are exact.
template <std::size_t count>
class ExactSums {
 public:
  void add(std::size_t k, double part) { sums_[k] += static_cast<Whole>(std::ldexp(part, digits)); }
  /// Of all ranks, on each of them.
  std::array<double, count> total() const {
    int ranks = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    std::vector<std::array<Whole, count>> all(static_cast<std::size_t>(ranks));
    MPI_Allgather(sums_.data(), sizeof sums_, MPI_BYTE, all.data(), sizeof sums_, MPI_BYTE, MPI_COMM_WORLD);
    std::array<double, count> total{};
    for (std::size_t k = 0; k < count; ++k) {
      Whole sum = 0;
      for (const auto& rank : all) sum += rank[k];
      total[k] = std::ldexp(static_cast<double>(sum), -digits);
    }
    return total;
  }

 private:
  __extension__ using Whole = __int128;
  static constexpr int digits = 80;
  std::array<Whole, count> sums_{};
};

}  // namespace toryu::lammps_fluid
