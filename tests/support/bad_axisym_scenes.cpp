// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include "tests/support/bad_scenes.hpp"
#include "tests/support/gmsh_model.hpp"

namespace tunica::test_support {

namespace {

namespace fs = std::filesystem;

auto scene(std::string text) {
  return [text = std::move(text)](const fs::path& folder) {
    std::ofstream(folder / "bad.toml") << text;
    return folder / "bad.toml";
  };
}

/// A scene of the mesh file artery.msh, with more of [geometry] and then other tables.
auto with_mesh(const Stenosis& shape, std::string more = "") {
  return [shape, more = std::move(more)](const fs::path& folder) {
    std::ofstream(folder / "artery.msh") << stenosis_mesh(shape).text("4.1");
    std::ofstream(folder / "bad.toml") << "[geometry]\nkind = \"mesh\"\nfile = \"artery.msh\"\n" << more;
    return folder / "bad.toml";
  };
}

Stenosis small(int type = triangle6) {
  Stenosis shape;
  shape.severity = 0;
  shape.blood_cells = shape.wall_cells = 2;
  shape.axial_cells = 4;
  shape.type = type;
  return shape;
}

/// The shape in another unit of length.
Stenosis scaled(double factor) {
  Stenosis shape = small();
  for (double* length : {&shape.radius, &shape.thickness, &shape.length, &shape.width}) *length *= factor;
  return shape;
}

Stenosis layered() {
  Stenosis shape = small();
  shape.layered = true;
  return shape;
}

Stenosis without_blood() {
  Stenosis shape = small();
  shape.blood_cells = 0;
  return shape;
}

std::vector<BadScene> meshes() {
  const std::string two_layers =
      "[[wall.layers]]\nname = \"media\"\nfraction = 0.5\n[[wall.layers]]\nname = \"adventitia\"\nfraction = "
      "0.5\n";
  return {
      {"mesh_missing",
       [](const fs::path& folder) {
         std::ofstream(folder / "artery.msh") << "";
         std::ofstream(folder / "bad.toml") << "[geometry]\nkind = \"mesh\"\nfile = \"arteri.msh\"\n";
         return folder / "bad.toml";
       },
       {},
       {"arteri.msh does not exist", "did you mean", "artery.msh?"}},
      {"mesh_is_a_folder",
       [](const fs::path& folder) {
         fs::create_directory(folder / "artery.msh");
         std::ofstream(folder / "bad.toml") << "[geometry]\nkind = \"mesh\"\nfile = \"artery.msh\"\n";
         return folder / "bad.toml";
       },
       {},
       {"artery.msh", "is a folder"}},
      {"mesh_is_a_scene",
       scene("[geometry]\nkind = \"mesh\"\nfile = \"bad.toml\"\n"),
       {},
       {"bad.toml, line 1", "no Gmsh mesh"}},
      {"mesh_in_millimetres",
       with_mesh(scaled(10)),
       {},
       {"artery.msh", "10 times geometry.radius = 0.033 cm", "millimetres", "Mesh.ScalingFactor"}},
      {"mesh_a_thousand_times_too_small",
       with_mesh(scaled(1e-3)),
       {},
       {"artery.msh", "3.3e-05 cm", "geometry.radius = 0.033 cm", "Mesh.ScalingFactor"}},
      {"mesh_a_thousand_times_too_large",
       with_mesh(scaled(1e3)),
       {},
       {"artery.msh", "33 cm", "geometry.radius = 0.033 cm", "Mesh.ScalingFactor"}},
      {"mesh_with_layers_that_the_scene_has_not",
       with_mesh(layered()),
       {},
       {"geometry.file has 2 layers", "the scene describes 1", "[[wall.layers]]"}},
      {"mesh_without_layers_that_the_scene_has",
       with_mesh(small(), two_layers),
       {},
       {"geometry.file has 1 layer of", "the scene describes 2"}},
      {"bubble_on_quadrilaterals",
       with_mesh(small(quadrilateral9), "[mesh]\nelement = \"bubble\"\n"),
       {},
       {"artery.msh", "\"bubble\" needs triangles", "\"quadratic\""}},
      {"flow_into_a_wall_alone",
       with_mesh(without_blood()),
       {},
       {"wall without blood", "inlet.waveform", "\"pressure\""}},
  };
}

std::vector<BadScene> scenes() {
  return {
      {"torus", scene("[geometry]\nkind = \"torus\"\n"), {}, {"geometry.kind = \"torus\"", "\"cylinder\""}},
      {"incompressible",
       scene("[wall]\nincompressible = true\n"),
       {},
       {"wall.incompressible = true", "0D tier", "wall.bulk_modulus"}},
      {"sensitivity_of_a_cycle",
       scene("[sensitivity]\nparameters = [\"inlet.flow\"]\n[time]\nstart = \"periodic\"\n"),
       {},
       {"sensitivity.parameters", "time.start = \"periodic\"", "--tier lumped"}},
      {"alpha_without_step",
       scene("[time]\nscheme = \"generalized-alpha\"\n"),
       {},
       {"time.scheme = \"generalized-alpha\"", "time.step"}},
      {"parabola_that_widens",
       scene("[geometry]\nends = \"sliding\"\n"),
       {},
       {"inlet.profile = \"parabolic\"", "geometry.ends = \"sliding\"", "\"natural\""}},
      {"compliance_shorted",
       scene("[outlet]\nkind = \"rcr\"\nresistance = 0\n"),
       {},
       {"outlet.resistance = 0", "\"rcr\"", "above 0"}},
      {"one_handed_fibres",
       scene("[[wall.families]]\nangle = 40\n"),
       {},
       {"wall.families are not in balance", "mirror image", "full3d"}},
      {"fibres_of_unequal_weight",
       scene("[[wall.families]]\nangle = 40\n[[wall.families]]\nangle = -40\nweight = 0.9\n"),
       {},
       {"wall.families are not in balance", "equal weight"}},
      {"fibres_recruited_apart",
       scene("[[wall.families]]\nangle = 40\n[[wall.families]]\nangle = -40\nactivation_stretch = 1.2\n"),
       {},
       {"wall.families are not in balance"}},
      {"one_handed_layer",
       scene("[[wall.layers]]\nfraction = 0.5\n[[wall.layers]]\nfraction = 0.5\n"
             "[[wall.layers.families]]\nangle = -30\n"),
       {},
       {"wall.families are not in balance"}},
      {"very_long",
       scene("[geometry]\nlength = 900\n"),
       {},
       {"geometry.length = 900 cm", "2.73e+04 times geometry.radius", "\"sliding\""}},
      {"tolerance_beyond_memory",
       scene("[accuracy]\ntolerance = 1e-9\n"),
       {},
       {"nodes", "accuracy.tolerance", "mesh.axial_cells"}},
      {"cells_beyond_memory",
       scene("[mesh]\naxial_cells = 4000\nblood_cells = 4000\n"),
       {},
       {"6.41e+07 nodes", "at most 100000", "mesh.axial_cells"}},
  };
}

}  // namespace

const std::vector<BadScene>& bad_axisym_scenes() {
  static const std::vector<BadScene> all = [] {
    std::vector<BadScene> list = meshes();
    for (auto& bad : scenes()) list.push_back(std::move(bad));
    return list;
  }();
  return all;
}

}  // namespace tunica::test_support
