// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/vessel_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/coupled/failure.hpp"
#include "core/coupled/inlet_watch.hpp"
#include "core/coupled/limit_cycle.hpp"
#include "core/coupled/simulation.hpp"
#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/observables/stops.hpp"
#include "core/root.hpp"

namespace tunica::coupled {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  if (values.empty()) return observables::none;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

time::Method method_from(const std::string& name) {
  if (name == "backward-euler") return time::Method::backward_euler;
  if (name == "generalized-alpha") return time::Method::generalized_alpha;
  return time::Method::bdf2;
}

SimulationOptions options_of(const Scene& scene, Vessel& vessel, double end) {
  const Loading& loading = vessel.loading();
  SimulationOptions options;
  if (scene.has("time.scheme")) options.method = method_from(scene.text("time.scheme"));
  options.tolerance = vessel.local_tolerance();
  options.newton_tolerance = vessel.newton_tolerance();
  options.scales = loading.expected;
  const double period = loading.inlet.period;
  const double fixed = scene.has("time.step") ? scene.number("time.step") : 0;
  options.steps.fixed = fixed > 0;
  if (options.steps.fixed) {
    options.steps.first = options.steps.maximum = fixed;
    options.steps.minimum = fixed / 4096;
  } else {
    options.steps.first = 1e-4 * period;
    // Fibres that are recruited bend the course of things without warning: steps that leave some room are
    // rejected half as often.
    options.steps.safety = options.steps.keep_from = 0.8;
    options.steps.keep_to = 1.6;
    options.steps.maximum = period / 20;
    options.steps.minimum = 1e-9 * period;
  }
  options.jumps = loading.inlet.jumps(end);
  return options;
}

class VesselRun final : public TierRun {
 public:
  VesselRun(const Scene& scene, const std::function<std::unique_ptr<Vessel>()>& make)
      : scene_(scene),
        began_(Clock::now()),
        vessel_(make()),
        loading_(vessel_->loading()),
        is_static_(scene.text("time.mode") == "static"),
        stops_(observables::stops(scene, loading_.inlet.period)),
        end_(stops_.back().time),
        simulation_(vessel_->equations(), options_of(scene, *vessel_, end_)),
        observer_(vessel_->observer()),
        keys_(scene.texts("sensitivity.parameters")),
        log_(event_places(), keys_),
        inlet_watch_(still_velocity * std::numbers::pi * loading_.lumen_radius * loading_.lumen_radius,
                     scene.text("inlet.pressure_kind") == "total") {
    if (!keys_.empty())
      sensitivities_ = std::make_unique<Sensitivities>(vessel_->keyed(vessel_->equations()),
                                                       options_of(scene, *vessel_, end_));
    prepare_tables();
    describe_run();
    result_.record.setup_seconds = seconds_since(began_);
  }

  std::vector<std::string> warnings() const override { return warnings_; }

  Result execute(const RunControl& control) override {
    const auto solving = Clock::now();
    double before = 0;
    if (control.resume) before = control.resume->so_far.record.solve_seconds;
    const auto seconds = [&] { return before + seconds_since(solving); };
    try {
      if (is_static_)
        compute_static(control);
      else
        integrate(control, seconds);
      result_.record.converged = !result_.record.interrupted;
    } catch (const SolverFailure& failure) {
      result_.record.failure = fmt::format("{}: {}", where(), failure.what());
      if (phase_ != Phase::steady)
        result_.record.failure += limit_of_wall(loading_.ring.get(), loading_.expected_pressure);
      result_.record.failure += hint_of_blow();
    } catch (const std::bad_alloc& error) {
      result_.record.failure = fmt::format("{}: {}", where(), memory_ran_out(error));
    }
    log_.store(result_, end_, result_.record.converged && !is_static_);
    count();
    judge_steps();
    if (auto finding = inlet_watch_.finding(); !finding.empty())
      result_.record.findings.push_back(std::move(finding));
    vessel_->conclude(result_.record);
    result_.record.solve_seconds = seconds();
    result_.record.median_step_seconds = median(step_seconds_);
    return std::move(result_);
  }

 private:
  std::vector<observables::EventPlace> event_places() const {
    std::vector<observables::EventPlace> places;
    for (int e = 0; e < observer_.events(); ++e) places.push_back(observer_.event_place(e));
    return places;
  }

  void prepare_tables() {
    result_.observables = observer_.observables_table();
    result_.sensitivities = observables::sensitivity_table(keys_);
    result_.profiles = observables::profile_table();
    result_.along = observer_.along_table();
    if (scene_.number("output.field_interval") > 0) result_.fields = vessel_->fields().empty_series();
    // A checkpoint is made of copies of all that there is: as numbers, packed, and as the file's text.
    constexpr double copies = 5;
    observables::check_output_memory(
        scene_, stops_, result_.observables.columns().size() + result_.sensitivities.columns().size(),
        observables::numbers_of_a_time(result_.fields), copies);
  }

  void describe_run() {
    auto& record = result_.record;
    record.unknowns = simulation_.layout().unknowns();
    vessel_->describe(record);
    if (!is_static_) {
      record.resolution["scheme"] = scene_.text("time.scheme");
      if (scene_.number("time.step") > 0)
        record.resolution["step"] = scene_.number("time.step");
      else
        record.resolution["local_tolerance"] = vessel_->local_tolerance();
    }
    warnings_ = vessel_->warnings();
    record.remarks = scene_.remarks();
    record.remarks.insert(record.remarks.end(), warnings_.begin(), warnings_.end());
  }

  /// A load that is there at once sends a wave through wall and blood that few meshes bear.
  std::string hint_of_blow() const {
    const double at_once = 0.01 * loading_.inlet.period, ramp = loading_.inlet.ramp;
    const bool is_blow = phase_ == Phase::beats && scene_.text("time.start") == "rest" && ramp < at_once &&
                         simulation_.time() < at_once;
    return is_blow ? fmt::format(
                         "; with time.ramp = {:g} s the load comes as a blow, give it a ramp such as "
                         "{:g} s",
                         ramp, loading_.inlet.period / 16)
                   : "";
  }

  /// Where the run stands, as in "the solver gave up ...".
  std::string where() const {
    const double time = simulation_.time();
    switch (phase_) {
      case Phase::steady:
        return is_static_ ? "in the static state" : "at t = 0 s, in the static start";
      case Phase::limit_cycle:
        return fmt::format("at t = {:.6g} s of period {} on the way to the limit cycle", time,
                           cycle_.periods + 1);
      default:
        return fmt::format("at t = {:.6g} s (beat {})", time, beat_at(time));
    }
  }

  /// 1 for the first beat; the end of the run belongs to the last.
  int beat_at(double time) const {
    return static_cast<int>(std::min(1 + std::floor(time / loading_.inlet.period),
                                     static_cast<double>(scene_.integer("time.beats"))));
  }

  void count() {
    auto& record = result_.record;
    const auto& newton = simulation_.newton_counts();
    record.steps = simulation_.step_counts().accepted + static_.load_steps;
    record.rejected_steps = simulation_.step_counts().rejected_by_error +
                            simulation_.step_counts().rejected_by_solver + static_.rejected;
    record.newton_iterations = before_.newton + newton.iterations + static_.coarse.iterations;
    record.linear_iterations =
        before_.linear_iterations + newton.linear_iterations + static_.coarse.linear_iterations;
    record.resolution["factorisations"] =
        before_.factorisations + newton.factorisations + static_.coarse.factorisations;
    if (is_static_ || scene_.text("time.start") != "rest")
      record.resolution["static_guesses_missed"] = static_.guesses_missed;
    record.resolution["factor_entries"] = simulation_.factor_entries();
    record.resolution["least_jacobian"] = simulation_.least_jacobian();
  }

  void sample(double time, std::span<const double> y, bool row, bool profile, bool field) {
    if (row) {
      observer_.append_observables(time, y, result_.observables);
      if (sensitivities_)
        observables::append_sensitivities(result_.sensitivities, time, sensitivities_->sample(time, y));
      inlet_watch_.look(time, vessel_->equations().flow({time, 0, {}}, y, Boundary::inlet));
    }
    if (profile) {
      observer_.append_profile(time, y, result_.profiles);
      observer_.append_along(time, y, result_.along);
    }
    if (field && !result_.fields.empty()) vessel_->fields().append(time, y, result_.fields);
  }

  void compute_static(const RunControl& control) {
    const auto state = steady(watched(control));
    if (state.empty()) {
      result_.record.interrupted = true;
      return;
    }
    sample(0, state, true, true, true);
    vessel_->judge_static(state, result_.record);
  }

  void judge_steps() {
    const double step = is_static_ ? 0 : scene_.number("time.step");
    const long divided = simulation_.step_counts().rejected_by_solver;
    if (step > 0 && divided > 0)
      result_.record.findings.push_back(fmt::format(
          "time.step = {:g} s was too long for Newton's method and was divided {} times; reduce it, "
          "or leave it out so that steps follow accuracy.tolerance",
          step, divided));
  }

  /// What static states and limit cycles ask between steps: tells where the run stands.
  std::function<bool()> watched(const RunControl& control) {
    return [this, &control] {
      control.report({0, 0, end_, simulation_.step_counts().accepted + static_.load_steps,
                      simulation_.newton_counts().iterations});
      return control.interrupted();
    };
  }

  std::vector<double> steady(const std::function<bool()>& interrupted, double time = 0) {
    phase_ = Phase::steady;
    const double tolerance = 1e-5 * vessel_->local_tolerance();
    const auto own = vessel_->steady_mesh();
    if (!own) {
      auto state = static_state(loading_, vessel_->equations(), vessel_->coarser(), simulation_.newton(),
                                time, tolerance, interrupted, static_);
      if (sensitivities_ && !state.empty())
        sensitivities_->start(
            0, steady_sensitivities(sensitivities_->keyed(), simulation_.newton(), time, state));
      return state;
    }
    Newton newton(own->equations());
    newton.set_sizes(simulation_.newton().sizes());
    auto state = static_state(own->loading(), own->equations(), vessel_->coarser(), newton, time, tolerance,
                              interrupted, static_);
    if (sensitivities_ && !state.empty())
      sensitivities_->start(0, steady_sensitivities(*vessel_->keyed(own->equations()), newton, time, state));
    simulation_.newton().set_sizes(newton.sizes());
    static_.coarse += newton.counts();
    return state;
  }

  /// False when the run is to end.
  bool begin(const RunControl& control) {
    LimitCycle begin{std::vector<double>(simulation_.layout().size(), 0.0), {}};
    const std::string& start = scene_.text("time.start");
    const bool periodic = start == "periodic";
    // What has long been in its cycle is charged by the mean.
    if (periodic) begin.state = steady(watched(control), loading_.inlet.time_of_mean());
    if (start == "static") begin.state = steady(watched(control));
    if (periodic && !begin.state.empty()) {
      phase_ = Phase::limit_cycle;
      begin = limit_cycle(simulation_, std::move(begin.state), loading_.inlet.period,
                          scene_.number("accuracy.tolerance"), watched(control), cycle_);
      result_.record.resolution["periods_to_limit_cycle"] = cycle_.periods;
    }
    if (begin.state.empty()) return false;
    phase_ = Phase::beats;
    simulation_.start(0, std::move(begin.state), std::move(begin.rates));
    if (sensitivities_ && start == "rest") sensitivities_->start_at_rest(0, simulation_.state());
    event_values_ = event_values(simulation_.state());
    return true;
  }

  std::vector<double> event_values(std::span<const double> y) const {
    std::vector<double> values(observer_.events());
    observer_.event_values(y, values.data());
    return values;
  }

  template <class Seconds>
  void integrate(const RunControl& control, const Seconds& seconds) {
    if (control.resume) {
      restore(*control.resume);
    } else {
      if (!begin(control)) {
        result_.record.interrupted = true;
        return;
      }
      if (scene_.text("time.start") != "rest") control.save(checkpoint(seconds()));
    }
    if (sensitivities_) simulation_.accompany(sensitivities_.get());
    std::vector<double> between(simulation_.layout().size());
    while (next_stop_ < stops_.size()) {
      if (control.interrupted()) {
        result_.record.interrupted = true;
        return;
      }
      if (simulation_.time() < stops_[next_stop_].time) {
        const auto stepping = Clock::now();
        simulation_.advance(end_);
        step_seconds_.push_back(seconds_since(stepping));
        find_events(between);
      }
      for (; next_stop_ < stops_.size() && stops_[next_stop_].time <= simulation_.time(); ++next_stop_) {
        const observables::Stop& stop = stops_[next_stop_];
        std::span<const double> y = simulation_.state();
        if (stop.time < simulation_.time()) {
          simulation_.interpolate(stop.time, between);
          y = between;
        }
        if (stop.begins_last_beat) begin_last_beat(stop.time, y);
        sample(stop.time, y, stop.is_row, stop.is_profile, stop.is_field);
      }
      control.report({beat_at(simulation_.time()), simulation_.time(), end_,
                      simulation_.step_counts().accepted,
                      before_.newton + simulation_.newton_counts().iterations});
      if (simulation_.at_milestone() && next_stop_ < stops_.size()) control.save(checkpoint(seconds()));
    }
  }

  void begin_last_beat(double time, std::span<const double> y) {
    std::vector<bool> recruited;
    for (const double excess : event_values(y)) recruited.push_back(excess > 0);
    log_.begin_last_beat(time, recruited);
  }

  /// Fibres that passed their threshold within the last step.
  void find_events(std::vector<double>& between) {
    const auto values = event_values(simulation_.state());
    struct Found {
      double time;
      std::size_t place;
      bool recruited;
    };
    std::vector<Found> found;
    for (std::size_t e = 0; e < values.size(); ++e) {
      if ((values[e] > 0) == (event_values_[e] > 0)) continue;
      const auto excess = [&](double time) {
        if (time == simulation_.step_begin()) return event_values_[e];
        if (time == simulation_.time()) return values[e];
        simulation_.interpolate(time, between);
        return event_values(between)[e];
      };
      // A value of exactly 0 counts as not recruited, which the root finder cannot know.
      const double time = values[e] == 0 ? simulation_.time()
                          : event_values_[e] == 0
                              ? simulation_.step_begin()
                              : find_root(excess, simulation_.step_begin(), simulation_.time(), 1e-9);
      found.push_back({time, e, values[e] > 0});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Found& a, const Found& b) { return a.time < b.time; });
    // The last beat may begin within the step.
    for (const Found& event : found) {
      for (std::size_t s = next_stop_; s < stops_.size() && stops_[s].time <= event.time; ++s)
        if (stops_[s].begins_last_beat) {
          std::vector<double> y(simulation_.layout().size());
          simulation_.interpolate(stops_[s].time, y);
          begin_last_beat(stops_[s].time, y);
          stops_[s].begins_last_beat = false;
        }
      log_.record(event.time, event.place, event.recruited, moved(event.time, event.place, between));
    }
    event_values_ = values;
  }

  /// Derivatives by the keys of the time at which fibres pass their threshold.
  std::vector<double> moved(double time, std::size_t place, std::vector<double>& between) {
    if (!sensitivities_) return {};
    const double begin = simulation_.step_begin(), end = simulation_.time(), near = 1e-3 * (end - begin);
    const double before = std::max(begin, time - near), after = std::min(end, time + near);
    const auto excess = [&](double at) {
      simulation_.interpolate(at, between);
      return event_values(between)[place];
    };
    const double speed = (excess(after) - excess(before)) / (after - before);
    simulation_.interpolate(time, between);
    return sensitivities_->event_times(time, between, place, speed);
  }

  Checkpoint checkpoint(double seconds) {
    Checkpoint saved;
    count();
    saved.so_far = result_;
    saved.so_far.record.solve_seconds = seconds;
    log_.store(saved.so_far, end_, false);
    saved.state = {{"simulation", simulation_.save()},
                   {"next_stop", next_stop_},
                   {"last_beat_begun", last_beat_begun()},
                   {"event_values", pack(event_values_)},
                   {"events", log_.save()},
                   {"inlet", pack(inlet_watch_.save())},
                   {"step_seconds", pack(step_seconds_)},
                   {"counts",
                    {result_.record.newton_iterations, result_.record.linear_iterations,
                     result_.record.resolution["factorisations"].get<long>(), static_.load_steps,
                     static_.rejected, static_.guesses_missed}}};
    if (sensitivities_) saved.state["sensitivities"] = sensitivities_->save();
    return saved;
  }

  bool last_beat_begun() const {
    return std::none_of(stops_.begin() + static_cast<std::ptrdiff_t>(next_stop_), stops_.end(),
                        [](const observables::Stop& stop) { return stop.begins_last_beat; });
  }

  void restore(const Checkpoint& saved) {
    const double setup_seconds = result_.record.setup_seconds;
    result_ = saved.so_far;
    result_.record.setup_seconds = setup_seconds;
    result_.record.interrupted = false;
    simulation_.restore(saved.state.at("simulation"));
    next_stop_ = saved.state.at("next_stop");
    if (saved.state.at("last_beat_begun"))
      for (auto& stop : stops_) stop.begins_last_beat = false;
    event_values_ = unpack(saved.state.at("event_values"));
    log_.restore(saved.state.at("events"), result_);
    if (sensitivities_) sensitivities_->restore(saved.state.at("sensitivities"));
    inlet_watch_.restore(unpack(saved.state.at("inlet")));
    step_seconds_ = unpack(saved.state.at("step_seconds"));
    const auto counts = saved.state.at("counts").get<std::vector<long>>();
    before_ = {counts.at(0), counts.at(1), counts.at(2)};
    static_ = {
        static_cast<int>(counts.at(3)), static_cast<int>(counts.at(4)), static_cast<int>(counts.at(5)), {}};
  }

  enum class Phase { steady, limit_cycle, beats };

  const Scene& scene_;
  Clock::time_point began_;
  std::vector<std::string> warnings_;
  std::unique_ptr<Vessel> vessel_;
  Loading& loading_;
  bool is_static_;
  Phase phase_ = Phase::beats;
  std::vector<observables::Stop> stops_;
  double end_;
  Simulation simulation_;
  const Observing& observer_;
  std::vector<std::string> keys_;
  std::unique_ptr<Sensitivities> sensitivities_;  ///< null without keys
  observables::EventLog log_;
  InletWatch inlet_watch_;
  StaticReport static_;
  LimitCycleReport cycle_;
  struct {
    long newton = 0, linear_iterations = 0, factorisations = 0;
  } before_;  ///< the run was resumed
  std::size_t next_stop_ = 0;
  std::vector<double> event_values_;
  std::vector<double> step_seconds_;  ///< wall time of each step after the start, of all that were resumed
  Result result_;
};

}  // namespace

std::unique_ptr<TierRun> vessel_run(const Scene& scene,
                                    const std::function<std::unique_ptr<Vessel>()>& make) {
  return std::make_unique<VesselRun>(scene, make);
}

}  // namespace tunica::coupled
