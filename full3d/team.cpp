// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/team.hpp"

#include <array>
#include <map>

#include "core/error.hpp"
#include "full3d/setup.hpp"
#include "full3d/tangent_stability.hpp"

namespace tunica::full3d {

namespace {

enum Order : int {
  go,
  open_problem,
  drop_problem,
  compute_residual,
  compute_factors,
  compute_solution,
  compute_least_mode
};

/// What goes with an order: the number of the problem, and whether there are a history and a given mesh.
struct Note {
  int order = go;
  int problem = 0;
  int with_history = 0;
  int with_mesh = 0;

  void broadcast(const Ranks& ranks) {
    std::array<int, 4> numbers{order, problem, with_history, with_mesh};
    ranks.broadcast(numbers);
    order = numbers[0];
    problem = numbers[1];
    with_history = numbers[2];
    with_mesh = numbers[3];
  }
};

using StageNumbers = std::array<double, 3 + coupled::boundaries>;

class TeamAnnouncer final : public Announcer {
 public:
  TeamAnnouncer(const Ranks& ranks, int problem) : ranks_(ranks), problem_(problem) {}
  ~TeamAnnouncer() override { Note{drop_problem, problem_}.broadcast(ranks_); }

  void residual(const LoadedStage& stage, std::span<const double> y) override {
    announce(compute_residual, stage, y);
  }
  void factorise(const LoadedStage& stage, std::span<const double> y) override {
    announce(compute_factors, stage, y);
  }
  void least_mode(const LoadedStage& stage, std::span<const double> y) override {
    announce(compute_least_mode, stage, y);
  }
  void solve() override { Note{compute_solution, problem_}.broadcast(ranks_); }

 private:
  void announce(Order order, const LoadedStage& at, std::span<const double> y) {
    const bool with_history = !at.stage.history.empty(), with_mesh = !at.stage.mesh.empty();
    Note{order, problem_, with_history ? 1 : 0, with_mesh ? 1 : 0}.broadcast(ranks_);
    StageNumbers numbers{at.stage.time, at.stage.coefficient, at.stage.wall_pressure_bound};
    std::copy(at.pressure.begin(), at.pressure.end(), numbers.begin() + 3);
    ranks_.broadcast(numbers);
    // A broadcast does not change what its root sends.
    const auto send = [&](std::span<const double> values) {
      ranks_.broadcast(std::span<double>(const_cast<double*>(values.data()), values.size()));
    };
    send(y);
    if (with_history) send(at.stage.history);
    if (!with_mesh) return;
    send(at.stage.mesh);
    send(at.stage.mesh_rate);
  }

  const Ranks& ranks_;
  int problem_;
};

using ResolutionNumbers = std::array<int, 5>;  ///< and whether the mesh lags

/// A problem on a rank that serves.
struct Served {
  Served(const Scene& scene, const Resolution& resolution, bool lagged_mesh, const Ranks& ranks)
      : setup(setup_of(scene, resolution)),
        layout(layout_with(lagged_mesh)),
        share(setup->problem, layout, ranks, solver_of(scene)),
        y(layout.size()),
        history(layout.size()),
        mesh(layout.velocity_begin()),
        mesh_rate(mesh.size()),
        residual(layout.unknowns()) {}

  Layout layout_with(bool lagged_mesh) {
    setup->problem.discretisation.lagged_mesh = lagged_mesh;
    return layout_of(setup->problem);
  }

  LoadedStage receive(const Ranks& ranks, const Note& note) {
    StageNumbers numbers{};
    ranks.broadcast(numbers);
    ranks.broadcast(y);
    if (note.with_history != 0) ranks.broadcast(history);
    if (note.with_mesh != 0)
      for (auto* part : {&mesh, &mesh_rate}) ranks.broadcast(*part);
    LoadedStage at{{numbers[0], numbers[1], {}}, {}};
    at.stage.wall_pressure_bound = numbers[2];
    if (note.with_history != 0) at.stage.history = history;
    if (note.with_mesh != 0) {
      at.stage.mesh = mesh;
      at.stage.mesh_rate = mesh_rate;
    }
    std::copy(numbers.begin() + 3, numbers.end(), at.pressure.begin());
    return at;
  }

  std::unique_ptr<Setup> setup;
  Layout layout;
  Share share;
  std::vector<double> y, history, mesh, mesh_rate, residual;
};

}  // namespace

Team::~Team() {
  if (ranks_.size() > 1) Note{}.broadcast(ranks_);
}

std::unique_ptr<Announcer> Team::open(const Scene& scene, const Resolution& resolution, bool lagged_mesh) {
  if (ranks_.size() == 1) return nullptr;
  Note{open_problem, opened_}.broadcast(ranks_);
  for (std::string text : {describe(scene), scene.name(), scene.folder().string()}) ranks_.broadcast(text);
  ResolutionNumbers numbers{resolution.wall_cells, resolution.blood_cells, resolution.axial_cells,
                            resolution.around_cells, lagged_mesh ? 1 : 0};
  ranks_.broadcast(numbers);
  return std::make_unique<TeamAnnouncer>(ranks_, opened_++);
}

void serve(const Ranks& ranks) {
  std::map<int, std::unique_ptr<Served>> problems;
  for (;;) {
    Note note;
    note.broadcast(ranks);
    switch (note.order) {
      case open_problem: {
        std::string text, name, folder;
        for (std::string* part : {&text, &name, &folder}) ranks.broadcast(*part);
        ResolutionNumbers numbers{};
        ranks.broadcast(numbers);
        const Scene scene = parse_scene(text, name, folder);
        Resolution resolution = full3d::resolution(scene);
        resolution.wall_cells = numbers[0];
        resolution.blood_cells = numbers[1];
        resolution.axial_cells = numbers[2];
        resolution.around_cells = numbers[3];
        problems[note.problem] = std::make_unique<Served>(scene, resolution, numbers[4] != 0, ranks);
        break;
      }
      case drop_problem:
        problems.erase(note.problem);
        break;
      case compute_residual: {
        Served& served = *problems.at(note.problem);
        const LoadedStage at = served.receive(ranks, note);
        served.share.residual(at, served.y, served.residual);
        break;
      }
      case compute_factors: {
        Served& served = *problems.at(note.problem);
        const LoadedStage at = served.receive(ranks, note);
        try {
          served.share.factorise(at, served.y);
        } catch (const SolverFailure&) {
          // The leader tells.
        }
        break;
      }
      case compute_least_mode: {
        Served& served = *problems.at(note.problem);
        const LoadedStage at = served.receive(ranks, note);
        try {
          least_mode(served.share, served.setup->problem, served.layout, ranks, at, served.y);
        } catch (const SolverFailure&) {
          // The leader tells.
        }
        break;
      }
      case compute_solution:
        problems.at(note.problem)->share.solve({});
        break;
      default:
        return;
    }
  }
}

}  // namespace tunica::full3d
