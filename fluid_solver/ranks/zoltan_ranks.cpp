#include "fluid_solver/ranks/zoltan_ranks.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

#include "fluid_solver/ranks/all_to_all.hpp"

namespace toryu::fluid {

namespace {

/// What Zoltan's callbacks see.
struct Own {
  const Particles& fluid;
  const std::vector<std::uint32_t>& places;
};

int count_own(void* data, int* fault) {
  *fault = ZOLTAN_OK;
  return static_cast<int>(static_cast<const Own*>(data)->places.size());
}

void list_own(void* data, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int, float*, int* fault) {
  const Own& own = *static_cast<const Own*>(data);
  for (std::size_t k = 0; k < own.places.size(); ++k) {
    global[k] = own.fluid.id[own.places[k]];
    local[k] = own.places[k];
  }
  *fault = ZOLTAN_OK;
}

int count_axes(void*, int* fault) {
  *fault = ZOLTAN_OK;
  return dim;
}

void give_positions(void* data, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int, double* x,
                    int* fault) {
  const Own& own = *static_cast<const Own*>(data);
  for (int k = 0; k < count; ++k)
    for (int a = 0; a < dim; ++a) x[k * dim + a] = own.fluid.x[a][local[k]];
  *fault = ZOLTAN_OK;
}

void check(int code, const char* what) {
  if (code != ZOLTAN_OK && code != ZOLTAN_WARN) throw std::runtime_error(what);
}

/// Calls visit(component) for each plain field that a particle takes with it.
template <class Fluid, class Visit>
void for_each_carried(Fluid& fluid, Visit&& visit) {
  for_each_field(fluid, [&](auto& field) {
    if (field.kind == FieldKind::state)
      for_each_component(field, [&](Field& component) {
        if (!component.empty()) visit(component);
      });
  });
}

/// The state of the particles at `places`, field by field, after the owner, the place in the whole fluid and
/// the number of each.
void pack(Particles& fluid, const VecField* beside, const std::vector<std::uint32_t>& places,
          const std::vector<int>& owners, const std::vector<std::uint32_t>& place_in_whole,
          std::vector<double>& message) {
  message.push_back(static_cast<double>(places.size()));
  message.insert(message.end(), owners.begin(), owners.end());
  for (const auto i : places) message.push_back(place_in_whole[i]);
  for (const auto i : places) message.push_back(fluid.id[i]);
  const auto add = [&](const Field& component) {
    for (const auto i : places) message.push_back(component[i]);
  };
  for_each_carried(fluid, add);
  for (int a = 0; beside && a < dim; ++a) add((*beside)[a]);
}

/// What `pack` has made of the particles of all ranks becomes `fluid`, in the order of the whole.
void unpack(const std::vector<std::vector<double>>& messages, Particles& fluid, VecField* beside,
            std::vector<int>& owners, std::vector<std::uint32_t>& place_in_whole) {
  struct Entry {
    double place_in_whole;
    std::size_t message, number;
  };
  std::vector<Entry> order;
  for (std::size_t r = 0; r < messages.size(); ++r) {
    const std::size_t count = messages[r].empty() ? 0 : static_cast<std::size_t>(messages[r][0]);
    for (std::size_t k = 0; k < count; ++k) order.push_back({messages[r][1 + count + k], r, k});
  }
  std::sort(order.begin(), order.end(),
            [](const Entry& a, const Entry& b) { return a.place_in_whole < b.place_in_whole; });
  // the value in column `c` of the messages
  const auto value = [&](const Entry& entry, std::size_t c) {
    const std::vector<double>& message = messages[entry.message];
    return message[1 + c * static_cast<std::size_t>(message[0]) + entry.number];
  };
  fluid.count = order.size();
  fluid.id.clear();
  owners.clear();
  place_in_whole.clear();
  resize_present_fields(fluid, padded(std::max<std::size_t>(fluid.count, 1)));  // without values: absent
  for (const Entry& entry : order) {
    owners.push_back(static_cast<int>(value(entry, 0)));
    place_in_whole.push_back(static_cast<std::uint32_t>(value(entry, 1)));
    fluid.id.push_back(static_cast<std::uint32_t>(value(entry, 2)));
  }
  std::size_t c = 3;
  const auto take = [&](Field& component) {
    for (std::size_t i = 0; i < order.size(); ++i) component[i] = value(order[i], c);
    ++c;
  };
  for_each_carried(fluid, take);
  if (beside) resize(*beside, fluid.rho.size());
  for (int a = 0; beside && a < dim; ++a) take((*beside)[a]);
}

void sort_and_thin(std::vector<std::uint32_t>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// What any rank has, on every rank.
std::vector<std::uint32_t> sorted_of_all(const std::vector<std::uint32_t>& values, MPI_Comm communicator) {
  int size = 1;
  MPI_Comm_size(communicator, &size);
  std::vector<std::uint32_t> found;
  for (const auto& of_rank : all_to_all(std::vector(static_cast<std::size_t>(size), values), communicator))
    found.insert(found.end(), of_rank.begin(), of_rank.end());
  sort_and_thin(found);
  return found;
}

}  // namespace

ZoltanRanks::ZoltanRanks(MPI_Comm communicator) : communicator_(communicator) {
  float version = 0;
  check(Zoltan_Initialize(0, nullptr, &version), "Zoltan does not start");
  MPI_Comm_rank(communicator_, &rank_);
  MPI_Comm_size(communicator_, &size_);
  zoltan_.reset(Zoltan_Create(communicator_));
  for (const auto& [name, value] : {std::pair{"DEBUG_LEVEL", "0"},  // before it says what it does
                                    {"LB_METHOD", "RCB"},
                                    {"KEEP_CUTS", "1"},
                                    {"RETURN_LISTS", "NONE"},
                                    {"NUM_GID_ENTRIES", "1"},
                                    {"NUM_LID_ENTRIES", "1"}})
    check(Zoltan_Set_Param(zoltan_.get(), name, value), name);
}

double ZoltanRanks::largest(double value) const {
  double found = value;
  MPI_Allreduce(&value, &found, 1, MPI_DOUBLE, MPI_MAX, communicator_);
  return found;
}

double ZoltanRanks::largest(const Field& values) const {
  double found = -std::numeric_limits<double>::infinity();
  for (const auto i : own_) found = std::max(found, values[i]);
  return largest(found);
}

bool ZoltanRanks::is_balanced() const {
  const auto own = static_cast<double>(own_.size());
  double sum = 0;
  MPI_Allreduce(&own, &sum, 1, MPI_DOUBLE, MPI_SUM, communicator_);  // whole numbers: exact
  return largest(own) * size_ <= (1 + bearable_imbalance) * sum;
}

void ZoltanRanks::balance(const Particles& fluid) {
  Own own{fluid, own_};
  Zoltan_Struct* zoltan = zoltan_.get();
  check(Zoltan_Set_Num_Obj_Fn(zoltan, count_own, &own), "number");
  check(Zoltan_Set_Obj_List_Fn(zoltan, list_own, &own), "list");
  check(Zoltan_Set_Num_Geom_Fn(zoltan, count_axes, &own), "axes");
  check(Zoltan_Set_Geom_Multi_Fn(zoltan, give_positions, &own), "positions");
  int changes = 0, global_entries = 0, local_entries = 0, imports = 0, exports = 0;
  ZOLTAN_ID_PTR import_ids = nullptr, import_places = nullptr, export_ids = nullptr, export_places = nullptr;
  int *import_ranks = nullptr, *import_parts = nullptr, *export_ranks = nullptr, *export_parts = nullptr;
  check(Zoltan_LB_Partition(zoltan, &changes, &global_entries, &local_entries, &imports, &import_ids,
                            &import_places, &import_ranks, &import_parts, &exports, &export_ids,
                            &export_places, &export_ranks, &export_parts),
        "Zoltan finds no cuts");
  ++balancings_;
}

int ZoltanRanks::owner_of(const Vec& x) const {
  if (size_ == 1) return 0;  // Zoltan keeps no cuts for one
  double point[3] = {x[0], x[1], 0};
  int owner = 0, part = 0;
  check(Zoltan_LB_Point_PP_Assign(zoltan_.get(), point, &owner, &part), "a place without an owner");
  return owner;
}

std::vector<std::size_t> ZoltanRanks::ranks_near(const Vec& x, double depth,
                                                 const std::vector<Vec>& shifts) const {
  if (size_ == 1) return {0};
  std::vector<std::size_t> found;
  std::vector<int> near(static_cast<std::size_t>(size_)), parts(near);
  for (const Vec& shift : shifts) {
    const Vec low = x + shift - Vec::Constant(depth), high = x + shift + Vec::Constant(depth);
    int count = 0, part_count = 0;
    check(Zoltan_LB_Box_PP_Assign(zoltan_.get(), low[0], low[1], 0, high[0], high[1], 0, near.data(), &count,
                                  parts.data(), &part_count),
          "a place without ranks near it");
    for (int k = 0; k < count; ++k)
      found.push_back(static_cast<std::size_t>(near[static_cast<std::size_t>(k)]));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

void ZoltanRanks::divide(Particles& fluid, double depth, const std::vector<Vec>& shifts, VecField* beside) {
  const auto ranks = static_cast<std::size_t>(size_);
  if (!divided_) {  // any share of the whole will do to find cuts
    own_.clear();
    for (std::size_t i = static_cast<std::size_t>(rank_); i < fluid.count; i += ranks)
      own_.push_back(static_cast<std::uint32_t>(i));
    place_in_whole_.resize(fluid.count);
    std::iota(place_in_whole_.begin(), place_in_whole_.end(), 0u);
  }
  if (balancings_ == 0 || !is_balanced()) balance(fluid);
  std::vector<std::vector<std::uint32_t>> there(ranks);
  std::vector<std::vector<int>> owners(ranks);
  for (const auto i : own_) {
    const Vec x = at(fluid.x, i);
    const int owner = owner_of(x);
    for (const std::size_t r : ranks_near(x, depth, shifts)) {
      there[r].push_back(i);
      owners[r].push_back(owner);
    }
  }
  std::vector<std::vector<double>> messages(ranks);
  for (std::size_t r = 0; r < ranks; ++r)
    if (!there[r].empty()) pack(fluid, beside, there[r], owners[r], place_in_whole_, messages[r]);
  unpack(all_to_all(messages, communicator_), fluid, beside, owners_, place_in_whole_);
  held_ = fluid.id;
  divided_ = true;
}

void ZoltanRanks::find(const Particles& fluid) {
  const auto ranks = static_cast<std::size_t>(size_);
  std::unordered_map<std::uint32_t, std::uint32_t> place_of;  // by number
  for (std::size_t i = 0; i < fluid.count; ++i) place_of[fluid.id[i]] = static_cast<std::uint32_t>(i);
  std::vector<std::vector<std::uint32_t>> wanted(ranks);  // numbers, by owner
  std::vector<std::uint32_t> places_before(fluid.count);
  own_.clear();
  ghosts_here_.assign(ranks, {});
  for (std::size_t k = 0; k < fluid.count; ++k) {
    const std::uint32_t i = place_of.at(held_[k]);
    places_before[i] = place_in_whole_[k];
    if (owners_[k] == rank_) {
      own_.push_back(i);
      continue;
    }
    wanted[static_cast<std::size_t>(owners_[k])].push_back(held_[k]);
    ghosts_here_[static_cast<std::size_t>(owners_[k])].push_back(i);
  }
  place_in_whole_ = std::move(places_before);
  ghosts_there_ = all_to_all(wanted, communicator_);
  for (auto& numbers : ghosts_there_)
    for (auto& number : numbers) number = place_of.at(number);
}

/// Finds the places in the whole fluid, as it is sorted now: each rank sorts the particles of some strips.
void ZoltanRanks::number(const Particles& fluid, const StripOrder& strips) {
  const auto ranks = static_cast<std::size_t>(size_);
  double first = std::numeric_limits<double>::infinity(), last = -first;
  const auto strip_of = [&](std::uint32_t i) {
    return static_cast<double>(strips.place(fluid.x[0][i], fluid.x[1][i]).first);
  };
  for (const auto i : own_) first = std::min(first, strip_of(i)), last = std::max(last, strip_of(i));
  first = -largest(-first), last = largest(last);
  using Key = std::array<double, 3>;  // strip, along it, place before
  std::vector<std::vector<double>> keys(ranks);
  std::vector<std::vector<std::uint32_t>> asked(ranks);
  for (const auto i : own_) {
    const auto r = static_cast<std::size_t>((strip_of(i) - first) * size_ / (last - first + 1));
    const double along = strips.place(fluid.x[0][i], fluid.x[1][i]).second;
    keys[r].insert(keys[r].end(), {strip_of(i), along, static_cast<double>(place_in_whole_[i])});
    asked[r].push_back(i);
  }
  const auto received = all_to_all(keys, communicator_);
  std::vector<std::pair<Key, std::uint32_t*>> order;
  std::vector<std::vector<std::uint32_t>> answers(ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    answers[r].resize(received[r].size() / 3);
    for (std::size_t k = 0; k < answers[r].size(); ++k)
      order.push_back({{received[r][3 * k], received[r][3 * k + 1], received[r][3 * k + 2]}, &answers[r][k]});
  }
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  const auto count = static_cast<std::uint32_t>(order.size());
  std::uint32_t before = 0;  // on lower ranks
  MPI_Exscan(&count, &before, 1, MPI_UINT32_T, MPI_SUM, communicator_);
  if (rank_ == 0) before = 0;  // MPI leaves it undefined there
  for (const auto& [key, answer] : order) *answer = before++;
  const auto places = all_to_all(answers, communicator_);
  for (std::size_t r = 0; r < ranks; ++r)
    for (std::size_t k = 0; k < places[r].size(); ++k) place_in_whole_[asked[r][k]] = places[r][k];
}

void ZoltanRanks::share(const std::vector<Field*>& fields) const {
  const auto ranks = static_cast<std::size_t>(size_);
  std::vector<std::vector<double>> messages(ranks);
  for (std::size_t r = 0; r < ranks; ++r)
    for (const Field* field : fields)
      for (const auto i : ghosts_there_[r]) messages[r].push_back((*field)[i]);
  const auto received = all_to_all(messages, communicator_);
  for (std::size_t r = 0; r < ranks; ++r) {
    auto value = received[r].begin();
    for (Field* field : fields)
      for (const auto i : ghosts_here_[r]) (*field)[i] = *value++;
  }
}

/// Of the particles of a boundary whose place is in the part of this rank, those that have fluid near them.
std::vector<std::uint32_t> ZoltanRanks::own_of(const Boundary& boundary) const {
  std::vector<std::uint32_t> own;
  for (const auto c : boundary.list_for_wall.active())
    for (std::size_t w = c * lane_count; w < std::min((c + 1) * lane_count, boundary.count); ++w) {
      if (owner_of(at(boundary.x, w)) == rank_) own.push_back(static_cast<std::uint32_t>(w));
    }
  return own;
}

/// `near`: who is near the interface, in order.
Renewal ZoltanRanks::renewal(const std::vector<std::uint32_t>& near) const {
  std::vector<std::uint32_t> clusters;
  for (const auto i : own_)  // of a ghost the place is not known
    if (std::binary_search(near.begin(), near.end(), i)) clusters.push_back(place_in_whole_[i] / lane_count);
  clusters = sorted_of_all(clusters, communicator_);
  Renewal found;
  for (const auto i : own_)
    if (std::binary_search(clusters.begin(), clusters.end(), place_in_whole_[i] / lane_count))
      found.clusters.push_back(i / lane_count);
  sort_and_thin(found.clusters);
  for (const auto i : own_)
    if (std::binary_search(found.clusters.begin(), found.clusters.end(), i / lane_count) &&
        !std::binary_search(clusters.begin(), clusters.end(), place_in_whole_[i] / lane_count))
      found.kept.push_back(i);
  return found;
}

void ZoltanRanks::note_lists(const Particles& fluid, const std::vector<Boundary>& boundaries,
                             const std::vector<std::uint32_t>& near_interface) {
  std::vector<std::uint32_t> places;
  for (const auto i : own_) places.push_back(place_in_whole_[i]);
  whole_ = Gatherer(communicator_, own_, places);
  masses_.assign(padded(whole_.places().size()), 0.0);
  whole_.gather({&fluid.m}, {&masses_});
  beside_walls_ = BesideWalls(communicator_, fluid, boundaries, own_, place_in_whole_);
  renewal_ = renewal(near_interface);
  at_walls_.clear();
  for (const Boundary& boundary : boundaries) {
    const auto own = own_of(boundary);
    at_walls_.emplace_back(communicator_, own, own);
  }
}

}  // namespace toryu::fluid
