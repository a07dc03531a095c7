// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tier.hpp"

namespace tunica {

/// What a program is made of besides its commands.
class Program {
 public:
  virtual ~Program() = default;
  /// The tiers that it has, the cheapest first.
  virtual const TierList& tiers() const = 0;
  /// Called with the tiers that are about to compute, before anything else is done for them: a program that
  /// has one by name only goes over to the one that has it, and does not come back.
  virtual void before_computing(const std::vector<const Tier*>& tiers) const = 0;
  /// False in those processes of an MPI job that leave it to another to speak.
  virtual bool speaks() const = 0;
};

/// Reads the command line and does what it says. Returns the program's exit code (see ExitCode); errors are
/// reported on standard error in one line.
int run_program(int argc, char** argv, const Program& program);

}  // namespace tunica
