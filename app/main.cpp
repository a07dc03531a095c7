// SPDX-License-Identifier: GPL-3.0-or-later
// The program that users start. It has the tiers that need no MPI, and goes over to tunica-full3d for the one
// that does, so that the light tiers do not wait for its libraries.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "app/full3d_by_name.hpp"
#include "app/launch.hpp"
#include "app/program.hpp"
#include "app/tiers.hpp"
#include "core/error.hpp"
#include "full3d/refusal.hpp"

namespace {

using namespace tunica;

class LightProgram final : public Program {
 public:
  explicit LightProgram(char** argv) : argv_(argv), tiers_(light_tiers()) {
    tiers_.push_back(full3d_by_name());
  }
  const TierList& tiers() const override { return tiers_; }

  bool speaks() const override { return is_first_process(); }

  void before_computing(const std::vector<const Tier*>& tiers) const override {
    const bool in_common = std::any_of(tiers.begin(), tiers.end(),
                                       [](const Tier* tier) { return tier->name() == full3d::tier_name; });
    if (!in_common) {
      // What one process computes need not be computed by all that mpirun has started.
      if (!is_first_process()) std::exit(0);
      return;
    }
    // Factors are made by one thread in each process: threads in the small products of which there are many
    // wait for each other.
    ::setenv("OPENBLAS_NUM_THREADS", "1", 0);
    const auto other = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "tunica-full3d";
    ::execv(other.c_str(), argv_);
    throw InvalidInput(fmt::format(
        "--tier full3d: {} cannot be started ({}); build Tunica with -DTUNICA_FULL3D=ON, or name a lighter "
        "tier",
        other.string(), std::strerror(errno)));
  }

 private:
  char** argv_;
  TierList tiers_;
};

}  // namespace

int main(int argc, char** argv) {
  const LightProgram program(argv);
  return run_program(argc, argv, program);
}
