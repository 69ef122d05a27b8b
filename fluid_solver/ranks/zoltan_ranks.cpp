#include "fluid_solver/ranks/zoltan_ranks.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "fluid_solver/ranks/all_to_all.hpp"
#include "fluid_solver/ranks/carrying.hpp"
#include "fluid_solver/ranks/numbering.hpp"

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
  parts_.resize(static_cast<std::size_t>(size_));
  zoltan_.reset(Zoltan_Create(communicator_));
  for (const auto& [name, value] : {std::pair{"DEBUG_LEVEL", "0"},  // before it says what it does
                                    {"LB_METHOD", "RCB"},
                                    {"KEEP_CUTS", "1"},
                                    {"RETURN_LISTS", "NONE"},
                                    {"NUM_GID_ENTRIES", "1"},
                                    {"NUM_LID_ENTRIES", "1"}})
    check(Zoltan_Set_Param(zoltan_.get(), name, value), name);
}

void ZoltanRanks::take_largest(std::span<double> values) const {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX,
                communicator_);
}

double ZoltanRanks::largest(const Field& values) const {
  double found = -std::numeric_limits<double>::infinity();
  for (const auto i : own_) found = std::max(found, values[i]);
  return largest(found);
}

void ZoltanRanks::add_up(std::span<ExactSum> sums) const {
  std::vector<ExactSum> all(sums.size() * parts_.size());
  const int bytes = static_cast<int>(sums.size_bytes());
  MPI_Allgather(sums.data(), bytes, MPI_BYTE, all.data(), bytes, MPI_BYTE, communicator_);
  for (std::size_t n = 0; n < sums.size(); ++n) {
    sums[n] = {};
    for (std::size_t k = n; k < all.size(); k += sums.size()) sums[n].add(all[k]);
  }
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
  if (size_ == 1) return;
  int axes = 0;
  double low[3], high[3];
  check(Zoltan_RCB_Box(zoltan, rank_, &axes, &low[0], &low[1], &low[2], &high[0], &high[1], &high[2]),
        "a part without a box");
  const std::array<double, 2 * dim> here{low[0], low[1], high[0], high[1]};
  std::vector<double> all(here.size() * parts_.size());
  MPI_Allgather(here.data(), 2 * dim, MPI_DOUBLE, all.data(), 2 * dim, MPI_DOUBLE, communicator_);
  for (std::size_t r = 0; r < parts_.size(); ++r) {
    const double* box = &all[r * here.size()];
    parts_[r] = {{box[0], box[1]}, {box[2], box[3]}};
  }
}

int ZoltanRanks::owner_of(const Vec& x) const {
  if (size_ == 1) return 0;  // Zoltan keeps no cuts for one
  const Box& own = parts_[static_cast<std::size_t>(rank_)];
  if (((x - own.min).array() > 0).all() && ((own.max - x).array() > 0).all()) return rank_;
  double point[3] = {x[0], x[1], 0};
  int owner = 0, part = 0;
  check(Zoltan_LB_Point_PP_Assign(zoltan_.get(), point, &owner, &part), "a place without an owner");
  return owner;
}

/// Around the own particles; an empty one where there are none.
Box ZoltanRanks::box_of_own(const Particles& fluid) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box own{Vec::Constant(infinity), Vec::Constant(-infinity)};
  for (const auto i : own_) {
    own.min = own.min.cwiseMin(at(fluid.x, i));
    own.max = own.max.cwiseMax(at(fluid.x, i));
  }
  return own;
}

/// Own particles that others have as ghosts, by rank: those nearer than `depth` to its part, or with an image
/// there. Walls of the part may stand where it has no particle of its own.
std::vector<std::vector<std::uint32_t>> ZoltanRanks::ghosts_of_others(const Particles& fluid, double depth,
                                                                      const std::vector<Vec>& shifts) const {
  const Box own = box_of_own(fluid);
  struct Near {
    std::size_t rank;
    Box box;  ///< in which particles are ghosts there
  };
  std::vector<Near> nears;
  for (std::size_t r = 0; r < parts_.size(); ++r)
    for (const Vec& shift : shifts) {
      const Box box{parts_[r].min - shift - Vec::Constant(depth),
                    parts_[r].max - shift + Vec::Constant(depth)};
      const bool meet = ((box.max - own.min).array() >= 0).all() && ((own.max - box.min).array() >= 0).all();
      if (meet && r != static_cast<std::size_t>(rank_)) nears.push_back({r, box});
    }
  std::vector<std::vector<std::uint32_t>> found(parts_.size());
  for (const auto i : own_) {
    const Vec x = at(fluid.x, i);
    for (const auto& [rank, box] : nears)
      if (((x - box.min).array() >= 0).all() && ((box.max - x).array() >= 0).all())
        if (found[rank].empty() || found[rank].back() != i) found[rank].push_back(i);
  }
  return found;
}

/// Sends particles at `places`, by rank, and has what comes join the own ones that are `kept`.
Joined ZoltanRanks::exchange(Particles& fluid, VecField* beside, const std::vector<std::uint32_t>& kept,
                             const std::vector<std::vector<std::uint32_t>>& places) {
  std::vector<std::vector<double>> messages;
  for (const auto& of_rank : places)
    messages.push_back(packed_particles(fluid, beside, of_rank, place_in_whole_));
  return join(fluid, beside, kept, all_to_all(messages, communicator_), place_in_whole_);
}

void ZoltanRanks::begin(const Particles& fluid, const std::vector<Boundary>& boundaries) {
  own_.resize(rank_ == 0 ? fluid.count : 0);
  std::iota(own_.begin(), own_.end(), 0u);
  place_in_whole_.resize(fluid.count);
  std::iota(place_in_whole_.begin(), place_in_whole_.end(), 0u);
  note_own(fluid);
  beside_walls_ = BesideWalls(communicator_, fluid, boundaries, {}, {});
  at_walls_.assign(boundaries.size(), Gatherer(communicator_, {}, {}));
}

void ZoltanRanks::divide(Particles& fluid, double depth, const std::vector<Vec>& shifts, VecField* beside) {
  const auto ranks = static_cast<std::size_t>(size_);
  if (balancings_ == 0 || !is_balanced()) balance(fluid);
  std::vector<std::vector<std::uint32_t>> leaving(ranks);
  std::vector<std::uint32_t> kept;
  for (const auto i : own_)
    if (const int owner = owner_of(at(fluid.x, i)); owner == rank_)
      kept.push_back(i);
    else
      leaving[static_cast<std::size_t>(owner)].push_back(i);
  if (largest(static_cast<double>(own_.size() - kept.size())) > 0) {
    exchange(fluid, beside, kept, leaving);
    own_.resize(fluid.count);
    std::iota(own_.begin(), own_.end(), 0u);
  }
  ghosts_there_ = ghosts_of_others(fluid, depth, shifts);
  const std::vector<std::uint32_t> before = own_;
  Joined joined = exchange(fluid, beside, before, ghosts_there_);
  for (auto& of_rank : ghosts_there_)
    for (auto& i : of_rank)
      i = joined.kept[static_cast<std::size_t>(std::lower_bound(before.begin(), before.end(), i) -
                                               before.begin())];
  own_ = std::move(joined.kept);
  ghosts_here_ = std::move(joined.received);
}

void ZoltanRanks::follow(const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> now(order.size()), places(order.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    now[order[k]] = k;
    places[k] = place_in_whole_[order[k]];
  }
  place_in_whole_ = std::move(places);
  for (auto& i : own_) i = now[i];
  std::sort(own_.begin(), own_.end());
  for (auto* ghosts : {&ghosts_there_, &ghosts_here_})
    for (auto& of_rank : *ghosts)
      for (auto& i : of_rank) i = now[i];
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

Swept ZoltanRanks::swept_by(const ClusterList& neighbours) const {
  enum Kind : char { far, seen, own };
  std::vector<Kind> kinds(neighbours.clusters(), far);
  for (const auto i : own_) kinds[i / lane_count] = own;
  for (std::size_t c = 0; c < kinds.size(); ++c)
    if (kinds[c] == own)
      for (const ShiftedNeighbours& near : neighbours.near(c))
        for (const auto j : near.sources)
          if (Kind& kind = kinds[j / lane_count]; kind == far) kind = seen;
  Swept found;
  for (std::uint32_t c = 0; c < kinds.size(); ++c) {
    if (kinds[c] == own) found.own.push_back(c);
    if (kinds[c] != far) found.near.push_back(c);
  }
  return found;
}

void ZoltanRanks::note_lists(const Particles& fluid, const ClusterList& neighbours,
                             const std::vector<Boundary>& boundaries,
                             const std::vector<std::uint32_t>& near_interface) {
  note_own(fluid);
  beside_walls_ = BesideWalls(communicator_, fluid, boundaries, own_, place_in_whole_);
  swept_ = swept_by(neighbours);
  renewal_ = renewal(near_interface);
  at_walls_.clear();
  for (const Boundary& boundary : boundaries) {
    const auto own = own_of(boundary);
    at_walls_.emplace_back(communicator_, own, own);
  }
}

/// Who brings which particles to rank 0.
void ZoltanRanks::note_own(const Particles& fluid) {
  std::vector<std::uint32_t> places;
  places.reserve(own_.size());
  for (const auto i : own_) places.push_back(place_in_whole_[i]);
  whole_ = Gatherer(communicator_, own_, places);
  count_of_whole_ = whole_.places().size();
  Field masses(padded(count_of_whole_), 0.0);
  whole_.gather({&fluid.m}, {&masses});
  mass_ = std::reduce(masses.begin(), masses.end());
}

}  // namespace toryu::fluid
