// SPDX-License-Identifier: GPL-3.0-or-later
// The program with all tiers, which `tunica` goes over to for the 3D one; under mpirun, in every process.
#include <fmt/format.h>

#include <exception>

#include "app/interrupt.hpp"
#include "app/program.hpp"
#include "app/tiers.hpp"
#include "full3d/full3d_tier.hpp"

namespace {

using namespace tunica;

class FullProgram final : public Program {
 public:
  explicit FullProgram(full3d::Team& team) : tiers_(light_tiers()) {
    tiers_.push_back(std::make_unique<full3d::Full3dTier>(team));
  }
  const TierList& tiers() const override { return tiers_; }
  void before_computing(const std::vector<const Tier*>&) const override {}
  // Only the leader of a job has a program.
  bool speaks() const override { return true; }

 private:
  TierList tiers_;
};

}  // namespace

int main(int argc, char** argv) {
  const full3d::PetscSession session;
  const full3d::Ranks ranks;
  if (ranks.leads()) {
    full3d::Team team(ranks);
    return run_program(argc, argv, FullProgram(team));
  }
  // mpirun tells all processes to end: the leader does so when it has stored what there is.
  ignore_interrupts();
  try {
    full3d::serve(ranks);
  } catch (const std::exception& error) {
    fmt::print(stderr, "tunica: rank {} of {}: {}\n", ranks.rank(), ranks.size(), error.what());
    ranks.abort();
  }
  return 0;
}
