// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/run/door.hpp"
#include "verification/studies/case_file.hpp"

namespace tunica::verification {

/// A run of the whole program as a user starts it, and what it took when it ran.
struct MeasuredRun {
  StoredResult stored;
  run::Cost cost;

  /// A count of record.json, also of its "resolution"; 0 where there is none.
  long count(const char* key) const;
};

/// Where a study reads and writes.
struct StudyOptions {
  std::filesystem::path source;   ///< the repository: scenes, case files, pages to begin with
  std::filesystem::path out;      ///< pages, pictures and numbers, at the same places as in the repository
  std::filesystem::path program;  ///< tunica
  std::filesystem::path kept;     ///< runs that need not be repeated by the same program
};

/// What a study works with: its cases, the door that computes them, and its files.
class Study {
 public:
  /// Reads the cases of verification/studies/NAME.toml; of an empty name there are none. `tiers` are those
  /// that compute in this process.
  Study(const std::string& name, StudyOptions options, const TierList& tiers);

  const std::vector<StudyCase>& cases(std::string_view group) const { return cases_.group(group); }

  /// By a process of its own, kept. Throws std::runtime_error when it does not come to its end.
  MeasuredRun measured(const StudyCase& of) const;
  /// In this process, kept in a folder of its own below `kept`. Throws std::runtime_error likewise.
  StoredResult stored(const StudyCase& of, const std::string& folder) const;
  /// In this process, not kept, whatever its end.
  run::Outcome computed(const StudyCase& of, const RunControl& control = {}) const;

  /// The door to a case's scene.
  run::Door door(const StudyCase& of, run::DoorOptions options) const;

  std::filesystem::path source(const std::string& file) const { return options_.source / file; }
  /// A file to write; one that is changed in part, such as a page, is there already.
  std::filesystem::path out(const std::string& file) const { return options_.out / file; }
  /// Where runs are kept.
  std::filesystem::path kept(const std::string& file) const { return options_.kept / file; }

 private:
  StudyOptions options_;
  const TierList& tiers_;
  CaseFile cases_;
};

/// Greatest difference of a column over all rows, relative to the reference's range in them; `none` where
/// the law has no such quantity or it does not move. The rows' times have to be the same.
double error_of(const std::string& column, const MeasuredRun& run, const MeasuredRun& reference);

/// Greatest difference of the times at which fibres are recruited or released, s; `none` where the reference
/// has no such times, infinite where the run has more or fewer.
double event_difference(const MeasuredRun& run, const MeasuredRun& reference);

/// The studies, each of which writes a part of the pages in docs and what belongs to it.
void accuracy(const Study& study);
void elastic_tube(const Study& study);
void full3d_vessels(const Study& study);
void full3d_elements(const Study& study);
void full3d_geometry(const Study& study);
void reproduction(const Study& study);
void ripple_runs(const Study& study);
void sweep_study(const Study& study);
void tether_stability(const Study& study);
void torus_ripples(const Study& study);

}  // namespace tunica::verification
