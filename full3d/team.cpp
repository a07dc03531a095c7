// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/team.hpp"

#include <array>
#include <map>

#include "full3d/setup.hpp"

namespace tunica::full3d {

namespace {

enum Order : int { go, open_problem, drop_problem, compute_residual, compute_factors, compute_solution };

/// What goes with an order: the number of the problem, and whether there is a history.
struct Note {
  int order = go;
  int problem = 0;
  int with_history = 0;

  void broadcast(const Ranks& ranks) {
    std::array<int, 3> numbers{order, problem, with_history};
    ranks.broadcast(numbers);
    order = numbers[0];
    problem = numbers[1];
    with_history = numbers[2];
  }
};

using StageNumbers = std::array<double, 2 + coupled::boundaries>;

class TeamAnnouncer final : public Announcer {
 public:
  TeamAnnouncer(const Ranks& ranks, int problem) : ranks_(ranks), problem_(problem) {}
  ~TeamAnnouncer() override { Note{drop_problem, problem_, 0}.broadcast(ranks_); }

  void residual(const LoadedStage& stage, std::span<const double> y) override {
    announce(compute_residual, stage, y);
  }
  void factorise(const LoadedStage& stage, std::span<const double> y) override {
    announce(compute_factors, stage, y);
  }
  void solve() override { Note{compute_solution, problem_, 0}.broadcast(ranks_); }

 private:
  void announce(Order order, const LoadedStage& at, std::span<const double> y) {
    const bool with_history = !at.stage.history.empty();
    Note{order, problem_, with_history ? 1 : 0}.broadcast(ranks_);
    StageNumbers numbers{at.stage.time, at.stage.coefficient};
    std::copy(at.pressure.begin(), at.pressure.end(), numbers.begin() + 2);
    ranks_.broadcast(numbers);
    // A broadcast does not change what its root sends.
    const auto send = [&](std::span<const double> values) {
      ranks_.broadcast(std::span<double>(const_cast<double*>(values.data()), values.size()));
    };
    send(y);
    if (with_history) send(at.stage.history);
  }

  const Ranks& ranks_;
  int problem_;
};

using ResolutionNumbers = std::array<int, 4>;

/// A problem on a rank that serves.
struct Served {
  Served(const Scene& scene, const Resolution& resolution, const Ranks& ranks)
      : setup(setup_of(scene, resolution)),
        layout(layout_of(setup->problem)),
        share(setup->problem, layout, ranks, solver_of(scene)),
        y(layout.size()),
        history(layout.size()),
        residual(layout.unknowns()) {}

  LoadedStage receive(const Ranks& ranks, bool with_history) {
    StageNumbers numbers{};
    ranks.broadcast(numbers);
    ranks.broadcast(y);
    if (with_history) ranks.broadcast(history);
    LoadedStage at{{numbers[0], numbers[1], {}}, {}};
    if (with_history) at.stage.history = history;
    std::copy(numbers.begin() + 2, numbers.end(), at.pressure.begin());
    return at;
  }

  std::unique_ptr<Setup> setup;
  Layout layout;
  Share share;
  std::vector<double> y, history, residual;
};

}  // namespace

Team::~Team() {
  if (ranks_.size() > 1) Note{}.broadcast(ranks_);
}

std::unique_ptr<Announcer> Team::open(const Scene& scene, const Resolution& resolution) {
  if (ranks_.size() == 1) return nullptr;
  Note{open_problem, opened_, 0}.broadcast(ranks_);
  for (std::string text : {describe(scene), scene.name(), scene.folder().string()}) ranks_.broadcast(text);
  ResolutionNumbers numbers{resolution.wall_cells, resolution.blood_cells, resolution.axial_cells,
                            resolution.around_cells};
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
        problems[note.problem] = std::make_unique<Served>(scene, resolution, ranks);
        break;
      }
      case drop_problem:
        problems.erase(note.problem);
        break;
      case compute_residual: {
        Served& served = *problems.at(note.problem);
        const LoadedStage at = served.receive(ranks, note.with_history != 0);
        served.share.residual(at, served.y, served.residual);
        break;
      }
      case compute_factors: {
        Served& served = *problems.at(note.problem);
        const LoadedStage at = served.receive(ranks, note.with_history != 0);
        served.share.factorise(at, served.y);
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
