// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::observables {

/// Shape of all cells of a mesh; its corners are in the order of VTK and XDMF.
enum class CellShape { triangle, quadrilateral, tetrahedron, hexahedron };
std::size_t corners(CellShape shape);

/// Where fields are shown. Points may coincide: cells that share no point keep fields that jump between
/// them, such as stress between two layers, apart.
struct FieldMesh {
  CellShape shape = CellShape::quadrilateral;
  std::vector<std::array<double, 3>> points;  ///< cm, of the unloaded body
  std::vector<int> cells;                     ///< indices of points, corners(shape) for each cell
  /// The body is this mesh and its mirror images at x = 0, at y = 0, or at both; fields are mirrored too.
  std::array<bool, 2> mirrored{};
};

/// One number per cell, the same at all times: a layer, a material.
struct CellField {
  std::string name;
  std::string unit;
  std::vector<int> values;
};

/// What each point has at each time.
struct PointField {
  std::string name;
  std::string unit;            ///< as in the header of a table: "dyn/cm2", "1"
  std::size_t components = 1;  ///< 1, or 3 for a vector (x, y, z)
};

/// Fields on a mesh that stays the same, at a sequence of times, for pictures: numbers are kept and written
/// in single precision, some 7 digits. What is to be computed with further belongs into a table.
struct FieldSeries {
  struct Frame {
    double time;                             ///< s
    std::vector<std::vector<float>> values;  ///< [point field][component + components * point]; NaN for
                                             ///< a quantity that the point has not
  };
  std::string name;  ///< of the file, without extension
  FieldMesh mesh;
  std::vector<CellField> cell_fields;
  std::vector<PointField> point_fields;
  std::vector<Frame> frames;  ///< times ascend
};

/// Numbers of one time in all of the series.
std::size_t numbers_of_a_time(const std::vector<FieldSeries>& series);

/// One self-contained XDMF 3 file, a temporal collection of uniform grids with all numbers inline. Mesh and
/// cell fields stand in the first grid; the others include them by XInclude, which the readers of XDMF 2
/// and of XDMF 3 in ParaView understand (a Reference attribute makes the latter abort). The XDMF 2 reader
/// does not understand "nan" and loses the rest of that field.
/// The planes of FieldMesh::mirrored are an Information, which viewers show nothing of: they show the mesh.
/// Throws std::logic_error when the numbers of values do not fit the mesh.
std::string to_xdmf(const FieldSeries& series);

/// The same text, time by time: a run's fields may be many times as long as what is held of them at once.
void write_xdmf(const FieldSeries& series, const std::function<void(std::string_view)>& sink);

/// What to_xdmf wrote, with numbers in single precision. Only text of its form is understood, not XDMF of
/// others. Throws std::invalid_argument that says what is not of that form.
FieldSeries from_xdmf(std::string_view text);

}  // namespace tunica::observables
