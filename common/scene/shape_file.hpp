/// The outline of a body in a file beside the case: a drawing (SVG, DXF), or its corners as CSV.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/case/parameter_table.hpp"
#include "common/scene/outline.hpp"

namespace toryu {

/// Of the lengths in a file; `of_file`: as it says itself.
enum class LengthUnit { of_file, m, cm, mm, um, in };

struct ShapeFile {
  InputFile file = {};
  std::string id = {};     ///< of an element of an SVG; empty: the whole drawing
  std::string layer = {};  ///< of a DXF; empty: all of it
  LengthUnit unit = LengthUnit::of_file;
};
/// Describes the keys, which stand among those of a body.
void describe(ParameterTable& table, ShapeFile& file);

struct ShapeFileFault {
  std::string key, message;
};

/// Sets `rings` to the outlines in the file [m]; curves become chords within `tolerance` [m], 0: the default
/// of the drawing. A CSV has the columns `x[mm]` and `y[mm]`, of any unit, and before them `ring` where there
/// are several: the corners in order, ring by ring.
std::optional<ShapeFileFault> read_rings(const ShapeFile& file, double tolerance,
                                         std::vector<Outline::Ring>& rings);

}  // namespace toryu
