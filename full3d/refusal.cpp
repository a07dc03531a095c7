// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/refusal.hpp"

#include "core/element/gmsh_file.hpp"

namespace tunica::full3d {

std::string refusal(const Scene& scene) {
  const std::string& method = scene.text("solver.method");
  const bool moves_by_sections = scene.text("geometry.kind") == "cylinder" &&
                                 scene.text("solver.geometry") == "implicit" && method != "block" &&
                                 method != "schwarz";
  if (scene.has("mesh.motion") && scene.text("mesh.motion") == "sectional" && !moves_by_sections)
    return "mesh.motion = \"sectional\" is in 3D for cylinders with solver.geometry = \"implicit\" and "
           "solver.method = \"direct\"; use \"harmonic\" or \"stiffened\"";
  if (scene.text("geometry.kind") == "mesh") {
    const int dimensions = element::gmsh_dimensions(scene.folder() / scene.text("geometry.file"));
    if (dimensions == 1 || dimensions == 2)
      return "geometry.file has no volumes, but a half plane, for --tier axisym; mesh volumes \"blood\" and "
             "\"wall\", or write geometry.kind = \"cylinder\" or \"torus\"";
  }
  if (scene.flag("wall.incompressible"))
    return "wall.incompressible = true is for the 0D tier; write false and a large wall.bulk_modulus (9e6 "
           "dyn/cm2 changes the volume by 1 to 2 %)";
  if (!scene.texts("sensitivity.parameters").empty())
    return "sensitivity.parameters are for the 0D and 2D tiers; leave them out, or use --tier lumped";
  if (scene.has("time.scheme") && scene.text("time.scheme") == "generalized-alpha" &&
      scene.number("time.step") == 0)
    return "time.scheme = \"generalized-alpha\" is of first order in pressure when steps vary; give "
           "time.step, such as 1e-3";
  return {};
}

bool suits(const Scene& scene) {
  return refusal(scene).empty();
}

}  // namespace tunica::full3d
