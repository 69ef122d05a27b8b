// The reference loop of studies with [timing]: a fixed amount of work like that of the solvers, sums over the
// pairs of a lattice with the gradient of the cubic spline (Monaghan & Lattanzio 1985), in double precision
// on one thread. It prints the seconds it takes, of the processor and by the clock. Times of earlier studies
// are in its units, so it stays as it is: it shares no code with the solvers, whose speed changes.

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

namespace {

constexpr int side = 96;    // particles on a side of the lattice
constexpr int reach = 2;    // rows and columns within the kernel's support, 2 h
constexpr double h = 1.25;  // smoothing length in spacings
constexpr int passes = 160;
constexpr double pi = 3.14159265358979323846;

struct Lattice {
  std::vector<double> x, y, rho, p;
};

Lattice make_lattice() {
  Lattice lattice;
  for (int i = 0; i < side * side; ++i) {
    // Out of place by up to a tenth of the spacing, the same way each time.
    const int column = i % side, row = i / side;
    lattice.x.push_back(column + 0.1 * std::sin(12.9898 * i));
    lattice.y.push_back(row + 0.1 * std::sin(78.233 * i));
    lattice.rho.push_back(1.0 + 0.01 * std::sin(0.1 * i));
    lattice.p.push_back(0.0);
  }
  return lattice;
}

// W'(r)/r of the cubic spline in two dimensions.
double kernel_slope(double r) {
  const double q = r / h;
  const double sigma = 10.0 / (7.0 * pi * h * h);
  if (q >= 2.0) return 0.0;
  return sigma * (q < 1.0 ? -3.0 + 2.25 * q : -0.75 * (2.0 - q) * (2.0 - q) / q) / (h * h);
}

// One evaluation of the pressure force on every particle; the density follows a little, so that no pass can
// be left out.
void pass(Lattice& lattice) {
  for (std::size_t i = 0; i < lattice.p.size(); ++i) lattice.p[i] = lattice.rho[i] - 1.0;
  std::vector<double> change(lattice.p.size(), 0.0);
  for (int row = reach; row < side - reach; ++row) {
    for (int column = reach; column < side - reach; ++column) {
      const auto i = static_cast<std::size_t>(row * side + column);
      std::array<double, 2> a_i{};
      for (int m = -reach; m <= reach; ++m) {
        for (int n = -reach; n <= reach; ++n) {
          if (m == 0 && n == 0) continue;
          const auto j = static_cast<std::size_t>((row + m) * side + column + n);
          const double x_ij = lattice.x[i] - lattice.x[j], y_ij = lattice.y[i] - lattice.y[j];
          const double slope = kernel_slope(std::sqrt(x_ij * x_ij + y_ij * y_ij));
          const double f = lattice.p[i] / (lattice.rho[i] * lattice.rho[i]) +
                           lattice.p[j] / (lattice.rho[j] * lattice.rho[j]);
          a_i[0] -= f * slope * x_ij;
          a_i[1] -= f * slope * y_ij;
        }
      }
      change[i] = 1e-3 * (a_i[0] + a_i[1]);
    }
  }
  for (std::size_t i = 0; i < change.size(); ++i) lattice.rho[i] += change[i];
}

}  // namespace

int main() {
  Lattice lattice = make_lattice();
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t busy = std::clock();
  for (int k = 0; k < passes; ++k) pass(lattice);
  const double processor_time = static_cast<double>(std::clock() - busy) / CLOCKS_PER_SEC;
  const std::chrono::duration<double> wall_time = std::chrono::steady_clock::now() - begin;
  double sum = 0.0;
  for (const double rho : lattice.rho) sum += rho;
  std::printf("%.6f %.6f\n", processor_time, wall_time.count());
  return std::isfinite(sum) ? 0 : 1;
}
