// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumped/lumped_tier.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/observables/stops.hpp"
#include "core/radial/limit_load.hpp"
#include "core/scene/unused.hpp"
#include "core/units.hpp"
#include "lumped/collocation.hpp"
#include "lumped/limit_cycle.hpp"
#include "lumped/multistep.hpp"
#include "lumped/network.hpp"
#include "lumped/observer.hpp"
#include "lumped/recruitment_log.hpp"
#include "lumped/steady_state.hpp"
#include "lumped/wall_fields.hpp"

namespace tunica::lumped {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Local tolerance of the integrator for a scene's tolerance. Local errors add up over some hundred steps,
/// and the stress in fibres shows more of them than the pressure: hence the factor.
double local_tolerance(const Scene& scene) {
  return std::clamp(2e-3 * scene.number("accuracy.tolerance"), 1e-11, 1e-4);
}

/// The same where the error that is controlled is that of a formula of lower order than the step's own.
double collocation_tolerance(const Scene& scene) {
  return std::clamp(1e-2 * scene.number("accuracy.tolerance"), 1e-10, 1e-3);
}

/// Rows that the quantities of the last beat are taken from: so many that the parabolas through their
/// extremes are as good as the scene asks.
std::vector<observables::Stop> stops_for_answer(const Scene& scene, double period) {
  // Its error falls with the fourth power; that of 288 rows is 5e-4 of the range of H, the sharpest of all.
  const double tolerance = std::clamp(scene.number("accuracy.tolerance"), 1e-9, 1e-3);
  const int rows = 4 * static_cast<int>(std::ceil(72 * std::pow(1e-3 / tolerance, 0.25)));
  const double begin = static_cast<double>(scene.integer("time.beats") - 1) * period;
  std::vector<observables::Stop> stops;
  for (int k = 0; k <= rows; ++k) {
    observables::Stop stop{k == rows ? begin + period : begin + k * period / rows};
    stop.is_row = true;
    stop.begins_last_beat = k == 0;
    stops.push_back(stop);
  }
  return stops;
}

Looked looked_at(const run::Question& question) {
  Looked looked;
  looked.in_tables = true;
  for (int p = 0; p < observables::wall_points; ++p) {
    const auto is_asked = [&](std::initializer_list<std::string_view> names) {
      return std::any_of(question.quantities.begin(), question.quantities.end(), [&](const auto& one) {
        const std::string_view observable = one.observable;
        return std::any_of(names.begin(), names.end(), [&](std::string_view name) {
          if (!observable.starts_with(name)) return false;
          const auto point = observable.substr(name.size());
          return point.empty() || (point.starts_with(".P") && point.back() == '1' + p);
        });
      });
    };
    looked.von_mises[p] = is_asked({"von_mises"});
    looked.fibers[p] = is_asked({"fiber_angle", "fiber_stretch", "recruitment"});
  }
  return looked;
}

/// One run of the tier: the network, its integrator and the tables that it fills.
class LumpedRun final : public TierRun {
 public:
  /// Of which only what the question needs is looked at: rows of the last beat, and events.
  LumpedRun(const Scene& scene, const run::Question& question)
      : scene_(scene),
        began_(Clock::now()),
        network_(scene, {}),
        observer_(network_),
        stops_(stops_for_answer(scene, network_.inlet().period)),
        tolerance_(local_tolerance(scene)),
        looked_(looked_at(question)),
        is_answer_(true),
        log_(network_, {}) {
    result_.observables = observables::standard_table();
    prepare_curve();
  }

  explicit LumpedRun(const Scene& scene)
      : scene_(scene),
        began_(Clock::now()),
        parameters_(scene.texts("sensitivity.parameters")),
        network_(scene, parameters_),
        observer_(network_),
        wall_fields_(std::in_place, network_.curve().model(), scene.number("geometry.length")),
        stops_(observables::stops(scene, network_.inlet().period)),
        tolerance_(local_tolerance(scene)),
        log_(network_, parameters_) {
    check_profile_times();
    prepare_tables();
    prepare_curve();
    result_.record.setup_seconds = seconds_since(began_);
  }

  std::vector<std::string> warnings() const override { return warnings_; }

  double time() const { return time_; }

  Result execute(const RunControl& control) override {
    const auto solving = Clock::now();
    try {
      integrate(control);
      result_.record.converged = !result_.record.interrupted;
    } catch (const Interrupted&) {
      result_.record.interrupted = true;
    } catch (const SolverFailure& failure) {
      result_.record.failure =
          fmt::format("at t = {:.6g} s (beat {}): {}", time_, beat_at(time_), reason(failure));
    } catch (const std::bad_alloc& error) {
      result_.record.failure =
          fmt::format("at t = {:.6g} s (beat {}): {}", time_, beat_at(time_), memory_ran_out(error));
    }
    std::move(log_).store(result_);
    result_.record.solve_seconds = seconds_since(solving);
    return std::move(result_);
  }

 private:
  void check_profile_times() const {
    for (const double within : scene_.numbers("output.profile_times"))
      if (within >= network_.inlet().period)
        throw InvalidInput(
            fmt::format("output.profile_times: {} s is not within a beat of {} s; give times below that",
                        within, network_.inlet().period));
  }

  void prepare_tables() {
    result_.observables = observables::standard_table();
    result_.profiles = observables::profile_table();
    if (scene_.number("output.field_interval") > 0) result_.fields.push_back(wall_fields_->empty_series());
    result_.sensitivities = observables::sensitivity_table(parameters_);
    if (network_.compartments() > 1) result_.compartments = observer_.compartment_table();
    std::size_t columns = 0;
    for (const auto* table : {&result_.observables, &result_.sensitivities, &result_.compartments})
      columns += table->columns().size();
    observables::check_output_memory(scene_, stops_, columns, observables::numbers_of_a_time(result_.fields),
                                     1);
    auto& record = result_.record;
    record.tier = "lumped";
    record.resolution = {{"compartments", scene_.integer("lumped.compartments")},
                         {"local_relative_tolerance", tolerance_},
                         {"wall_points", observables::wall_points}};
    record.unknowns = network_.unknowns();
    const scene::Unused of_meshes{
        {"geometry.ends", "inlet.profile", "inlet.pressure_kind", "mesh.", "outlet.backflow", "solver.",
         "time.scheme", "time.step"},
        "the tier is lumped, without ends, cells and sections, and chooses its steps"};
    warnings_ = scene::remarks_on(scene_, {&of_meshes, 1});
    record.remarks = scene_.remarks();
    record.remarks.insert(record.remarks.end(), warnings_.begin(), warnings_.end());
    record.remarks.emplace_back(
        "0D tier: the clamped ends, the wall's inertia and entrance flow are not modelled");
    if (!scene_.flag("lumped.inertance"))
      record.remarks.emplace_back(
          "0D tier: the blood's inertia is not modelled (lumped.inertance = true adds it)");
    if (scene_.number("accuracy.tolerance") < 0.03)
      record.remarks.emplace_back(
          "0D tier: accuracy.tolerance holds for the solution of its equations; what the model leaves out is "
          "worth a few per cent");
    if (scene_.text("geometry.kind") == "torus")
      record.remarks.emplace_back(
          "0D tier: the bend is not modelled, the torus is computed as a straight artery of its length");
  }

  /// What the solver said, preceded by the physical reason where there is one: that the wall cannot carry the
  /// pressure that the inflow asks for at the outlet's resistance, or that it has been opened beyond what it
  /// carries most at.
  std::string reason(const SolverFailure& failure) const {
    try {
      return physical_reason(failure);
    } catch (const SolverFailure&) {
      // How much the wall carries is not known where its response cannot be computed.
      return failure.what();
    }
  }

  std::string physical_reason(const SolverFailure& failure) const {
    constexpr double nearly = 0.98;
    const auto& inlet = network_.inlet();
    const bool is_periodic = phase_ == Phase::to_limit_cycle;
    // On the limit cycle the mean flow passes the outlet, on the way there at every moment what comes in
    // but for what the compliances take.
    const double flow = network_.inlet_scale() * (is_periodic ? 1 : inlet.shape_at(time_));
    double resistance = scene_.number("outlet.resistance");
    const bool is_rcr = scene_.text("outlet.kind") == "rcr";
    if (is_rcr && is_periodic) resistance += scene_.number("outlet.proximal_resistance");
    const double asked = scene_.number("outlet.pressure") + resistance * flow;
    const bool is_known = !inlet.is_pressure && (is_periodic || !is_rcr);
    const auto limit = radial::limit_load(network_.curve().model(), radial::WallCurve::greatest_stretch);
    if (limit && is_known && asked > limit->pressure)
      return fmt::format(
          "the wall has no equilibrium at {:.4g} mmHg, the pressure that the inflow asks for: it carries at "
          "most {:.4g} mmHg, at lumen stretch {:.4g} ({})",
          asked / mmhg, limit->pressure / mmhg, limit->stretch, failure.what());
    if (limit && !is_periodic && stretch_ > nearly * limit->stretch)
      return fmt::format(
          "the lumen has been opened to a stretch of {:.4g}, where the wall gives way: it carries at "
          "most {:.4g} mmHg, at lumen stretch {:.4g} ({})",
          stretch_, limit->pressure / mmhg, limit->stretch, failure.what());
    if (limit || !is_known) return failure.what();
    try {
      const double stretch = nearly * radial::WallCurve::greatest_stretch;
      const double carried = network_.curve().model().respond(stretch, {}, false).pressure;
      if (asked > carried)
        return fmt::format(
            "the inflow asks for {:.4g} mmHg at the outlet's resistance, and at lumen stretch {:.3g}, about "
            "the largest that is computed, the wall carries {:.4g} mmHg ({})",
            asked / mmhg, stretch, carried / mmhg, failure.what());
    } catch (const SolverFailure&) {
      // Nothing is known there, so nothing is said of it.
    }
    return failure.what();
  }

  /// Tabulates the stretches that the run will see, estimated from the outlet's resistance, so that the
  /// integration only evaluates; what lies outside is added when it is met.
  void prepare_curve() {
    const auto& curve = network_.curve();
    const double inlet = std::abs(network_.inlet_scale()) * network_.inlet().greatest_shape();
    const double resistance = scene_.number("outlet.resistance");
    const double pressure =
        network_.inlet().is_pressure ? inlet : scene_.number("outlet.pressure") + resistance * inlet;
    try {
      curve.prepare(1.0, curve.stretch_at(0.97 * pressure));
    } catch (const SolverFailure&) {
      // The run itself finds out whether it gets there, and how far.
    }
  }

  /// Expected size of dy/dtheta over the unknowns' scales: 1/|theta|, or for a parameter that is 0 the
  /// forcing that it exerts within a second.
  double sensitivity_size(int k) const {
    const double value = std::abs(scene_.number(parameters_[k]));
    if (value > 0) return 1 / value;
    // As open as the artery comes to be under its load.
    std::vector<double> y = network_.scales(), none(y.size(), 0.0), rates(y.size());
    network_.rate_derivative(0.5 * network_.inlet().period, y.data(), none.data(), k, rates.data());
    const auto scales = network_.scales();
    double size = 0;
    for (std::size_t i = 0; i < rates.size(); ++i) size = std::max(size, std::abs(rates[i]) / scales[i]);
    return size > 0 ? size : 1.0;
  }

  System system(const RunControl& control) {
    System s;
    s.unknowns = network_.unknowns();
    s.bandwidth = network_.bandwidth();
    s.time_scale = network_.inlet().period;
    s.scales = network_.scales();
    s.magnitudes = [this](const double* y, double* result) { network_.magnitudes(y, result); };
    s.progress = [this, &control](double t, const IntegratorStatistics& so_far) {
      count(so_far);
      tell(control, t);
    };
    // Waves run to and fro between compartments; a single one is damped by its outlet.
    s.oscillates = scene_.flag("lumped.inertance") &&
                   (scene_.integer("lumped.compartments") > 1 || network_.inlet().is_pressure);
    s.rate = [this, &control](double t, const double* y, double* rate) {
      if (control.interrupted()) throw Interrupted();
      network_.rate(t, y, rate);
    };
    s.rate_derivative = [this](double t, const double* y, const double* dy, int k, double* result) {
      network_.rate_derivative(t, y, dy, k, result);
    };
    s.events = log_.events();
    s.event_values = [this](const double* y, double* values) { log_.event_values(y, values); };
    return s;
  }

  /// An answer asks for more rows than a system of a few unknowns takes steps; waves between compartments are
  /// best left to formulas that damp them.
  std::unique_ptr<Integrator> integrator_for(const System& system,
                                             const std::vector<Sensitivity>& carried) const {
    if (is_answer_ && !system.oscillates && system.unknowns <= Collocation::most_unknowns)
      return std::make_unique<Collocation>(system, collocation_tolerance(scene_));
    return std::make_unique<Multistep>(system, carried, tolerance_);
  }

  void integrate(const RunControl& control) {
    std::vector<Sensitivity> carried;
    for (int k = 0; k < network_.parameters(); ++k) carried.push_back({k, sensitivity_size(k)});
    const System s = system(control);
    std::vector<double> state = network_.rest();
    std::vector<std::vector<double>> derivatives;
    for (int k = 0; k < network_.parameters(); ++k) derivatives.push_back(network_.rest_derivative(k));
    const auto begin_on = [&](auto found) {
      state = std::move(found.state);
      derivatives = std::move(found.derivatives);
      before_ = found.statistics;
    };
    const double period = network_.inlet().period;
    const std::string start = scene_.text("time.start");
    phase_ = start == "static"     ? Phase::to_static_start
             : start == "periodic" ? Phase::to_limit_cycle
                                   : Phase::beats;
    if (phase_ == Phase::to_static_start)
      begin_on(find_steady_state(s, state, 0, period, carried));
    else if (phase_ == Phase::to_limit_cycle)
      begin_on(find_limit_cycle(s, guess_of_limit_cycle(s), period, carried, tolerance_));
    phase_ = Phase::beats;

    const auto chosen = integrator_for(s, carried);
    Integrator& integrator = *chosen;
    const double end = stops_.back().time, round_off = 1e-12 * end;
    // Where the inlet jumps a new integration begins: in a steady state steps grow so long that one would
    // pass over a whole pulse without meeting it.
    std::vector<double> ends = network_.inlet().jumps(end);
    ends.push_back(end);
    auto next_end = ends.begin();
    integrator.start(0, *next_end, state, derivatives);
    for (const observables::Stop& stop : stops_) {
      while (stop.time - integrator.time() > round_off) {
        const auto crossings = advance(integrator, std::min(stop.time, *next_end));
        for (const Crossing& crossing : crossings) {
          log_.record(integrator, crossing);
          // Recruitment all but jumps there.
          const bool between_rows = stop.is_row && !stop.begins_last_beat && time_ < stop.time;
          if (is_answer_ && between_rows && time_ > last_row()) append_row(integrator, time_);
        }
        if (time_ < *next_end || time_ >= end) continue;
        state.assign(integrator.state(), integrator.state() + s.unknowns);
        for (int k = 0; k < network_.parameters(); ++k)
          derivatives[k].assign(integrator.sensitivity(k), integrator.sensitivity(k) + s.unknowns);
        integrator.start(time_, *++next_end, state, derivatives);
      }
      if (stop.begins_last_beat) log_.begin_last_beat(stop.time, integrator.state());
      record_stop(integrator, stop);
      count(integrator.statistics());
      tell(control, stop.time);
      if (control.interrupted()) throw Interrupted();
    }
    log_.end_last_beat(end);
  }

  /// The steady state of the inlet's first value, from which no waves set out that a whole beat would have to
  /// be followed for; rest where there is none.
  std::vector<double> guess_of_limit_cycle(const System& system) const {
    try {
      return find_steady_state(system, network_.rest(), 0, network_.inlet().period, {}).state;
    } catch (const SolverFailure&) {
      return network_.rest();
    }
  }

  std::vector<Crossing> advance(Integrator& integrator, double time) {
    const auto arrive = [&] {
      time_ = integrator.time();
      stretch_ = network_.greatest_stretch(integrator.state());
    };
    try {
      auto crossings = integrator.advance(time);
      arrive();
      return crossings;
    } catch (const SolverFailure&) {
      arrive();
      throw;
    }
  }

  void count(const IntegratorStatistics& so_far) {
    result_.record.steps = before_.steps + so_far.steps;
    result_.record.newton_iterations = before_.newton_iterations + so_far.newton_iterations;
    result_.record.rejected_steps = before_.rejected_steps + so_far.rejected_steps;
  }

  void tell(const RunControl& control, double time) const {
    const bool on_the_way = phase_ != Phase::beats;
    control.report({on_the_way ? 0 : beat_at(time), on_the_way ? 0.0 : time, stops_.back().time,
                    result_.record.steps, result_.record.newton_iterations});
  }

  double last_row() const { return result_.observables[0].values.back(); }

  void append_row(const Integrator& integrator, double time) {
    observables::append(result_.observables, observer_.sample(time, integrator.state(), looked_));
  }

  void record_stop(const Integrator& integrator, const observables::Stop& stop) {
    const double* y = integrator.state();
    if (stop.is_row) {
      append_row(integrator, stop.time);
      if (!parameters_.empty())
        observer_.append_sensitivities(stop.time, y, sensitivities(integrator), result_.sensitivities);
      if (network_.compartments() > 1 && !is_answer_)
        observer_.append_compartments(stop.time, y, result_.compartments);
    }
    if (stop.is_profile) observer_.append_profile(stop.time, y, result_.profiles);
    if (stop.is_field) wall_fields_->append(stop.time, network_.mid_stretch(y), result_.fields.front());
  }

  std::vector<const double*> sensitivities(const Integrator& integrator) const {
    std::vector<const double*> all;
    for (int k = 0; k < network_.parameters(); ++k) all.push_back(integrator.sensitivity(k));
    return all;
  }

  /// 1 for the first beat; the end of the run belongs to the last.
  int beat_at(double time) const {
    return static_cast<int>(std::min(1 + std::floor(time / network_.inlet().period),
                                     static_cast<double>(scene_.integer("time.beats"))));
  }

  const Scene& scene_;
  Clock::time_point began_;
  std::vector<std::string> parameters_;
  Network network_;
  Observer observer_;
  std::optional<WallFields> wall_fields_;
  std::vector<observables::Stop> stops_;
  double tolerance_;
  Looked looked_;
  bool is_answer_ = false;  ///< to a question: rows of the last beat only
  /// What is computed: a state to begin with, or the beats.
  enum class Phase { to_static_start, to_limit_cycle, beats };
  Phase phase_ = Phase::beats;
  double time_ = 0, stretch_ = 1;  ///< that the beats have come to
  IntegratorStatistics before_;    ///< of the search for the state to begin with
  RecruitmentLog log_;
  std::vector<std::string> warnings_;
  Result result_;
};

}  // namespace

std::string LumpedTier::refusal(const Scene& scene) const {
  if (scene.text("geometry.kind") == "mesh")
    return "geometry.kind = \"mesh\" has no single cross-section; use --tier axisym (half planes) or full3d "
           "(volumes), or give a cylinder";
  if (scene.text("time.mode") == "static")
    return "time.mode = \"static\" is for the tiers with a mesh; use --tier axisym";
  return {};
}

bool LumpedTier::suits(const Scene& scene) const {
  // A pulse travels as a wave, which needs inertia.
  if (scene.text("inlet.waveform") == "pulse" && !scene.flag("lumped.inertance")) return false;
  return scene.text("geometry.kind") == "cylinder" && scene.text("time.mode") == "transient";
}

std::optional<run::Answer> LumpedTier::answer(const Scene& scene, const run::Question& question,
                                              const RunControl& control) const {
  // Derivatives are carried by whole runs.
  if (!question.keys.empty()) return {};
  if (const std::string reason = refusal(scene); !reason.empty()) throw InvalidInput(reason);
  LumpedRun run(scene, question);
  const Result result = run.execute(control);
  if (result.record.interrupted) throw Interrupted();
  if (!result.record.failure.empty()) throw SolverFailure(result.record.failure, run.time());
  return run::answer_of(result, observables::last_beat(scene, result.observables), question);
}

std::unique_ptr<TierRun> LumpedTier::prepare(const Scene& scene) const {
  return std::make_unique<LumpedRun>(scene);
}

}  // namespace tunica::lumped
