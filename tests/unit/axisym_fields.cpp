// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/assembler.hpp"
#include "axisym/fields.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <stdexcept>

#include "tests/support/axisym_state.hpp"

namespace {

using namespace tunica;
using namespace tunica::axisym;
using observables::FieldSeries;
using test_support::small_tube;
using test_support::state_of;
using test_support::vessel;

const wall::MaterialAxes straight{{0, 1, 0}, {0, 0, 1}};
constexpr double single_precision = 1.2e-7;

const std::vector<std::string> two_layers{
    "wall.layers=[{fraction=0.25, law=\"EXP1+EXP2-FS\", families=[{angle=40}, {angle=-40}, {angle=10}]}, "
    "{fraction=0.75, law=\"EXP1\"}]"};

struct Discrete {
  const char* name;
  CellShape shape;
  Element element;
  std::size_t shown_cells;   ///< of a cell
  std::size_t blood_points;  ///< of 3 x 4 rectangles
};
void PrintTo(const Discrete& discrete, std::ostream* stream) {
  *stream << discrete.name;
}
constexpr Discrete discretisations[] = {
    {"quadratic_quadrilaterals", CellShape::quadrilateral, Element::quadratic, 4, 63},
    {"quadratic_triangles", CellShape::triangle, Element::quadratic, 4, 63},
    {"linear_quadrilaterals", CellShape::quadrilateral, Element::linear, 1, 20},
    {"linear_triangles", CellShape::triangle, Element::linear, 1, 20},
    {"bubble_triangles", CellShape::triangle, Element::bubble, 1, 20}};

class FieldsOf : public testing::TestWithParam<Discrete> {
 protected:
  TubeSpec spec = [] {
    TubeSpec tube = small_tube(GetParam().shape);
    tube.layers = {0.04, 0.08};
    return tube;
  }();
  Problem problem(const std::vector<std::string>& overrides = two_layers) const {
    return vessel(structured_tube(spec), GetParam().element, overrides);
  }
};

INSTANTIATE_TEST_SUITE_P(Elements, FieldsOf, testing::ValuesIn(discretisations),
                         [](const auto& test) { return test.param.name; });

/// Value of a field at a point of the last frame.
double at(const FieldSeries& series, const std::string& name, std::size_t point, std::size_t component = 0) {
  for (std::size_t f = 0; f < series.point_fields.size(); ++f)
    if (series.point_fields[f].name == name)
      return static_cast<double>(
          series.frames.back().values[f][series.point_fields[f].components * point + component]);
  throw std::runtime_error("no field " + name);
}

std::vector<std::string> names_of(const FieldSeries& series) {
  std::vector<std::string> names;
  for (const auto& field : series.point_fields) names.push_back(field.name);
  return names;
}

/// Area in the plane of x and z; throws for a cell that is turned over.
double area_of(const FieldSeries& series, std::size_t cell) {
  const std::size_t n = observables::corners(series.mesh.shape);
  double twice = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto& a = series.mesh.points[series.mesh.cells[n * cell + k]];
    const auto& b = series.mesh.points[series.mesh.cells[n * cell + (k + 1) % n]];
    twice += a[0] * b[2] - a[2] * b[0];
  }
  if (!(twice > 0)) throw std::runtime_error("a cell is turned over");
  return twice / 2;
}

TEST_P(FieldsOf, MeshesCoverThePartsAndLayersShareNoPoints) {
  const Problem problem = this->problem();
  const Assembler assembler(problem);
  const auto series = Fields(assembler).empty_series();
  ASSERT_EQ(series.size(), 2U);
  const FieldSeries &blood = series[0], &wall = series[1];
  EXPECT_EQ(blood.name, "blood");
  EXPECT_EQ(wall.name, "wall");
  const std::size_t n = observables::corners(wall.mesh.shape);
  const std::size_t per_rectangle = (n == 3 ? 2 : 1) * GetParam().shown_cells;
  ASSERT_EQ(blood.mesh.cells.size(), n * 12 * per_rectangle);
  ASSERT_EQ(wall.mesh.cells.size(), n * 24 * per_rectangle);
  EXPECT_EQ(blood.mesh.points.size(), GetParam().blood_points);

  double blood_area = 0;
  for (std::size_t cell = 0; cell < 12 * per_rectangle; ++cell) blood_area += area_of(blood, cell);
  EXPECT_NEAR(blood_area, 0.3 * 2, 1e-14);
  ASSERT_EQ(wall.cell_fields.size(), 1U);
  EXPECT_EQ(wall.cell_fields[0].name, "layer");
  const auto& layers = wall.cell_fields[0].values;
  ASSERT_EQ(layers.size(), 24 * per_rectangle);
  double areas[2] = {0, 0};
  std::vector<int> layer_of(wall.mesh.points.size(), -1);
  for (std::size_t cell = 0; cell < layers.size(); ++cell) {
    areas[layers[cell]] += area_of(wall, cell);
    for (std::size_t k = 0; k < n; ++k) {
      const int point = wall.mesh.cells[n * cell + k];
      EXPECT_TRUE(layer_of[point] < 0 || layer_of[point] == layers[cell]);
      layer_of[point] = layers[cell];
    }
  }
  for (const int layer : layer_of) EXPECT_GE(layer, 0) << "a point without a cell";
  EXPECT_NEAR(areas[0], 0.04 * 2, 1e-14);
  EXPECT_NEAR(areas[1], 0.08 * 2, 1e-14);
  for (const auto& one : series)
    for (const auto& [x, y, z] : one.mesh.points) EXPECT_EQ(y, 0);
}

TEST_P(FieldsOf, HaveTheNamesOfWhatThereIs) {
  const std::vector<std::string> stresses{"displacement",  "von_mises",    "circumferential_stress",
                                          "radial_stress", "axial_stress", "shear_stress"};
  const std::vector<std::string> fibers{"recruitment", "fiber_stretch", "fiber_direction"};
  const std::vector<std::string> third{"recruitment.3", "fiber_stretch.3", "fiber_direction.3"};
  const auto names = [&](const std::vector<std::string>& overrides) {
    const Problem problem = this->problem(overrides);
    const Assembler assembler(problem);
    return names_of(Fields(assembler).empty_series()[1]);
  };
  using test_support::joined;
  EXPECT_EQ(names({"wall.layers=[{fraction=0.25, law=\"EXP1\"}, {fraction=0.75, law=\"EXP2\"}]"}), stresses);
  EXPECT_EQ(names({"wall.layers=[{fraction=0.25, law=\"EXP1\"}, {fraction=0.75, law=\"EXP1+EXP2-ZS\"}]"}),
            joined(stresses, fibers));
  EXPECT_EQ(names(two_layers), joined(joined(stresses, fibers), third));

  const Problem problem = this->problem();
  const Assembler assembler(problem);
  EXPECT_EQ(names_of(Fields(assembler).empty_series()[0]),
            (std::vector<std::string>{"displacement", "velocity", "pressure"}));
}

/// Uniform strain with shear: every number in closed form, layer by layer.
TEST_P(FieldsOf, UniformStrainHasTheStressAndFibresOfEachLayer) {
  const double a = 0.3, b = -0.1, c = 0.25;
  Tensor<double> h = Tensor<double>::diagonal(a, a, b);
  h(2, 0) = c;
  for (const bool mixed : {true, false}) {
    Problem problem = this->problem();
    problem.discretisation.mixed_wall = mixed;
    const Assembler assembler(problem);
    const Fields fields(assembler);
    auto series = fields.empty_series();
    const auto displacement = [&](const Point& x) { return Point{a * x[0], c * x[0] + b * x[1]}; };
    fields.append(0.125, state_of(assembler, {displacement, {}, {}}), series);
    const FieldSeries& wall = series[1];
    ASSERT_EQ(wall.frames.size(), 1U);
    EXPECT_EQ(wall.frames[0].time, 0.125);
    std::vector<int> layer_of(wall.mesh.points.size());
    const std::size_t n = observables::corners(wall.mesh.shape);
    for (std::size_t k = 0; k < wall.mesh.cells.size(); ++k)
      layer_of[wall.mesh.cells[k]] = wall.cell_fields[0].values[k / n];
    for (std::size_t i = 0; i < wall.mesh.points.size(); ++i) {
      const auto& law = problem.laws[layer_of[i]];
      const auto cauchy = cauchy_stress(wall::piola(law, h, straight), h);
      const auto expect = [&](const char* name, double value, std::size_t component = 0) {
        EXPECT_NEAR(at(wall, name, i, component), value, single_precision * (std::abs(value) + 1)) << name;
      };
      const auto& [r, y, z] = wall.mesh.points[i];
      expect("displacement", a * r);
      expect("displacement", 0, 1);
      expect("displacement", c * r + b * z, 2);
      expect("von_mises", von_mises_stress(cauchy));
      expect("radial_stress", cauchy(0, 0));
      expect("circumferential_stress", cauchy(1, 1));
      expect("axial_stress", cauchy(2, 2));
      expect("shear_stress", cauchy(0, 2));
      for (const int family : {0, 2}) {
        const std::string which = family == 0 ? "" : ".3";
        if (layer_of[i] == 1) {
          for (const char* name : {"recruitment", "fiber_stretch", "fiber_direction"})
            EXPECT_TRUE(std::isnan(at(wall, name + which, i)));
          continue;
        }
        const auto& fibers = wall::families(law)[family];
        const auto state = wall::fiber_state(fibers, h, straight);
        expect(("recruitment" + which).c_str(), state.recruitment);
        expect(("fiber_stretch" + which).c_str(), state.stretch);
        const double around = (1 + a) * std::cos(fibers.angle), axial = (1 + b) * std::sin(fibers.angle);
        const std::string direction = "fiber_direction" + which;
        expect(direction.c_str(), 0, 0);
        expect(direction.c_str(), around / std::hypot(around, axial), 1);
        expect(direction.c_str(), axial / std::hypot(around, axial), 2);
      }
    }
    EXPECT_GT(std::abs(at(wall, "shear_stress", 0)), 1e3) << "there is shear to be seen";
  }
}

TEST_P(FieldsOf, BloodHasItsVelocityAndPressureAtItsPoints) {
  const Problem problem = this->problem();
  const Assembler assembler(problem);
  const Fields fields(assembler);
  auto series = fields.empty_series();
  const auto displacement = [](const Point& x) { return Point{0.1 * x[0], 0.2 * x[1] * x[0]}; };
  const auto velocity = [](const Point& x) { return Point{x[0] * x[1], 1 - x[0] * x[0]}; };
  const auto pressure = [](const Point& x) { return 100 - 20 * x[1] + 7 * x[0]; };
  fields.append(0, state_of(assembler, {}), series);
  fields.append(1, state_of(assembler, {displacement, velocity, pressure}), series);
  const FieldSeries& blood = series[0];
  ASSERT_EQ(blood.frames.size(), 2U);
  for (std::size_t i = 0; i < blood.mesh.points.size(); ++i) {
    const auto& [r, y, z] = blood.mesh.points[i];
    const Point d = displacement({r, z}), v = velocity({r, z});
    // Nodes in the middle have the mean of the corners' pressures, which is that of a linear field.
    EXPECT_NEAR(at(blood, "pressure", i), pressure({r, z}), 100 * single_precision);
    for (const std::size_t c : {0U, 1U}) {
      EXPECT_NEAR(at(blood, "displacement", i, 2 * c), d[c], single_precision);
      EXPECT_NEAR(at(blood, "velocity", i, 2 * c), v[c], 2 * single_precision);
    }
    EXPECT_EQ(at(blood, "displacement", i, 1), 0);
    EXPECT_EQ(at(blood, "velocity", i, 1), 0);
  }
}

/// Where strain has a kink between cells of a layer, a point has the mean of it: with d_z = |z - L/2|, none
/// of the axial strain and of the stress that comes with it.
TEST_P(FieldsOf, AKinkOfStrainIsMet) {
  const Problem problem =
      this->problem({"wall.layers=[{fraction=0.25, law=\"linear-elastic\"}, {fraction=0.75, "
                     "law=\"linear-elastic\"}]"});
  const Assembler assembler(problem);
  const Fields fields(assembler);
  auto series = fields.empty_series();
  fields.append(0,
                state_of(assembler, {[](const Point& x) {
                                       return Point{0, 0.01 * std::abs(x[1] - 1)};
                                     },
                                     {},
                                     {}}),
                series);
  const FieldSeries& wall = series[1];
  const double stress = std::abs(at(wall, "axial_stress", 0));
  EXPECT_GT(stress, 1);
  int met = 0;
  for (std::size_t i = 0; i < wall.mesh.points.size(); ++i) {
    const double z = wall.mesh.points[i][2];
    if (z != 1) continue;
    ++met;
    // On triangles there are not the same number of cells above and below every point, but mirror images.
    EXPECT_NEAR(at(wall, "axial_stress", i), 0, 1e-6 * stress);
  }
  EXPECT_EQ(met, GetParam().shown_cells == 4 ? 14 : 8);
}

TEST_P(FieldsOf, GoThroughXdmf) {
  const Problem problem = this->problem();
  const Assembler assembler(problem);
  const Fields fields(assembler);
  auto series = fields.empty_series();
  const auto y = state_of(assembler, {});
  for (const double time : {0.0, 0.05}) fields.append(time, y, series);
  for (const FieldSeries& one : series) {
    const std::string text = observables::to_xdmf(one);  // which refuses numbers that do not fit the mesh
    EXPECT_NE(text.find("<Time Value=\"0.05\"/>"), std::string::npos);
    for (const auto& field : one.point_fields) {
      const std::string attribute =
          fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">", field.name,
                      field.components == 3 ? "Vector" : "Scalar");
      const std::size_t first = text.find(attribute);
      ASSERT_NE(first, std::string::npos) << attribute;
      EXPECT_NE(text.find(attribute, first + 1), std::string::npos) << attribute;
    }
  }
  EXPECT_NE(observables::to_xdmf(series[1]).find(
                "<Attribute Name=\"layer\" AttributeType=\"Scalar\" Center=\"Cell\">"),
            std::string::npos);
}

TEST(Fields, AreOfThePartsThatThereAre) {
  TubeSpec spec = small_tube(CellShape::quadrilateral);
  spec.blood = false;
  const Problem wall = vessel(structured_tube(spec), Element::quadratic, {"wall.law=EXP1"});
  const Assembler wall_assembler(wall);
  const auto of_wall = Fields(wall_assembler).empty_series();
  ASSERT_EQ(of_wall.size(), 1U);
  EXPECT_EQ(of_wall[0].name, "wall");

  spec.blood = true;
  spec.wall = false;
  Problem pipe;
  pipe.mesh = structured_tube(spec);
  const Assembler pipe_assembler(pipe);
  const Fields fields(pipe_assembler);
  auto of_pipe = fields.empty_series();
  ASSERT_EQ(of_pipe.size(), 1U);
  EXPECT_EQ(of_pipe[0].name, "blood");
  fields.append(0, state_of(pipe_assembler, {}), of_pipe);
  EXPECT_EQ(of_pipe[0].frames.size(), 1U);
  of_pipe[0].name = "other";
  EXPECT_THROW(fields.append(1, state_of(pipe_assembler, {}), of_pipe), std::logic_error);
}

}  // namespace
