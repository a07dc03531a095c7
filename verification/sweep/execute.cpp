// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/sweep/execute.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "core/error.hpp"
#include "core/threads.hpp"

namespace tunica::sweep {

namespace {

/// A point on its way through the pipeline.
struct Job {
  Row row;
  bool is_ended = false;  ///< false when it was interrupted
};

class Execution {
 public:
  Execution(const Campaign& campaign, const std::filesystem::path& folder, Table& table,
            const SweepControl& control)
      : campaign_(campaign), folder_(folder), table_(table), control_(control), has_row_(table.points()) {
    progress_.count = campaign.shard.share_of(campaign.points.count());
    progress_.ended = has_row_.size();
    progress_.failed = has_row_.size() - table.count(run::name_of(run::Ending::done));
    next_ = campaign.shard.index - 1;
  }

  bool run() {
    // Few more than there are threads: a row that waits for its turn is memory.
    const auto tokens = static_cast<std::size_t>(2 * campaign_.jobs);
    // More jobs than cores are of use where a point waits for processes.
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(campaign_.jobs));
    tbb::task_arena arena(campaign_.jobs);
    control_.report(progress_);
    arena.execute([&] {
      tbb::parallel_pipeline(
          tokens, tbb::make_filter<void, Job>(tbb::filter_mode::serial_in_order,
                                              [this](tbb::flow_control& flow) { return take(flow); }) &
                      tbb::make_filter<Job, Job>(tbb::filter_mode::parallel,
                                                 [this](Job job) { return compute(std::move(job)); }) &
                      tbb::make_filter<Job, void>(tbb::filter_mode::serial_out_of_order,
                                                  [this](const Job& job) { keep(job); }));
    });
    return interrupted_;
  }

 private:
  bool asked_to_stop() {
    if (!interrupted_ && control_.interrupted()) interrupted_ = true;
    return interrupted_;
  }

  Job take(tbb::flow_control& flow) {
    while (done_before_ < has_row_.size() && next_ < campaign_.points.count() &&
           has_row_[done_before_] == next_) {
      ++done_before_;
      next_ += campaign_.shard.count;
    }
    if (next_ >= campaign_.points.count() || asked_to_stop()) {
      flow.stop();
      return {};
    }
    Job job;
    job.row.point = std::exchange(next_, next_ + campaign_.shard.count);
    job.row.keys = campaign_.points.values(job.row.point);
    return job;
  }

  Job compute(Job job) {
    // Cores are shared by points, not within them.
    const ThreadLimit one(1);
    RunControl control;
    control.interrupted = [this] { return asked_to_stop(); };
    const std::string tier = campaign_.points.tier(job.row.point);
    const run::Case what{tier.empty() ? campaign_.tier : tier, overrides(campaign_.points, job.row.keys)};
    const run::Outcome outcome =
        campaign_.keep_runs ? kept(what, job.row.point, control) : asked(what, control);
    job.is_ended = outcome.ending != run::Ending::interrupted;
    job.row.status = run::name_of(outcome.ending);
    job.row.reason = outcome.reason;
    job.row.tier = outcome.tier;
    job.row.seconds = outcome.cost.wall_seconds;
    job.row.numbers = numbers_of(outcome.answer);
    return job;
  }

  run::Outcome asked(const run::Case& what, const RunControl& control) const {
    const run::Question& question = campaign_.question;
    const run::Question offered{question.quantities, offered_keys(campaign_, what.overrides)};
    run::Outcome outcome = campaign_.door.ask(what, offered, control);
    if (offered.keys == question.keys) return outcome;
    outcome.answer.gradients.resize(outcome.answer.values.size());
    for (std::vector<double>& gradient : outcome.answer.gradients) {
      std::vector<double> of_all;
      for (const std::string& key : question.keys) {
        const auto at = std::find(offered.keys.begin(), offered.keys.end(), key);
        of_all.push_back(at == offered.keys.end()
                             ? observables::none
                             : gradient[static_cast<std::size_t>(at - offered.keys.begin())]);
      }
      gradient = std::move(of_all);
    }
    return outcome;
  }

  run::Outcome kept(run::Case what, std::uint64_t point, const RunControl& control) const {
    if (const auto keys = offered_keys(campaign_, what.overrides); !keys.empty())
      what.overrides.push_back(run::sensitivity_override(keys));
    run::Keep keep;
    keep.folder = folder_ / "points" / fmt::format("{}", point);
    run::Outcome outcome = campaign_.door.compute(what, keep, control);
    if (outcome.ending == run::Ending::done)
      outcome.answer = run::answer_of(*outcome.stored, campaign_.question);
    return outcome;
  }

  void keep(const Job& job) {
    if (!job.is_ended) return;
    table_.insert(job.row);
    ++progress_.ended;
    if (job.row.status != run::name_of(run::Ending::done)) ++progress_.failed;
    progress_.last_result = job.row.seconds;
    control_.report(progress_);
  }

  const Campaign& campaign_;
  const std::filesystem::path& folder_;
  Table& table_;
  const SweepControl& control_;
  const std::vector<std::uint64_t> has_row_;  ///< ascending
  std::size_t done_before_ = 0;               ///< of them, that have been passed over
  std::uint64_t next_ = 0;
  std::atomic<bool> interrupted_ = false;
  SweepProgress progress_;
};

}  // namespace

std::vector<std::string> offered_keys(const Campaign& campaign, const std::vector<std::string>& overrides) {
  std::vector<std::string> keys = campaign.question.keys;
  if (keys.empty()) return keys;
  try {
    const auto offered = keys_with_sensitivity(campaign.door.source().with(overrides));
    std::erase_if(keys, [&](const std::string& key) {
      return std::find(offered.begin(), offered.end(), key) == offered.end();
    });
  } catch (const InvalidInput&) {
    // Whoever computes the point says why its values make no scene.
  }
  return keys;
}

bool execute(const Campaign& campaign, const std::filesystem::path& folder, Table& table,
             const SweepControl& control) {
  return Execution(campaign, folder, table, control).run();
}

}  // namespace tunica::sweep
