// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "core/error.hpp"
#include "core/observables/build_info.hpp"
#include "core/observables/result.hpp"

namespace tunica {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

struct TableFile {
  const char* name;
  observables::Table Result::*table;
};
constexpr TableFile table_files[] = {{"observables.csv", &Result::observables},
                                     {"profiles.csv", &Result::profiles},
                                     {"events.csv", &Result::events},
                                     {"sensitivities.csv", &Result::sensitivities},
                                     {"event_sensitivities.csv", &Result::event_sensitivities},
                                     {"recruited_time.csv", &Result::recruited_time},
                                     {"compartments.csv", &Result::compartments},
                                     {"along.csv", &Result::along}};
constexpr const char* fields_folder = "fields";
constexpr const char* fields_extension = ".xdmf";

[[noreturn]] void fail(const fs::path& path, const char* what, int error) {
  throw OutputFailure(fmt::format("{}: {}: {}", path.string(), what, std::strerror(error)));
}

/// A file descriptor that is closed, and a file of that name that is removed, unless `keep` is called.
class TemporaryFile {
 public:
  explicit TemporaryFile(fs::path path)
      : path_(std::move(path)),
        descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    if (!kept_) ::unlink(path_.c_str());
  }

  int descriptor() const { return descriptor_; }
  const fs::path& path() const { return path_; }
  void keep() { kept_ = true; }

 private:
  fs::path path_;
  int descriptor_;
  bool kept_ = false;
};

fs::path temporary_name(const fs::path& file) {
  return file.parent_path() / fmt::format(".{}.{}.part", file.filename().string(), ::getpid());
}

bool is_leftover(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.size() > 1 && name.front() == '.' && file.extension() == ".part";
}

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) fail(file, "cannot be removed", error.value());
}

void remove_leftovers(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (is_leftover(entry.path())) remove_file(entry.path());
}

/// A viewer opens whatever lies here, so that nothing of an earlier run may stay.
void write_fields(const fs::path& folder, const std::vector<observables::FieldSeries>& fields) {
  std::error_code error;
  if (fs::is_directory(folder)) {
    remove_leftovers(folder);
    for (const auto& entry : fs::directory_iterator(folder, error))
      if (entry.path().extension() == fields_extension) remove_file(entry.path());
  }
  for (const auto& series : fields) {
    if (series.frames.empty()) continue;
    fs::create_directory(folder, error);
    if (error) fail(folder, "the folder for fields cannot be made", error.value());
    write_whole(folder / (series.name + fields_extension),
                [&](const Sink& sink) { observables::write_xdmf(series, sink); });
  }
  // What is not empty holds fields or something of the user's, and stays.
  if (fs::is_directory(folder)) fs::remove(folder, error);
}

Json to_json(const scene::Value& value) {
  return std::visit([](const auto& held) { return Json(held); }, value);
}

Json scene_to_json(const Scene& scene, Json& set_keys) {
  Json values = Json::object();
  set_keys = Json::array();
  for (const auto& [key, value] : scene.values()) {
    values[key] = to_json(value);
    if (scene.was_set(key)) set_keys.push_back(key);
  }
  return values;
}

long peak_memory_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * 1024L;
}

/// Whether the mesh of a file's fields, which stands near its beginning, has cells in space.
bool is_in_space(const fs::path& file) {
  std::string head(4096, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  return head.find("TopologyType=\"Hexahedron\"") != std::string::npos ||
         head.find("TopologyType=\"Tetrahedron\"") != std::string::npos;
}

std::string whole_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InvalidInput(fmt::format("{}: cannot be read", file.string()));
  std::string text(fs::file_size(file), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

}  // namespace

void write_whole(const fs::path& file, const std::function<void(const Sink&)>& make) {
  TemporaryFile temporary(temporary_name(file));
  if (temporary.descriptor() < 0) fail(file, "cannot be written", errno);
  make([&](std::string_view text) {
    while (!text.empty()) {
      const ssize_t written = ::write(temporary.descriptor(), text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(file, "cannot be written", errno);
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  });
  if (::fsync(temporary.descriptor()) != 0) fail(file, "cannot be written", errno);
  if (::rename(temporary.path().c_str(), file.c_str()) != 0) fail(file, "cannot be written", errno);
  temporary.keep();
}

void write_whole(const fs::path& file, std::string_view text) {
  write_whole(file, [&](const Sink& sink) { sink(text); });
}

void make_result_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(folder, "the folder for results cannot be made", error.value());
  if (!fs::is_directory(folder)) fail(folder, "results cannot be stored here", ENOTDIR);
  // Permission bits do not tell (root, read-only mounts, quotas): a file does.
  const TemporaryFile probe(temporary_name(folder / "probe"));
  if (probe.descriptor() < 0) fail(folder, "files cannot be made in this folder", errno);
}

Json make_record(const Scene& scene, const RunRecord& run) {
  Json record;
  record["program"] = "tunica";
  record["version"] = program_version();
  record["commit"] = program_commit();
  record["name"] = scene.name();
  record["tier"] = run.tier;
  record["resolution"] = run.resolution;
  record["unknowns"] = run.unknowns;
  record["steps"] = run.steps;
  record["newton_iterations"] = run.newton_iterations;
  record["linear_iterations"] = run.linear_iterations;
  record["rejected_steps"] = run.rejected_steps;
  record["seconds"] = {{"setup", run.setup_seconds}, {"solve", run.solve_seconds}};
  if (!observables::is_none(run.median_step_seconds))
    record["seconds"]["median_step"] = run.median_step_seconds;
  record["peak_memory_bytes"] = peak_memory_bytes();
  record["converged"] = run.converged;
  record["interrupted"] = run.interrupted;
  record["failure"] = run.failure;
  record["remarks"] = run.remarks;
  record["findings"] = run.findings;
  record["input_files"] = run.input_files;
  Json set_keys;
  record["scene"] = scene_to_json(scene, set_keys);
  record["scene_set"] = std::move(set_keys);
  record["scene_toml"] = describe(scene);
  return record;
}

void write_result(const fs::path& folder, const Scene& scene, const Result& result) {
  make_result_folder(folder);
  remove_file(folder / record_file);
  remove_leftovers(folder);
  for (const TableFile& file : table_files) {
    const observables::Table& table = result.*file.table;
    if (table.columns().empty())
      remove_file(folder / file.name);
    else
      write_whole(folder / file.name, observables::to_csv(table));
  }
  write_fields(folder / fields_folder, result.fields);
  // File names, and so scene names, need not be UTF-8; a replaced byte is better than no record.
  write_whole(folder / record_file,
              make_record(scene, result.record).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

Json read_record(const fs::path& folder) {
  const fs::path file = folder / record_file;
  std::ifstream stream(file);
  if (!stream)
    throw InvalidInput(
        fmt::format("{}: no whole result here ({} is missing); make one with: tunica run SCENE "
                    "--out {}",
                    folder.string(), record_file, folder.string()));
  Json record = Json::parse(stream, nullptr, false);
  if (!record.is_object() || record.value("program", Json()) != "tunica")
    throw InvalidInput(fmt::format("{}: not the record of a run of tunica", file.string()));
  return record;
}

StoredResult read_result(const fs::path& folder) {
  StoredResult stored;
  stored.folder = folder;
  stored.record = read_record(folder);
  for (const TableFile& file : table_files) {
    const fs::path path = folder / file.name;
    const bool needed = file.table == &Result::observables;
    if (needed || fs::exists(path)) stored.result.*file.table = observables::read_csv(path.string());
  }
  return stored;
}

std::vector<observables::FieldSeries> read_space_fields(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / fields_folder, none))
    if (entry.path().extension() == fields_extension && is_in_space(entry.path()))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<observables::FieldSeries> all;
  for (const fs::path& file : files) {
    try {
      all.push_back(observables::from_xdmf(whole_text(file)));
    } catch (const std::invalid_argument& error) {
      throw InvalidInput(
          fmt::format("{}: not fields as tunica writes them ({}); without this file the report "
                      "goes without their picture",
                      file.string(), error.what()));
    }
  }
  return all;
}

}  // namespace tunica
