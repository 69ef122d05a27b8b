/// State to and from a stream, by cereal. Included by what writes and reads checkpoints, and by nothing else:
/// a State itself needs no cereal, only beside its struct
///
///     template <class Archive>
///     void serialize(Archive& archive, State& state) {
///       auto& [time, x, v] = state;     // does not compile while a member is missing
///       archive(time, x, v);
///     }
///
/// The same list serves all that walks over the fields (field.hpp). What is neither written nor a field, such
/// as neighbour lists that are built anew, is bound and left out of the second line.
///
/// Numbers are stored as they are in memory: a checkpoint is read by the program that wrote it, on a machine
/// of the same kind (checkpoint.hpp).
#pragma once

#include <Eigen/Core>
#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/deque.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>

#include "common/state/field.hpp"

namespace Eigen {

/// Small vectors and matrices by their numbers; one that grows by its size first.
template <class Archive, int rows, int columns>
void serialize(Archive& archive, Matrix<double, rows, columns>& m) {
  if constexpr (rows == Dynamic || columns == Dynamic) {
    Index r = m.rows(), c = m.cols();
    archive(r, c);
    m.resize(r, c);
  }
  archive(cereal::binary_data(m.data(), static_cast<std::size_t>(m.size()) * sizeof(double)));
}

}  // namespace Eigen

namespace toryu {

template <class Archive, class T>
void serialize(Archive& archive, Symmetric<T>& tensor) {
  archive(tensor.xx, tensor.yy, tensor.xy);
}

/// A derived field is not written, and stays as it is.
template <class Archive, class Values>
void serialize(Archive& archive, Declared<Values>& field) {
  if (field.kind == FieldKind::state) archive(static_cast<Values&>(field));
}

}  // namespace toryu

namespace cereal {

/// Of the base class's own functions and that above, that above counts.
template <class Archive, class Values>
struct specialize<Archive, toryu::Declared<Values>, specialization::non_member_serialize> {};

}  // namespace cereal

namespace toryu {

/// Writes `states` to a stream, one after the other.
template <class... State>
void write_states(std::ostream& stream, const State&... states) {
  cereal::BinaryOutputArchive archive(stream);
  archive(states...);
}

/// Reads them back. Throws cereal::Exception if the stream ends early.
template <class... State>
void read_states(std::istream& stream, State&... states) {
  cereal::BinaryInputArchive archive(stream);
  archive(states...);
}

}  // namespace toryu
