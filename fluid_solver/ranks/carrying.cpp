#include "fluid_solver/ranks/carrying.hpp"

#include <algorithm>

namespace toryu::fluid {

namespace {

/// Calls visit(component) for each plain field that a particle takes with it.
template <class Visit>
void for_each_carried(Particles& fluid, Visit&& visit) {
  for_each_field(fluid, [&](auto& field) {
    if (field.kind == FieldKind::state)
      for_each_component(field, [&](Field& component) {
        if (!component.empty()) visit(component);
      });
  });
}

/// A particle of the fluid that is joined: the `number`-th of a message, or that at the place `number`.
struct Entry {
  std::uint32_t place_in_whole, number;
  std::uint32_t message;
};
constexpr std::uint32_t none = ~0u;  ///< the message of those that were kept

/// Column `c` of a message: after the number of particles the places, the numbers, field by field.
const double* column(const std::vector<double>& message, std::size_t c) {
  return message.data() + 1 + c * static_cast<std::size_t>(message[0]);
}

std::vector<Entry> entries(const std::vector<std::uint32_t>& kept,
                           const std::vector<std::vector<double>>& messages,
                           const std::vector<std::uint32_t>& place_in_whole) {
  std::size_t count_of_all = kept.size();
  for (const auto& message : messages)
    if (!message.empty()) count_of_all += static_cast<std::size_t>(message[0]);
  std::vector<Entry> all;
  all.reserve(count_of_all);
  for (const auto i : kept) all.push_back({place_in_whole[i], i, none});
  for (std::size_t r = 0; r < messages.size(); ++r) {
    if (messages[r].empty()) continue;
    const auto before = static_cast<std::ptrdiff_t>(all.size());
    const auto count = static_cast<std::uint32_t>(messages[r][0]);
    for (std::uint32_t k = 0; k < count; ++k)
      all.push_back(
          {static_cast<std::uint32_t>(column(messages[r], 0)[k]), k, static_cast<std::uint32_t>(r)});
    std::inplace_merge(all.begin(), all.begin() + before, all.end(),
                       [](const Entry& a, const Entry& b) { return a.place_in_whole < b.place_in_whole; });
  }
  return all;
}

}  // namespace

std::vector<double> packed_particles(Particles& fluid, const VecField* beside,
                                     const std::vector<std::uint32_t>& places,
                                     const std::vector<std::uint32_t>& place_in_whole) {
  if (places.empty()) return {};
  std::vector<double> message{static_cast<double>(places.size())};
  std::size_t columns = beside ? 2 + dim : 2;
  for_each_carried(fluid, [&](const Field&) { ++columns; });
  message.reserve(1 + columns * places.size());
  for (const auto i : places) message.push_back(place_in_whole[i]);
  for (const auto i : places) message.push_back(fluid.id[i]);
  const auto add = [&](const Field& component) {
    for (const auto i : places) message.push_back(component[i]);
  };
  for_each_carried(fluid, add);
  for (int a = 0; beside && a < dim; ++a) add((*beside)[a]);
  return message;
}

Joined join(Particles& fluid, VecField* beside, const std::vector<std::uint32_t>& kept,
            const std::vector<std::vector<double>>& messages, std::vector<std::uint32_t>& place_in_whole) {
  const std::vector<Entry> all = entries(kept, messages, place_in_whole);
  Joined joined{.received = std::vector<std::vector<std::uint32_t>>(messages.size())};
  for (std::size_t r = 0; r < messages.size(); ++r)
    if (!messages[r].empty()) joined.received[r].resize(static_cast<std::size_t>(messages[r][0]));
  std::vector<std::uint32_t> id(all.size());
  joined.kept.reserve(kept.size());
  place_in_whole.resize(all.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const auto& [place, number, message] = all[i];
    place_in_whole[i] = place;
    id[i] =
        message == none ? fluid.id[number] : static_cast<std::uint32_t>(column(messages[message], 1)[number]);
    if (message == none)
      joined.kept.push_back(i);
    else
      joined.received[message][number] = i;
  }
  fluid.id.swap(id);
  fluid.count = all.size();
  const std::size_t size = padded(std::max<std::size_t>(fluid.count, 1));  // without values: absent
  std::size_t c = 2;
  const auto take = [&](Field& component) {
    Field values(size);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto& [place, number, message] = all[i];
      values[i] = message == none ? component[number] : column(messages[message], c)[number];
    }
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(fluid.count), values.end(),
              fluid.count > 0 ? values[fluid.count - 1] : 0.0);
    component.swap(values);
    ++c;
  };
  for_each_carried(fluid, take);
  for (int a = 0; beside && a < dim; ++a) take((*beside)[a]);
  std::fill(fluid.m.begin() + static_cast<std::ptrdiff_t>(fluid.count), fluid.m.end(), 0.0);  // idle lanes
  for_each_field(fluid, [&](auto& field) {  // anew, or they would keep the room of the whole fluid
    if (field.kind != FieldKind::state)
      for_each_component(field, [&](Field& component) {
        if (!component.empty()) component = Field(size);
      });
  });
  return joined;
}

}  // namespace toryu::fluid
