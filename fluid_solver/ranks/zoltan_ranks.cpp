#include "fluid_solver/ranks/zoltan_ranks.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

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

/// The state of the particles at `places`, field by field, after their numbers and one `label` each.
void pack(Particles& fluid, const std::vector<std::uint32_t>& places, const std::vector<int>& labels,
          std::vector<double>& message) {
  message.push_back(static_cast<double>(places.size()));
  for (const auto i : places) message.push_back(fluid.id[i]);
  message.insert(message.end(), labels.begin(), labels.end());
  for_each_carried(fluid, [&](const Field& component) {
    for (const auto i : places) message.push_back(component[i]);
  });
}

/// What `pack` has made of the particles of all ranks becomes `fluid`, in the order of the numbers.
std::vector<int> unpack(const std::vector<std::vector<double>>& messages, Particles& fluid) {
  struct Place {
    std::uint32_t id;
    std::size_t message, entry;
  };
  std::vector<Place> order;
  for (std::size_t r = 0; r < messages.size(); ++r)
    for (std::size_t k = 0; !messages[r].empty() && k < static_cast<std::size_t>(messages[r][0]); ++k)
      order.push_back({static_cast<std::uint32_t>(messages[r][1 + k]), r, k});
  std::sort(order.begin(), order.end(), [](const Place& a, const Place& b) { return a.id < b.id; });
  // the value in column `c` of the messages
  const auto value = [&](const Place& place, std::size_t c) {
    const std::vector<double>& message = messages[place.message];
    return message[1 + c * static_cast<std::size_t>(message[0]) + place.entry];
  };
  std::vector<int> labels;
  fluid.count = order.size();
  fluid.id.clear();
  resize_present_fields(fluid,
                        padded(std::max<std::size_t>(fluid.count, 1)));  // empty ones would count as absent
  for (const Place& place : order) {
    fluid.id.push_back(place.id);
    labels.push_back(static_cast<int>(value(place, 1)));
  }
  std::size_t c = 2;
  for_each_carried(fluid, [&](Field& component) {
    for (std::size_t i = 0; i < order.size(); ++i) component[i] = value(order[i], c);
    ++c;
  });
  return labels;
}

}  // namespace

ZoltanRanks::ZoltanRanks(MPI_Comm communicator) : communicator_(communicator) {
  float version = 0;
  check(Zoltan_Initialize(0, nullptr, &version), "Zoltan does not start");
  MPI_Comm_rank(communicator_, &rank_);
  MPI_Comm_size(communicator_, &size_);
  zoltan_.reset(Zoltan_Create(communicator_));
  for (const auto& [name, value] : {std::pair{"LB_METHOD", "RCB"},
                                    {"KEEP_CUTS", "1"},
                                    {"RETURN_LISTS", "NONE"},
                                    {"DEBUG_LEVEL", "0"},
                                    {"NUM_GID_ENTRIES", "1"},
                                    {"NUM_LID_ENTRIES", "1"}})
    check(Zoltan_Set_Param(zoltan_.get(), name, value), name);
}

double ZoltanRanks::largest(double value) const {
  double found = value;
  MPI_Allreduce(&value, &found, 1, MPI_DOUBLE, MPI_MAX, communicator_);
  return found;
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

void ZoltanRanks::divide(Particles& fluid, double depth) {
  const auto ranks = static_cast<std::size_t>(size_);
  if (balancings_ == 0) {  // any share of the whole will do to find cuts
    own_.clear();
    for (std::size_t i = static_cast<std::size_t>(rank_); i < fluid.count; i += ranks)
      own_.push_back(static_cast<std::uint32_t>(i));
  }
  if (balancings_ == 0 || !is_balanced()) balance(fluid);
  std::vector<std::vector<std::uint32_t>> there(ranks);
  std::vector<std::vector<int>> owners(ranks);
  std::vector<int> near(ranks), parts(ranks);
  for (const auto i : own_) {
    double x[3] = {fluid.x[0][i], fluid.x[1][i], 0};
    int owner = 0, part = 0, count = 1, part_count = 1;
    near[0] = 0;
    if (size_ > 1) {  // Zoltan keeps no cuts for one
      check(Zoltan_LB_Point_PP_Assign(zoltan_.get(), x, &owner, &part), "a place without an owner");
      check(Zoltan_LB_Box_PP_Assign(zoltan_.get(), x[0] - depth, x[1] - depth, 0, x[0] + depth, x[1] + depth,
                                    0, near.data(), &count, parts.data(), &part_count),
            "a place without ranks near it");
    }
    for (int k = 0; k < count; ++k) {
      const auto r = static_cast<std::size_t>(near[static_cast<std::size_t>(k)]);
      there[r].push_back(i);
      owners[r].push_back(owner);
    }
  }
  std::vector<std::vector<double>> messages(ranks);
  for (std::size_t r = 0; r < ranks; ++r)
    if (!there[r].empty()) pack(fluid, there[r], owners[r], messages[r]);
  owners_ = unpack(all_to_all(messages, communicator_), fluid);
  ids_ = fluid.id;
}

std::vector<std::uint32_t> ZoltanRanks::places(const std::vector<std::uint32_t>& ids,
                                               const Particles& fluid) const {
  std::vector<std::uint32_t> place_of(ids_.size()), found;
  const auto number = [&](std::uint32_t id) {
    return static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin());
  };
  for (std::size_t i = 0; i < fluid.count; ++i) place_of[number(fluid.id[i])] = static_cast<std::uint32_t>(i);
  for (const auto id : ids) found.push_back(place_of[number(id)]);
  return found;
}

void ZoltanRanks::find(const Particles& fluid) {
  const auto ranks = static_cast<std::size_t>(size_);
  std::vector<std::vector<std::uint32_t>> wanted(ranks);
  std::vector<std::uint32_t> own;
  for (std::size_t k = 0; k < ids_.size(); ++k)
    (owners_[k] == rank_ ? own : wanted[static_cast<std::size_t>(owners_[k])]).push_back(ids_[k]);
  own_ = places(own, fluid);
  ghosts_here_.clear();
  ghosts_there_.clear();
  for (const auto& ids : all_to_all(wanted, communicator_)) ghosts_there_.push_back(places(ids, fluid));
  for (const auto& ids : wanted) ghosts_here_.push_back(places(ids, fluid));
}

void ZoltanRanks::share_rates(Particles& fluid) const {
  const auto ranks = static_cast<std::size_t>(size_);
  const std::array<Field*, dim + 1> rates{&fluid.a[0], &fluid.a[1], &fluid.drho};
  std::vector<std::vector<double>> messages(ranks);
  for (std::size_t r = 0; r < ranks; ++r)
    for (const Field* rate : rates)
      for (const auto i : ghosts_there_[r]) messages[r].push_back((*rate)[i]);
  const auto received = all_to_all(messages, communicator_);
  for (std::size_t r = 0; r < ranks; ++r) {
    auto value = received[r].begin();
    for (Field* rate : rates)
      for (const auto i : ghosts_here_[r]) (*rate)[i] = *value++;
  }
}

Particles ZoltanRanks::gather(const Particles& fluid) const {
  Particles whole = fluid;
  std::vector<std::vector<double>> messages(static_cast<std::size_t>(size_));
  if (!own_.empty()) pack(whole, own_, std::vector<int>(own_.size(), rank_), messages[0]);
  unpack(all_to_all(messages, communicator_), whole);
  return whole;
}

}  // namespace toryu::fluid
