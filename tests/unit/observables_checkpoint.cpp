// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <random>
#include <thread>

#include "core/error.hpp"
#include "core/observables/build_info.hpp"
#include "core/observables/checkpoint.hpp"
#include "core/observables/inputs.hpp"
#include "tests/support/synthetic.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace tunica;
using test_support::read_text;
using test_support::synthetic_run;
using test_support::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> all;
  for (const double value : values) all.push_back(std::bit_cast<std::uint64_t>(value));
  return all;
}

Scene some_scene(const std::string& law = "EXP1", const fs::path& folder = ".") {
  return parse_scene("[wall]\nlaw = \"" + law + "\"\n", "some", folder);
}

/// Something in every member, with what text formats lose: NaN, the order of keys, floats.
Checkpoint rich_checkpoint() {
  Checkpoint checkpoint;
  checkpoint.so_far = synthetic_run({.interval = 0.05, .with_sensitivities = true}).result;
  Result& result = checkpoint.so_far;
  result.recruited_time.add("point", "");
  result.recruited_time[0].labels = {"P1", "caf\xe9"};
  result.compartments.add("pressure.1", "dyn/cm2");
  result.compartments[0].values = {observables::none, -0.0, 0.1};
  result.along.add("wall_shear_stress", "dyn/cm2");
  result.along[0].values = {0.1, observables::none};
  observables::FieldSeries series;
  series.name = "wall";
  series.mesh.shape = observables::CellShape::triangle;
  series.mesh.points = {{0, 0, 0}, {1, 0, 0}, {0.1, 1, 0}};
  series.mesh.cells = {0, 1, 2};
  series.cell_fields = {{"layer", "1", {3}}};
  series.point_fields = {{"displacement", "cm", 3}};
  series.frames = {{0.1, {{1, 2, 3, 4, 5, 6, 7, 8, NAN}}}, {0.2, {{0.1F, 2, 3, 4, 5, 6, 7, 8, 9}}}};
  result.fields = {series};
  RunRecord& record = result.record;
  record.tier = "made up";
  record.resolution = {{"z", 1}, {"a", 0.1}};
  record.unknowns = 1;
  record.steps = 2;
  record.newton_iterations = 3;
  record.linear_iterations = 4;
  record.rejected_steps = 5;
  record.setup_seconds = 0.1;
  record.solve_seconds = 0.3;
  record.median_step_seconds = 0.02;
  record.interrupted = true;
  record.remarks = {"one", "two"};
  record.findings = {"three"};
  checkpoint.state["time"] = 0.1;
  checkpoint.state["step"] = 12345678901L;
  checkpoint.state["unknowns"] = pack(std::vector<double>{1.0 / 3, -0.0, observables::none});
  return checkpoint;
}

/// record.json of a result, the order of its keys included, without the memory that this process takes.
std::string record_of(const Scene& scene, const Result& result) {
  const TemporaryFolder folder;
  write_result(folder.path(), scene, result);
  nlohmann::ordered_json record = read_result(folder.path()).record;
  record.erase("peak_memory_bytes");
  return record.dump();
}

std::string refusal(const fs::path& folder, const Scene& scene, const char* tier = "made up") {
  try {
    read_checkpoint(folder, scene, tier);
  } catch (const InvalidInput& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find((folder / "checkpoint").string()), std::string::npos) << message;
    EXPECT_NE(message.find("leave out --resume"), std::string::npos) << message;
    return message;
  }
  return "no refusal";
}

}  // namespace

TEST(Pack, KeepsEveryBit) {
  const auto seed = std::random_device()();
  std::mt19937_64 random(seed);
  std::vector<double> values{0.0, -0.0, INFINITY, -INFINITY, observables::none, -observables::none, 5e-324};
  // Any pattern of bits, signalling NaN and subnormal numbers among them.
  for (int k = 0; k < 10000; ++k) values.push_back(std::bit_cast<double>(random()));
  const auto through_disk = nlohmann::json::from_cbor(nlohmann::json::to_cbor(pack(values)));
  EXPECT_EQ(bits(unpack(through_disk)), bits(values)) << "seed " << seed;
  EXPECT_TRUE(unpack(pack({})).empty());
  EXPECT_THROW(unpack(nlohmann::json(3.0)), std::logic_error);
}

TEST(CheckpointFile, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const Scene scene = some_scene();
  const Checkpoint written = rich_checkpoint();
  EXPECT_FALSE(has_checkpoint(folder.path()));
  write_checkpoint(folder.path(), scene, "made up", input_files(scene), written);
  EXPECT_TRUE(has_checkpoint(folder.path()));
  const Checkpoint read = read_checkpoint(folder.path(), scene, "made up");
  EXPECT_EQ(read.state["time"], 0.1);
  EXPECT_EQ(read.state["step"], 12345678901L);
  EXPECT_EQ(bits(unpack(read.state["unknowns"])), bits(unpack(written.state["unknowns"])));

  // What is stored of both is the same, byte by byte.
  const Result &before = written.so_far, &after = read.so_far;
  for (const auto table :
       {&Result::observables, &Result::profiles, &Result::events, &Result::sensitivities,
        &Result::event_sensitivities, &Result::recruited_time, &Result::compartments, &Result::along}) {
    EXPECT_GT((before.*table).rows(), 0U);
    EXPECT_EQ(observables::to_csv(after.*table), observables::to_csv(before.*table));
  }
  EXPECT_TRUE(std::signbit(after.compartments[0].values[1]));
  ASSERT_EQ(after.fields.size(), 1U);
  EXPECT_EQ(observables::to_xdmf(after.fields[0]), observables::to_xdmf(before.fields[0]));
  EXPECT_EQ(record_of(scene, after), record_of(scene, before));
  remove_checkpoint(folder.path());
  EXPECT_FALSE(has_checkpoint(folder.path()));
  remove_checkpoint(folder.path());
}

TEST(CheckpointFile, OneThatIsCutOffOrDamagedIsRefused) {
  const TemporaryFolder folder;
  const Scene scene = some_scene();
  write_checkpoint(folder.path(), scene, "made up", input_files(scene), rich_checkpoint());
  const std::string whole = read_text(folder.path() / "checkpoint");
  const auto seed = std::random_device()();
  std::mt19937 random(seed);
  for (int k = 0; k < 60; ++k) {
    const std::size_t at = k == 0 ? 0 : random() % whole.size();
    write_whole(folder.path() / "checkpoint", whole.substr(0, at));
    EXPECT_NE(refusal(folder.path(), scene).find("cut off or damaged"), std::string::npos)
        << "cut at " << at << ", seed " << seed;
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << random() % 8));
    write_whole(folder.path() / "checkpoint", flipped);
    EXPECT_NE(refusal(folder.path(), scene), "no refusal") << "flipped at " << at << ", seed " << seed;
  }
  write_whole(folder.path() / "checkpoint", whole + "x");
  EXPECT_NE(refusal(folder.path(), scene).find("cut off or damaged"), std::string::npos);
  write_whole(folder.path() / "checkpoint", whole);
  EXPECT_EQ(refusal(folder.path(), scene), "no refusal");
}

TEST(CheckpointFile, OneOfAnotherRunIsRefused) {
  const TemporaryFolder folder;
  write_whole(folder.path() / "flow.csv",
              "time[s],flow[cm3/s]\n0,0.1\n0.1,0.2\n0.2,0.15\n0.3,0.12\n0.8,0.1\n");
  const auto read_it = [&](const std::string& law) {
    return parse_scene("[wall]\nlaw = \"" + law + "\"\n[inlet]\nwaveform = \"flow.csv\"\n", "some",
                       folder.path());
  };
  const Scene scene = read_it("EXP1");
  write_checkpoint(folder.path(), scene, "made up", input_files(scene), rich_checkpoint());
  EXPECT_EQ(refusal(folder.path(), scene), "no refusal");
  const std::string other = refusal(folder.path(), read_it("EXP2"));
  EXPECT_NE(other.find("another scene: some.toml: wall.law was \"EXP1\" and is \"EXP2\""), std::string::npos)
      << other;
  EXPECT_NE(refusal(folder.path(), scene, "other").find("tier made up, not other"), std::string::npos);

  // The scene's text is the same, what it names is not.
  const std::string flow = read_text(folder.path() / "flow.csv");
  write_whole(folder.path() / "flow.csv",
              "time[s],flow[cm3/s]\n0,0.1\n0.1,0.3\n0.2,0.15\n0.3,0.12\n0.8,0.1\n");
  const std::string changed = refusal(folder.path(), read_it("EXP1"));
  EXPECT_NE(changed.find("contents of inlet.waveform = \"flow.csv\" have changed"), std::string::npos)
      << changed;
  write_whole(folder.path() / "flow.csv", flow);

  auto whole = nlohmann::json::from_cbor(read_text(folder.path() / "checkpoint"));
  whole["program"] = "0.0.1 abc";
  const auto bytes = nlohmann::json::to_cbor(whole);
  write_whole(folder.path() / "checkpoint", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const std::string message = refusal(folder.path(), scene);
  EXPECT_NE(message.find("written by tunica 0.0.1 abc"), std::string::npos) << message;
  EXPECT_NE(message.find(program_version()), std::string::npos) << message;
}

TEST(CheckpointFile, AKilledWriterLeavesAWholeOne) {
  const TemporaryFolder folder;
  const Scene scene = some_scene();
  Checkpoint checkpoint = rich_checkpoint();
  checkpoint.state["unknowns"] = pack(std::vector<double>(200000, 1.5));
  write_checkpoint(folder.path(), scene, "made up", input_files(scene), checkpoint);
  const auto seed = std::random_device()();
  std::mt19937 random(seed);
  for (int repeat = 0; repeat < 10; ++repeat) {
    const pid_t child = ::fork();
    if (child == 0)
      for (;;) write_checkpoint(folder.path(), scene, "made up", input_files(scene), checkpoint);
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 20000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_EQ(refusal(folder.path(), scene), "no refusal") << "kill " << repeat << ", seed " << seed;
  }
}
