#include "solid_solver/detachment.hpp"

#include <cmath>

#include "common/sph/sorted_points.hpp"

namespace toryu::solid {

DetachmentObserver::DetachmentObserver(const Body& body, const Parameters& parameters)
    : body_(&body),
      bond_length_(parameters.detachment->bond_length > 0 ? parameters.detachment->bond_length * body.spacing
                                                          : 2.0 * parameters.h()),
      interval_(parameters.detachment->interval) {}

DetachmentObserver::State DetachmentObserver::start() const {
  State state;
  state.detached.resize(body_->size());
  state.ever_detached.resize(body_->size());
  return state;
}

std::vector<char> DetachmentObserver::reached_from_clamps(const std::vector<Vec>& x) const {
  const SortedPoints points(x, bond_length_);
  std::vector<char> reached(body_->held);
  std::vector<std::uint32_t> front;
  for (std::uint32_t i = 0; i < x.size(); ++i)
    if (reached[i]) front.push_back(i);
  while (!front.empty()) {
    std::vector<std::uint32_t> next;
    for (const auto i : front)
      points.near(x[i], bond_length_, [&](std::uint32_t j) {
        if (reached[j]) return;
        reached[j] = 1;
        next.push_back(j);
      });
    front.swap(next);
  }
  return reached;
}

bool DetachmentObserver::record(State& state, const std::vector<Vec>& x, double time) const {
  state.next = (std::floor(time / interval_ + 1e-9) + 1) * interval_;
  const auto reached = reached_from_clamps(x);
  const std::size_t before = state.list.size();
  for (std::uint32_t i = 0; i < x.size(); ++i) {
    state.detached[i] = !reached[i];
    if (!state.detached[i] || state.ever_detached[i]) continue;
    state.ever_detached[i] = 1;
    state.list.push_back({i, time, body_->mass(i), body_->X[i], x[i]});
  }
  return state.list.size() > before;
}

}  // namespace toryu::solid
