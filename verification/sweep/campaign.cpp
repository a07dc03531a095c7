// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/sweep/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

#include "core/error.hpp"
#include "core/observables/build_info.hpp"
#include "core/observables/folder_lock.hpp"
#include "core/observables/inputs.hpp"
#include "core/run/choose_tier.hpp"
#include "core/scene/message.hpp"
#include "core/scene/parameter.hpp"
#include "verification/sweep/execute.hpp"
#include "verification/sweep/fidelity_points.hpp"

namespace tunica::sweep {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return {};
  return value;
}

std::optional<std::uint64_t> environment_number(const char* name) {
  const char* text = std::getenv(name);
  return text ? whole_number(text) : std::nullopt;
}

/// Refuses a key whose values at the ends the declaration does not allow.
void check_bounds(const Json& parameter) {
  const std::string key = parameter.at("key");
  const scene::Bounds& bounds = scene::find_parameter(key)->bounds;
  const auto refuse_value = [&](double value) {
    if (!bounds.contains(value))
      throw InvalidInput(fmt::format("--vary {}: {} is not allowed, {} has to be {}", key,
                                     scene::with_unit(value, parameter.at("unit").get<std::string>()), key,
                                     bounds.text()));
  };
  if (parameter.contains("distribution")) {
    const auto marginal =
        uncertainty::parse_marginal(parameter.at("distribution").get<std::string>(), key, "1");
    // Beyond what even long sweeps draw a tail is no reason to refuse.
    constexpr double negligible = 1e-9;
    const double outside = (std::isfinite(bounds.lower) ? marginal->probability(bounds.lower) : 0) +
                           (std::isfinite(bounds.upper) ? 1 - marginal->probability(bounds.upper) : 0);
    if (outside > negligible)
      throw InvalidInput(fmt::format(
          "--vary {}: {} leaves the range of the key ({}) with a probability of {:.2g} %; take a narrower "
          "one, or a lognormal, uniform or triangular distribution within it",
          key, marginal->text(), bounds.text(), 100 * outside));
  } else if (parameter.contains("values") && parameter.at("unit") != "") {
    for (const std::string value : parameter.at("values")) refuse_value(std::stod(value));
  }
}

/// What decides which keys count at a point: its words, and where it has none and where numbers.
std::string kind_of(const Points& points, const std::vector<std::string>& values) {
  std::string kind;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const bool is_number = !points.keys()[k].unit.empty() && !values[k].empty();
    kind += (is_number ? "1" : values[k]) + '\n';
  }
  return kind;
}

/// Refuses keys without effect on any scene of the sweep, those of gradients without a derivative in any,
/// and what the tier cannot compute. A point in a corner may be no scene, and where one key chooses which
/// others count (a law, an outlet) a key acts on some points only; points are tried from all over the design,
/// since neighbours on a grid share what makes them none.
void check_keys(const Campaign& campaign) {
  std::optional<InvalidInput> refusal;
  const auto fidelities = fidelities_of(campaign.points.describe(), campaign.tier, campaign.points.count());
  bool can_compute = false;
  std::map<std::string, std::string> unused;  // and why
  std::vector<std::string> without_derivative = campaign.question.keys;
  for (const Varied& varied : campaign.points.keys()) unused[varied.key] = {};
  // Of long designs the first points will do, so that a sequence is not gone through before the sweep begins.
  constexpr std::uint64_t enough = 64, far = 1'000'000;
  const std::uint64_t end = std::min(far, campaign.points.count()),
                      step = std::max<std::uint64_t>(1, end / enough);
  const auto attempt = [&](const std::vector<std::string>& keys) {
    auto values = overrides(campaign.points, keys);
    const auto offered = offered_keys(campaign, values);
    if (!offered.empty()) values.push_back(run::sensitivity_override(offered));
    try {
      const Scene scene = campaign.door.source().with(values);
      std::erase_if(unused, [&](const auto& key) { return scene.has(key.first); });
      for (auto& [key, reason] : unused)
        for (const std::string& remark : scene.remarks())
          if (remark.starts_with(key + " is not used")) reason = remark;
      std::erase_if(without_derivative, [&](const std::string& key) {
        return std::find(offered.begin(), offered.end(), key) != offered.end();
      });
      // A point without derivatives does not tell whether the tier has any.
      if (can_compute || (offered.empty() && !campaign.question.keys.empty())) return;
      // Throws when the tier has no such scenes, or no derivatives by these keys.
      for (const Fidelity& fidelity : fidelities)
        run::choose_tier(campaign.door.tiers(), fidelity.tier, scene);
      can_compute = true;
    } catch (const InvalidInput& error) {
      if (!refusal) refusal = error;
    }
  };
  const auto is_settled = [&] { return can_compute && unused.empty() && without_derivative.empty(); };
  std::set<std::string> tried;  // kinds of points
  for (std::uint64_t point = 0; point < end && !is_settled(); point += step) {
    const auto values = campaign.points.values(point);
    tried.insert(kind_of(campaign.points, values));
    attempt(values);
  }
  // Of a list a key may count in a few points only.
  for (std::uint64_t point = 0; point < end && !is_settled(); ++point)
    if (const auto values = campaign.points.values(point);
        tried.insert(kind_of(campaign.points, values)).second)
      attempt(values);
  if (!can_compute && refusal) throw *refusal;
  for (const auto& [key, reason] : unused) {
    if (reason.empty() && refusal) throw *refusal;  // of points that may use it
    throw InvalidInput(
        fmt::format("--vary {}: {}", key, reason.empty() ? "it is not used by this scene" : reason));
  }
  if (!without_derivative.empty())
    throw InvalidInput(fmt::format(
        "--gradients: there are no derivatives by {} in any of the scenes; vary it without --gradients",
        without_derivative.front()));
}

Json describe(const Campaign& campaign) {
  const Scene& scene = campaign.door.source().scene();
  Json all;
  all["program"] = "tunica sweep";
  all["version"] = program_version();
  all["commit"] = program_commit();
  all["scene"] = scene.name();
  all["tier"] = campaign.tier;
  all["design"] = campaign.points.describe();
  all["points"] = campaign.points.count();
  Json quantities = Json::array();
  for (const run::Quantity& quantity : campaign.question.quantities) quantities.push_back(quantity.name());
  all["quantities"] = std::move(quantities);
  all["gradients"] = campaign.question.keys;
  all["timings"] = campaign.timings;
  if (campaign.until) all["until"] = *campaign.until;
  if (campaign.surrogates) all["made_of_points"] = "surrogates";
  all["input_files"] = input_files(scene);
  all["scene_toml"] = tunica::describe(scene);
  all["scene_file"] = campaign.door.source().file().string();
  all["overrides"] = campaign.door.source().overrides();
  return all;
}

/// What makes two parts the same sweep, and its name in messages.
struct Part {
  const char *entry, *name;
};
constexpr Part identity[] = {{"version", "the version"},
                             {"commit", "the commit of the program"},
                             {"scene_toml", "the scene"},
                             {"input_files", "the contents of a file that the scene names"},
                             {"tier", "the tier"},
                             {"design", "what varies"},
                             {"points", "the number of points"},
                             {"quantities", "the list of quantities"},
                             {"gradients", "the list of keys for gradients"}};

/// "the number of points was 10 and is 20"; empty when both are the same sweep. What a line has no room for
/// is only named.
std::string difference(const Json& one, const Json& other) {
  for (const Part& part : identity) {
    const bool grows = one.contains("until") && other.contains("until");
    if (grows && part.entry == std::string_view("points")) continue;
    const Json before = one.value(part.entry, Json()), now = other.value(part.entry, Json());
    if (before == now) continue;
    constexpr std::size_t room = 60;
    const std::string was = before.dump(), is = now.dump();
    if (was.size() > room || is.size() > room) return std::string(part.name) + " differs";
    const auto plain = [](const Json& value) {
      return value.is_string() ? value.get<std::string>() : value.dump();
    };
    return fmt::format("{} was {} and is {}", part.name, plain(before), plain(now));
  }
  return {};
}

/// The same for the sweep that is to go on: of its scene, the key that has changed.
std::string difference(const Json& kept, const Json& self, const Scene& scene) {
  if (kept.value("scene_toml", Json()) != self.at("scene_toml") ||
      kept.value("input_files", Json()) != self.at("input_files"))
    return changed_input(scene, self.at("input_files"), kept.value("scene_toml", std::string()),
                         kept.value("input_files", Json()));
  return difference(kept, self);
}

Shard shard_in(const Json& campaign) {
  return {campaign.at("shard").at("index"), campaign.at("shard").at("count")};
}

void write_campaign(Json all, const Shard& shard, const SweepSummary& summary, const fs::path& folder) {
  all["shard"] = {{"index", shard.index}, {"count", shard.count}};
  all["counts"] = {{run::name_of(run::Ending::done), summary.done},
                   {run::name_of(run::Ending::gave_up), summary.gave_up},
                   {run::name_of(run::Ending::refused), summary.refused}};
  all["seconds"] = summary.seconds;
  write_whole(folder / campaign_file, all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void remove_sweep(const fs::path& folder) {
  std::error_code not_there;
  // The table first: what is left of a removal that is cut short is no sweep.
  for (const char* file : {"sweep.json", "sweep.db", "sweep.db-wal", "sweep.db-shm", "sweep.csv",
                           "indices.csv", "fidelities.csv", "report.html"})
    fs::remove(folder / file, not_there);
}

SweepSummary summary_of(const Table& table) {
  const auto count = [&](run::Ending ending) { return table.count(run::name_of(ending)); };
  return {0,
          count(run::Ending::done),
          count(run::Ending::gave_up),
          count(run::Ending::refused),
          table.seconds(),
          false};
}

}  // namespace

std::string Shard::text() const {
  return fmt::format("{}/{}", index, count);
}

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto index = whole_number(std::string_view(text).substr(0, slash));
  const auto count =
      slash == std::string::npos ? std::nullopt : whole_number(std::string_view(text).substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count)
    throw InvalidInput(
        fmt::format("--shard {}: write i/n, the i-th of n parts, 1/n to n/n", scene::one_line(text)));
  return {*index, *count};
}

std::optional<Shard> shard_of_slurm_array() {
  const auto id = environment_number("SLURM_ARRAY_TASK_ID"),
             count = environment_number("SLURM_ARRAY_TASK_COUNT"),
             first = environment_number("SLURM_ARRAY_TASK_MIN");
  if (!id || !count || *count < 2) return {};
  const auto step = environment_number("SLURM_ARRAY_TASK_STEP").value_or(1);
  const std::uint64_t begin = first.value_or(0);
  if (*id < begin || step == 0 || (*id - begin) % step != 0 || (*id - begin) / step >= *count)
    throw InvalidInput(
        fmt::format("SLURM_ARRAY_TASK_ID = {} is no task of an array of {} from {} in steps of "
                    "{}; name the part with --shard i/n",
                    *id, *count, begin, step));
  return Shard{(*id - begin) / step + 1, *count};
}

Json read_campaign(const fs::path& folder) {
  std::ifstream stream(folder / campaign_file);
  const Json all = stream ? Json::parse(stream, nullptr, false) : Json();
  if (!all.is_object() || all.value("program", Json()) != "tunica sweep")
    throw InvalidInput(
        fmt::format("{}: no sweep here ({} is missing or another one's)", folder.string(), campaign_file));
  for (const char* entry : {"shard", "design", "points", "quantities", "gradients", "timings"})
    if (!all.contains(entry))
      throw InvalidInput(
          fmt::format("{}: {} has no {}; begin anew with --replace", folder.string(), campaign_file, entry));
  return all;
}

Table table_of(const Json& campaign, const fs::path& folder, Table::Mode mode) {
  run::Question question;
  for (const std::string name : campaign.at("quantities"))
    question.quantities.push_back(run::parse_quantity(name));
  question.keys = campaign.at("gradients").get<std::vector<std::string>>();
  std::vector<Varied> keys;
  for (const Json& parameter : campaign.at("design").at("parameters"))
    keys.push_back({parameter.at("key"), parameter.at("unit")});
  return {folder / database_file, mode, keys, number_columns(question)};
}

bool holds_sweep(const fs::path& folder) {
  std::error_code unreadable;
  return fs::exists(folder / campaign_file, unreadable) || fs::exists(folder / database_file, unreadable);
}

SweepSummary run_sweep(const Campaign& campaign, const fs::path& folder, const SweepControl& control) {
  const Json design = campaign.points.describe();
  for (const Json& parameter : design.at("parameters")) check_bounds(parameter);
  check_keys(campaign);
  const Json self = describe(campaign);
  const bool is_there = holds_sweep(folder);
  if (is_there && control.resume) {
    const Json kept = read_campaign(folder);
    if (const std::string other = difference(kept, self, campaign.door.source().scene()); !other.empty())
      throw InvalidInput(fmt::format(
          "{}: holds another sweep: {}; leave out --resume and name another folder with --out, or "
          "write --replace to discard it",
          folder.string(), other));
    if (shard_in(kept).text() != campaign.shard.text())
      throw InvalidInput(fmt::format("{}: holds shard {}, not {}; name another folder with --out",
                                     folder.string(), shard_in(kept).text(), campaign.shard.text()));
  } else if (is_there && !control.replace) {
    throw InvalidInput(fmt::format(
        "{}: holds a sweep; --resume goes on with it, --replace discards it, --out names another folder",
        folder.string()));
  }
  make_result_folder(folder);
  const FolderLock lock(folder);
  const bool goes_on = is_there && control.resume && fs::exists(folder / database_file);
  if (!goes_on) {
    remove_sweep(folder);
    // Before the table, so that whatever a kill leaves behind says what it is of.
    write_campaign(self, campaign.shard, {}, folder);
  }
  Table table(folder / database_file, goes_on ? Table::Mode::open : Table::Mode::create,
              campaign.points.keys(), number_columns(campaign.question));
  const bool interrupted = execute(campaign, folder, table, control);
  write_csv(table, folder / table_file, campaign.timings);
  SweepSummary summary = summary_of(table);
  write_campaign(self, campaign.shard, summary, folder);
  summary.count = campaign.shard.share_of(campaign.points.count());
  summary.interrupted = interrupted;
  return summary;
}

SweepSummary merge(const std::vector<fs::path>& folders, const fs::path& out, bool replace) {
  if (folders.size() < 2) throw InvalidInput("--merge: name at least two folders of shards");
  const Json first = read_campaign(folders.front());
  const std::uint64_t count = shard_in(first).count;
  std::vector<fs::path> by_index(count);
  for (const fs::path& folder : folders) {
    const Json campaign = read_campaign(folder);
    std::error_code not_there;
    if (fs::equivalent(folder, out, not_there))
      throw InvalidInput(fmt::format("{}: is a shard itself; name another folder with --out", out.string()));
    if (const std::string other = difference(first, campaign); !other.empty())
      throw InvalidInput(fmt::format("{}: a part of another sweep than {}: {}", folder.string(),
                                     folders.front().string(), other));
    const Shard shard = shard_in(campaign);
    if (shard.count != count)
      throw InvalidInput(fmt::format("{}: is shard {}, and {} is {}: parts of different numbers do not fit",
                                     folder.string(), shard.text(), folders.front().string(),
                                     shard_in(first).text()));
    fs::path& place = by_index.at(shard.index - 1);
    if (!place.empty())
      throw InvalidInput(
          fmt::format("{} and {}: are both shard {}", place.string(), folder.string(), shard.text()));
    place = folder;
    const Table part = table_of(first, folder, Table::Mode::read);
    const std::uint64_t ended = part.points().size(), needed = shard.share_of(first.at("points"));
    if (ended != needed)
      throw InvalidInput(fmt::format("{}: shard {} has {} of {} points; complete it with --resume",
                                     folder.string(), shard.text(), ended, needed));
  }
  for (std::uint64_t k = 0; k < count; ++k)
    if (by_index[k].empty()) throw InvalidInput(fmt::format("--merge: shard {}/{} is missing", k + 1, count));
  if (holds_sweep(out) && !replace)
    throw InvalidInput(
        fmt::format("{}: holds a sweep; --replace discards it, --out names another folder", out.string()));
  make_result_folder(out);
  const FolderLock lock(out);
  remove_sweep(out);
  Table table = table_of(first, out, Table::Mode::create);
  for (const fs::path& folder : by_index) table.take(table_of(first, folder, Table::Mode::read));
  write_csv(table, out / table_file, first.at("timings"));
  SweepSummary summary = summary_of(table);
  write_campaign(first, {}, summary, out);
  summary.count = first.at("points");
  return summary;
}

}  // namespace tunica::sweep
