// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumped/multistep.hpp"

#include <cvodes/cvodes.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunmatrix/sunmatrix_band.h>

#include <sundials/sundials_context.hpp>

#include "core/error.hpp"

namespace tunica::lumped {

namespace {

struct FreeVector {
  void operator()(N_Vector v) const { N_VDestroy(v); }
};
using VectorHandle = std::unique_ptr<std::remove_pointer_t<N_Vector>, FreeVector>;
struct FreeMatrix {
  void operator()(SUNMatrix m) const { SUNMatDestroy(m); }
};
using MatrixHandle = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, FreeMatrix>;
struct FreeSolver {
  void operator()(SUNLinearSolver s) const { static_cast<void>(SUNLinSolFree(s)); }
};
using SolverHandle = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, FreeSolver>;
struct FreeMemory {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

/// Absolute tolerance of a sensitivity over its scale, relative to the relative tolerance.
constexpr double absolute_share = 1e-2;

}  // namespace

struct Multistep::Implementation {
  System system;
  std::vector<Sensitivity> carried;
  double tolerance;

  sundials::Context context;
  std::unique_ptr<void, FreeMemory> memory;
  VectorHandle state;
  N_Vector* sensitivities = nullptr;
  N_Vector* sensitivity_absolute = nullptr;
  MatrixHandle matrix;
  SolverHandle solver;
  double now = 0;
  bool started = false;
  IntegratorStatistics before;  ///< of the runs before the last start
  bool interrupted = false;     ///< the right-hand side has asked to end
  std::string complaint;        ///< what the right-hand side said when it could not be computed

  int count() const { return static_cast<int>(carried.size()); }

  ~Implementation() {
    // Clones of `state` need the context, which outlives them as a member declared before.
    if (sensitivities) N_VDestroyVectorArray(sensitivities, count());
    if (sensitivity_absolute) N_VDestroyVectorArray(sensitivity_absolute, count());
  }

  void check(int code, const char* function) const {
    if (code >= 0) return;
    if (interrupted) throw Interrupted();
    const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(code), &std::free);
    throw SolverFailure(fmt::format("{}{}{} reported {}", complaint, complaint.empty() ? "" : "; ", function,
                                    name ? name.get() : "an error"));
  }

  static int rate(double t, N_Vector y, N_Vector ydot, void* data) {
    return static_cast<Implementation*>(data)->guard(
        [&](Implementation& self) { self.system.rate(t, N_VGetArrayPointer(y), N_VGetArrayPointer(ydot)); });
  }

  static int sensitivity_rate(int, double t, N_Vector y, N_Vector, int k, N_Vector s, N_Vector sdot,
                              void* data, N_Vector, N_Vector) {
    return static_cast<Implementation*>(data)->guard([&](Implementation& self) {
      self.system.rate_derivative(t, N_VGetArrayPointer(y), N_VGetArrayPointer(s), self.carried[k].parameter,
                                  N_VGetArrayPointer(sdot));
    });
  }

  static int weights(N_Vector y, N_Vector weight, void* data) {
    auto& self = *static_cast<Implementation*>(data);
    double* w = N_VGetArrayPointer(weight);
    try {
      self.system.magnitudes(N_VGetArrayPointer(y), w);
    } catch (const std::exception& error) {
      self.complaint = error.what();
      return -1;
    }
    for (int i = 0; i < self.system.unknowns; ++i) w[i] = 1 / (self.tolerance * w[i]);
    return 0;
  }

  static int events(double, N_Vector y, double* values, void* data) {
    return static_cast<Implementation*>(data)->guard(
        [&](Implementation& of) { of.system.event_values(N_VGetArrayPointer(y), values); });
  }

  /// An exception must not pass through C: it becomes a recoverable error, upon which CVODES shortens
  /// the step, and its text is kept for the case that no step is short enough.
  template <class Work>
  int guard(Work&& work) {
    try {
      work(*this);
      return 0;
    } catch (const Interrupted&) {
      interrupted = true;
      return -1;  // unrecoverable
    } catch (const std::exception& error) {
      complaint = error.what();
      return 1;
    }
  }
};

Multistep::Multistep(System system, std::vector<Sensitivity> sensitivities, double tolerance)
    : implementation_(std::make_unique<Implementation>()) {
  auto& self = *implementation_;
  self.system = std::move(system);
  self.carried = std::move(sensitivities);
  self.tolerance = tolerance;
  const int n = self.system.unknowns;
  self.state.reset(N_VNew_Serial(n, self.context));
  self.matrix.reset(SUNBandMatrix(n, self.system.bandwidth, self.system.bandwidth, self.context));
  self.solver.reset(SUNLinSol_Band(self.state.get(), self.matrix.get(), self.context));
  self.memory.reset(CVodeCreate(CV_BDF, self.context));
  if (!self.state || !self.matrix || !self.solver || !self.memory)
    throw SolverFailure("CVODES could not be set up: out of memory");
}

Multistep::~Multistep() = default;

void Multistep::start(double time, double end_time, const std::vector<double>& state,
                      const std::vector<std::vector<double>>& sensitivities) {
  auto& self = *implementation_;
  void* memory = self.memory.get();
  const int n = self.system.unknowns, count = self.count();
  std::copy(state.begin(), state.end(), N_VGetArrayPointer(self.state.get()));
  self.now = time;
  self.complaint.clear();
  if (!self.started) {
    self.check(CVodeInit(memory, &Implementation::rate, time, self.state.get()), "CVodeInit");
    self.check(CVodeSetUserData(memory, &self), "CVodeSetUserData");
    self.check(CVodeSetErrFile(memory, nullptr), "CVodeSetErrFile");
    self.check(CVodeWFtolerances(memory, &Implementation::weights), "CVodeWFtolerances");
    self.check(CVodeSetLinearSolver(memory, self.solver.get(), self.matrix.get()), "CVodeSetLinearSolver");
    self.check(CVodeSetMaxNumSteps(memory, steps_at_a_time), "CVodeSetMaxNumSteps");
    // BDF above order 2 is unstable near the imaginary axis, where weakly damped oscillations lie: the
    // step would have to follow each of them.
    if (self.system.oscillates) self.check(CVodeSetMaxOrd(memory, 2), "CVodeSetMaxOrd");
    if (self.system.events > 0)
      self.check(CVodeRootInit(memory, self.system.events, &Implementation::events), "CVodeRootInit");
    self.check(CVodeSetNoInactiveRootWarn(memory), "CVodeSetNoInactiveRootWarn");
    if (count > 0) {
      self.sensitivities = N_VCloneVectorArray(count, self.state.get());
      self.sensitivity_absolute = N_VCloneVectorArray(count, self.state.get());
      if (!self.sensitivities || !self.sensitivity_absolute)
        throw SolverFailure("CVODES could not be set up: out of memory");
    }
  } else {
    self.before = statistics();
    self.check(CVodeReInit(memory, time, self.state.get()), "CVodeReInit");
  }
  for (int k = 0; k < count; ++k)
    std::copy(sensitivities[k].begin(), sensitivities[k].end(), N_VGetArrayPointer(self.sensitivities[k]));
  if (count > 0) {
    if (!self.started) {
      self.check(
          CVodeSensInit1(memory, count, CV_STAGGERED, &Implementation::sensitivity_rate, self.sensitivities),
          "CVodeSensInit1");
      for (int k = 0; k < count; ++k)
        for (int i = 0; i < n; ++i)
          NV_Ith_S(self.sensitivity_absolute[k], i) =
              absolute_share * self.tolerance * self.system.scales[i] * self.carried[k].size;
      self.check(CVodeSensSVtolerances(memory, self.tolerance, self.sensitivity_absolute),
                 "CVodeSensSVtolerances");
      self.check(CVodeSetSensErrCon(memory, SUNTRUE), "CVodeSetSensErrCon");
    } else {
      self.check(CVodeSensReInit(memory, CV_STAGGERED, self.sensitivities), "CVodeSensReInit");
    }
  }
  self.started = true;
  self.check(CVodeSetStopTime(memory, end_time), "CVodeSetStopTime");
}

std::vector<Crossing> Multistep::advance(double time) {
  auto& self = *implementation_;
  void* memory = self.memory.get();
  if (time <= self.now) return {};
  int code = CV_TOO_MUCH_WORK;
  while (code == CV_TOO_MUCH_WORK) {
    const double before = self.now;
    code = CVode(memory, time, self.state.get(), &self.now, CV_NORMAL);
    if (code != CV_TOO_MUCH_WORK) break;
    if (self.system.progress) self.system.progress(self.now, statistics());
    if (self.now - before < least_share * self.system.time_scale)
      throw SolverFailure(fmt::format(
          "{}{}the last {} steps have brought the integration only {:.2g} s farther", self.complaint,
          self.complaint.empty() ? "" : "; ", steps_at_a_time, self.now - before));
  }
  self.check(code, "CVode");
  if (self.count() > 0) {
    double at = self.now;
    self.check(CVodeGetSens(memory, &at, self.sensitivities), "CVodeGetSens");
  }
  std::vector<Crossing> crossings;
  if (code == CV_ROOT_RETURN) {
    std::vector<int> found(self.system.events);
    self.check(CVodeGetRootInfo(memory, found.data()), "CVodeGetRootInfo");
    for (int k = 0; k < self.system.events; ++k)
      if (found[k] != 0) crossings.push_back({k, found[k] > 0});
  }
  return crossings;
}

double Multistep::time() const {
  return implementation_->now;
}
const double* Multistep::state() const {
  return N_VGetArrayPointer(implementation_->state.get());
}
const double* Multistep::sensitivity(int k) const {
  return N_VGetArrayPointer(implementation_->sensitivities[k]);
}

IntegratorStatistics Multistep::statistics() const {
  const auto& self = *implementation_;
  IntegratorStatistics total = self.before;
  if (!self.started) return total;
  long steps = 0, newton = 0, errors = 0, failures = 0;
  self.check(CVodeGetNumSteps(self.memory.get(), &steps), "CVodeGetNumSteps");
  self.check(CVodeGetNumNonlinSolvIters(self.memory.get(), &newton), "CVodeGetNumNonlinSolvIters");
  self.check(CVodeGetNumErrTestFails(self.memory.get(), &errors), "CVodeGetNumErrTestFails");
  self.check(CVodeGetNumNonlinSolvConvFails(self.memory.get(), &failures), "CVodeGetNumNonlinSolvConvFails");
  total.steps += steps;
  total.newton_iterations += newton;
  total.rejected_steps += errors + failures;
  return total;
}

}  // namespace tunica::lumped
