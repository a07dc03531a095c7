// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/remarks.hpp"

#include "core/coupled/wall_strain.hpp"
#include "core/scene/unused.hpp"

namespace tunica::axisym {

std::vector<std::string> remarks_on_unused_keys(const Scene& scene, const Setup& setup) {
  std::vector<scene::Unused> unused{
      {{"lumped.", "mesh.around_cells", "mesh.symmetry", "solver.method", "solver.options"},
       "the tier is axisym"}};
  if (scene.text("time.mode") == "static")
    unused.push_back({{"time.beats", "time.start", "time.ramp", "output.interval", "output.profile_times",
                       "outlet.compliance", "solver.geometry"},
                      "time.mode is \"static\""});
  if (!setup.problem.mesh.has(Part::blood))
    unused.push_back({{"blood.", "inlet.profile", "inlet.pressure_kind", "outlet.", "mesh.blood_cells",
                       "mesh.motion", "solver.geometry"},
                      "a wall under a given pressure is computed without its blood"});
  if (!setup.problem.mesh.has(Part::wall)) unused.push_back({{"solver.geometry"}, "no wall moves"});
  if (setup.inlet.is_pressure) unused.push_back({{"inlet.profile"}, "a pressure drives the flow"});
  if (setup.problem.inlet.kind == InletKind::prescribed)
    unused.push_back({{"inlet.pressure_kind"}, "the velocity at the inlet is prescribed"});
  if (scene.text("geometry.kind") == "mesh")
    unused.push_back({{"geometry.thickness", "geometry.length"}, "geometry.kind is \"mesh\""});
  if (scene.text("mesh.element") == "bubble")
    unused.push_back({{"mesh.mixed_wall"}, "mesh.element is \"bubble\""});
  else if (coupled::is_far_from_incompressible(setup.problem.laws))
    unused.push_back({{"mesh.mixed_wall"}, "the wall is far from incompressible"});
  return scene::remarks_on(scene, unused);
}

}  // namespace tunica::axisym
