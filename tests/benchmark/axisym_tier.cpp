// SPDX-License-Identifier: GPL-3.0-or-later
// Time of the 2D tier on scenes/cylinder.toml: residual, derivative, factorisation, solution, a step, a run.
#include <benchmark/benchmark.h>
#include <sched.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "axisym/assembler.hpp"
#include "axisym/axisym_tier.hpp"
#include "axisym/direct_solver.hpp"
#include "axisym/setup.hpp"
#include "core/coupled/simulation.hpp"
#include "core/error.hpp"

namespace tunica::axisym {
namespace {

using coupled::NewtonCounts;
using coupled::Simulation;
using coupled::SimulationOptions;

Scene cylinder(std::vector<std::string> overrides = {}) {
  overrides.emplace_back("output.field_interval=0");
  return read_scene(std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml", overrides);
}

constexpr double step = 1e-3;

SimulationOptions fixed_steps(const Setup& setup) {
  SimulationOptions options;
  options.steps.fixed = true;
  options.steps.first = options.steps.maximum = step;
  options.steps.minimum = 1e-3 * step;
  options.tolerance = setup.resolution.local_tolerance;
  options.newton_tolerance = setup.resolution.newton_tolerance;
  options.scales = setup.expected;
  return options;
}

/// The tier takes as many threads as the process may use cores.
void use_cores(int count) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  for (int k = 0; k < count; ++k) CPU_SET(k, &cores);
  if (sched_setaffinity(0, sizeof cores, &cores) != 0) throw std::runtime_error("cores cannot be chosen");
}

/// The artery in the middle of its first systole, resolved for 0.1 % (argument: threads).
class Artery : public benchmark::Fixture {
 public:
  using benchmark::Fixture::SetUp;
  using benchmark::Fixture::TearDown;

  void SetUp(benchmark::State& state) override {
    use_cores(static_cast<int>(state.range(0)));
    vessel_ = setup_of(cylinder({"accuracy.tolerance=1e-3"}));
    assembler_ = std::make_unique<Assembler>(vessel_->problem);
    simulation_ = std::make_unique<Simulation>(*assembler_, fixed_steps(*vessel_));
    simulation_->start(0, std::vector<double>(simulation_->layout().size(), 0.0));
    while (simulation_->time() < 0.2) simulation_->advance(1);
    y_ = simulation_->state();
    // Any history gives matrices of this kind.
    history_ = simulation_->rates();
    stage_ = {simulation_->time(), 1.5 / step, history_};
    residual_.resize(simulation_->layout().unknowns());
    matrix_ = assembler_->pattern();
    assembler_->residual(stage_, y_, residual_);
    assembler_->tangent(stage_, y_, matrix_);
  }
  void TearDown(benchmark::State& state) override {
    const auto unknowns = static_cast<double>(simulation_->layout().unknowns());
    state.counters["unknowns"] = unknowns;
    state.counters["unknowns/s"] =
        benchmark::Counter(unknowns * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
    simulation_.reset();
    assembler_.reset();
    vessel_.reset();
  }

 protected:
  std::unique_ptr<axisym::Setup> vessel_;
  std::unique_ptr<Assembler> assembler_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<double> y_, history_, residual_;
  Stage stage_;
  SparseMatrix matrix_;
};

BENCHMARK_DEFINE_F(Artery, residual)(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(assembler_->residual(stage_, y_, residual_));
}
BENCHMARK_REGISTER_F(Artery, residual)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

BENCHMARK_DEFINE_F(Artery, tangent)(benchmark::State& state) {
  for (auto _ : state) assembler_->tangent(stage_, y_, matrix_);
}
BENCHMARK_REGISTER_F(Artery, tangent)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// With the order of pivots known, as from the second one of a run on.
BENCHMARK_DEFINE_F(Artery, factorisation)(benchmark::State& state) {
  DirectSolver solver;
  if (!solver.factorise(matrix_)) throw SolverFailure("the derivative is singular");
  for (auto _ : state) benchmark::DoNotOptimize(solver.factorise(matrix_));
  state.counters["entries"] = solver.entries();
}
BENCHMARK_REGISTER_F(Artery, factorisation)
    ->ArgName("threads")
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

BENCHMARK_DEFINE_F(Artery, solution)(benchmark::State& state) {
  DirectSolver solver;
  if (!solver.factorise(matrix_)) throw SolverFailure("the derivative is singular");
  for (auto _ : state) solver.solve(residual_);
}
BENCHMARK_REGISTER_F(Artery, solution)
    ->ArgName("threads")
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// Steps of 1 ms from there on, one after another.
BENCHMARK_DEFINE_F(Artery, step)(benchmark::State& state) {
  const NewtonCounts before = simulation_->newton_counts();
  for (auto _ : state) simulation_->advance(simulation_->time() + 2 * step);
  const NewtonCounts& after = simulation_->newton_counts();
  const auto per_step = [&](long count) {
    return benchmark::Counter(static_cast<double>(count), benchmark::Counter::kAvgIterations);
  };
  state.counters["Newton iterations"] = per_step(after.iterations - before.iterations);
  state.counters["factorisations"] = per_step(after.factorisations - before.factorisations);
}
BENCHMARK_REGISTER_F(Artery, step)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// The scene from start to end, without files, at accuracy.tolerance = 1 / `one_in`.
void run(benchmark::State& state) {
  constexpr std::array laws{"EXP1", "EXP2", "EXP1+EXP2-ZS", "EXP1+EXP2-FS"};
  const std::string law = laws[static_cast<std::size_t>(state.range(0))];
  const double tolerance = 1.0 / static_cast<double>(state.range(1));
  use_cores(static_cast<int>(state.range(2)));
  const Scene scene = cylinder({"wall.law=" + law, "accuracy.tolerance=" + std::to_string(tolerance)});
  RunRecord record;
  for (auto _ : state) {
    record = AxisymTier().prepare(scene)->execute({}).record;
    if (!record.failure.empty()) throw SolverFailure(record.failure);
  }
  state.SetLabel(law);
  state.counters["unknowns"] = static_cast<double>(record.unknowns);
  state.counters["steps"] = static_cast<double>(record.steps);
}
BENCHMARK(run)
    ->ArgNames({"law", "one_in", "threads"})
    ->ArgsProduct({{0, 1, 2, 3}, {100, 1000}, {1, 2}})
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

}  // namespace
}  // namespace tunica::axisym
