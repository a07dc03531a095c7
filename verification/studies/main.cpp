// SPDX-License-Identifier: GPL-3.0-or-later
// tunica_study: computes the cases of a study and writes what docs/verification says of them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <memory>
#include <string>

#include "axisym/axisym_tier.hpp"
#include "lumped/lumped_tier.hpp"
#include "verification/studies/study.hpp"
#ifdef TUNICA_WITH_FULL3D
#include "full3d/full3d_tier.hpp"
#include "full3d/petsc.hpp"
#endif

namespace {

using namespace tunica;
using namespace tunica::verification;

struct Entry {
  const char* name;
  const char* cases;  ///< name of its case file
  const char* about;
  void (*write)(const Study&);
};
constexpr Entry entries[] = {
    {"accuracy", "accuracy", "2D: error and time by law, tolerance, element, scheme; 20 minutes", accuracy},
    {"elastic-tube", "elastic_tube", "2D: the elastic-tube benchmark; 10 minutes", elastic_tube},
    {"full3d", "full3d", "3D: cylinder against 2D, torus on finer meshes; half an hour", full3d_vessels},
    {"full3d-geometry", "full3d_geometry", "3D: implicit against lagged mesh motion; minutes",
     full3d_geometry},
    {"full3d-elements", "full3d_elements", "3D: errors of elements in space; half an hour", full3d_elements},
    {"reproduction", "reproduction", "0D: the paper's claims beside ours; a minute", reproduction},
    {"ripple-runs", "ripple_runs", "2D: runs with the printed tether; minutes", ripple_runs},
    {"sweep", "", "0D and 2D: what governs the paper's artery; minutes", sweep_study},
    {"tether-stability", "", "growth rates of ripples; half a minute", tether_stability},
#ifdef TUNICA_WITH_FULL3D
    {"torus-ripples", "torus_ripples", "3D: the torus with the printed tether; an hour", torus_ripples},
#endif
};

std::string list() {
  std::string text = "Studies:\n";
  for (const Entry& entry : entries) text += fmt::format("  {:18}{}\n", entry.name, entry.about);
  return text;
}

void compute(const Entry& entry, StudyOptions options) {
  TierList tiers;
  tiers.push_back(std::make_unique<lumped::LumpedTier>());
  tiers.push_back(std::make_unique<axisym::AxisymTier>());
#ifdef TUNICA_WITH_FULL3D
  const full3d::PetscSession petsc;
  const full3d::Ranks ranks;
  full3d::Team team(ranks);
  tiers.push_back(std::make_unique<full3d::Full3dTier>(team));
#endif
  entry.write(Study(entry.cases, std::move(options), tiers));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Computes a study and writes its tables, pictures and numbers into the repository"};
  app.footer(list());
  std::string name;
  StudyOptions options;
  options.source = ".";
  app.add_option("study", name)->required()->type_name("STUDY");
  app.add_option("--source", options.source, "The repository (default: the current folder)");
  app.add_option("--out", options.out, "Where to write, at the same places (default: the repository)");
  app.add_option("--program", options.program, "tunica")->required();
  app.add_option("--kept", options.kept, "Folder of runs that are not repeated (default: results/STUDY)");
  CLI11_PARSE(app, argc, argv);
  if (options.out.empty()) options.out = options.source;
  if (options.kept.empty()) options.kept = std::filesystem::path("results") / name;
  try {
    for (const Entry& entry : entries) {
      if (entry.name != name) continue;
      std::filesystem::create_directories(options.kept);
      compute(entry, std::move(options));
      return 0;
    }
    fmt::print(stderr, "tunica_study: {} is not a study\n{}", name, list());
  } catch (const std::exception& error) {
    fmt::print(stderr, "tunica_study: {}: {}\n", name, error.what());
  }
  return 2;
}
