// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "core/run/door.hpp"
#include "verification/sweep/points.hpp"
#include "verification/sweep/table.hpp"

namespace tunica::sweep {

/// A part of a sweep's points: those whose number leaves the rest index - 1 when divided by `count`.
struct Shard {
  std::uint64_t index = 1, count = 1;

  bool is_whole() const { return count == 1; }
  bool has(std::uint64_t point) const { return point % count == index - 1; }
  /// How many of so many points are its own.
  std::uint64_t share_of(std::uint64_t points) const {
    return points / count + (index - 1 < points % count ? 1 : 0);
  }
  /// "2/5"
  std::string text() const;
};
/// Reads "i/n". Throws InvalidInput unless 1 <= i <= n.
Shard parse_shard(const std::string& text);
/// That of a task of a Slurm array, by its environment; none elsewhere.
std::optional<Shard> shard_of_slurm_array();

/// What is computed: the door's scene with every point's values, by a tier.
struct Campaign {
  const run::Door& door;
  std::string tier = "auto";
  Points& points;
  run::Question question;
  Shard shard;
  int jobs = 1;
  bool keep_runs = false;  ///< each point's whole result in FOLDER/points/NUMBER
  bool timings = false;    ///< in sweep.csv
  /// Width of intervals that the number of points is to reach, which then does not tell sweeps apart.
  std::optional<double> until = {};
  bool surrogates = false;  ///< are to be made of the points: SurrogateTable
};

/// How a sweep goes on.
struct SweepProgress {
  std::uint64_t ended = 0, failed = 0;  ///< points with a row, and those of them that are not done
  std::uint64_t count = 0;              ///< points of this shard
  double last_result = 0;               ///< s of the latest point
};
struct SweepControl {
  std::function<void(const SweepProgress&)> report = [](const SweepProgress&) {};
  std::function<bool()> interrupted = [] { return false; };
  bool resume = false;   ///< goes on where a sweep of the same campaign has stopped
  bool replace = false;  ///< begins anew, whatever lies there
};

struct SweepSummary {
  std::uint64_t count = 0, done = 0, gave_up = 0, refused = 0;
  double seconds = 0;  ///< of all points with a row together
  bool interrupted = false;
};

/// Computes what has no row yet and writes FOLDER/sweep.db as points end, then sweep.csv and sweep.json.
/// Throws InvalidInput before any work: when a key or a value at an end of a range is none that the scene
/// takes, when the folder holds a sweep and is neither to be resumed nor replaced, or one of another campaign
/// that is to be resumed; and OutputFailure when a row cannot be written: the rows before are kept.
SweepSummary run_sweep(const Campaign& campaign, const std::filesystem::path& folder,
                       const SweepControl& control);

/// Makes one sweep of the shards in the folders. Throws InvalidInput naming the folder when shards are of
/// different campaigns, of different numbers, there twice, missing, or not complete.
SweepSummary merge(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& out,
                   bool replace);

inline constexpr const char* database_file = "sweep.db";
inline constexpr const char* table_file = "sweep.csv";
inline constexpr const char* campaign_file = "sweep.json";

/// sweep.json of a folder. Throws InvalidInput when it is missing or none.
nlohmann::ordered_json read_campaign(const std::filesystem::path& folder);
/// The table in a folder that has the columns of a sweep.json. Throws as Table does.
Table table_of(const nlohmann::ordered_json& campaign, const std::filesystem::path& folder, Table::Mode mode);
bool holds_sweep(const std::filesystem::path& folder);

}  // namespace tunica::sweep
