#include "hersey/results/checkpoint.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "hersey/results/reader.h"
#include "hersey/results/writer.h"
#include "temporary_directory.h"

namespace hersey::results {
namespace checkpoint_test {

Archive::Content some() {
  Archive::Content content;
  content.numbers["state/t"] = {{}, {0.1}};
  content.numbers["state/q"] = {{3}, {1, -0.0, 1e-310}};
  content.numbers["state/M"] = {{2, 2}, {1, 2, 3, 4}};
  content.numbers["body rod/none"] = {{0}, {}};
  content.texts["identity/model"] = "a: b\n# \u00b5m\n";
  content.texts["identity/empty"] = "";
  return content;
}

TEST_CASE("Checkpoint_HoldsWhatWasWritten") {
  const TemporaryDirectory scratch;
  const Archive::Content before = some();
  write_checkpoint(scratch / "run.checkpoint", before);
  const Archive::Content after = read_checkpoint(scratch / "run.checkpoint");
  CHECK(after.numbers == before.numbers);
  CHECK(std::signbit(after.numbers.at("state/q").values[1]));
  CHECK(after.texts == before.texts);
  CHECK_FALSE(std::filesystem::exists(scratch / "run.checkpoint.new"));
}

TEST_CASE("SecondCheckpoint_ReplacesTheFirst") {
  const TemporaryDirectory scratch;
  Archive::Content content = some();
  write_checkpoint(scratch / "run.checkpoint", content);
  content.numbers["state/t"].values[0] = 0.2;
  content.numbers.erase("state/M");
  write_checkpoint(scratch / "run.checkpoint", content);
  CHECK(read_checkpoint(scratch / "run.checkpoint").numbers == content.numbers);
}

TEST_CASE("NoCheckpoint_IsReported") {
  const TemporaryDirectory scratch;
  CHECK_THROWS_AS(read_checkpoint(scratch / "none"), ReadError);
  std::ofstream(scratch / "text") << "no HDF5";
  CHECK_THROWS_AS(read_checkpoint(scratch / "text"), ReadError);
  Writer(scratch / "results.h5").finish(Status::completed);
  CHECK_THROWS_AS(read_checkpoint(scratch / "results.h5"), ReadError);
  CHECK_THROWS_AS(write_checkpoint(scratch / "nowhere" / "run.checkpoint", some()), WriteError);
}

TEST_CASE("ABitThatFlipsInACheckpoint_IsReported") {
  const TemporaryDirectory scratch;
  write_checkpoint(scratch / "run.checkpoint", some());
  std::ifstream file(scratch / "run.checkpoint", std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(file), {}};
  for (std::size_t bit = 3; bit < 8 * good.size(); bit += 211) {
    std::string turned = good;
    turned[bit / 8] = static_cast<char>(turned[bit / 8] ^ (1 << (bit % 8)));
    std::ofstream(scratch / "turned", std::ios::binary) << turned;
    CHECK_THROWS_AS(read_checkpoint(scratch / "turned"), ReadError);
  }
  std::ofstream(scratch / "cut", std::ios::binary) << good.substr(0, good.size() / 2);
  CHECK_THROWS_AS(read_checkpoint(scratch / "cut"), ReadError);
}

struct Run {
  Writer writer;
  Series time, force, field;

  explicit Run(const std::filesystem::path& path)
      : writer(path),
        time(writer.series("/time", 1, "s", "time")),
        force(writer.series("/force", 3, "N", "force")),
        field(writer.field("/b/fields/p", {2, 2}, "Pa", "pressure")) {}

  void step(double t) {
    time.append(t);
    force.append({t, 2 * t, 3 * t});
    if (std::fmod(t, 2) == 0) field.append({t, t, t, -t});
  }
};

TEST_CASE("RowsOfAnotherFile_AreTakenAsFarAsAsked") {
  const TemporaryDirectory scratch;
  std::vector<std::pair<std::string, std::size_t>> rows;
  {
    Run run(scratch / "before.h5");
    for (int k = 0; k < 5; ++k) run.step(k);
    rows = run.writer.rows();
    CHECK(rows == std::vector<std::pair<std::string, std::size_t>>{{"/time", 5}, {"/force", 5}, {"/b/fields/p", 3}});
    for (int k = 5; k < 9; ++k) run.step(-k);  // written after the checkpoint: to be forgotten
  }
  {
    Run run(scratch / "after.h5.resuming");
    run.writer.copy_rows(Reader(scratch / "before.h5"), rows);
    run.writer.rename(scratch / "after.h5");
    for (int k = 5; k < 7; ++k) run.step(k);
    run.writer.finish(Status::completed);
  }
  const Reader reader(scratch / "after.h5");
  CHECK(reader.rows() == 7);
  CHECK(reader.read("/time").values == std::vector<double>{0, 1, 2, 3, 4, 5, 6});
  CHECK(reader.read_rows("/force", 6, 1).values == std::vector<double>{6, 12, 18});
  CHECK(reader.read("/b/fields/p").values == std::vector<double>{0, 0, 0, -0.0, 2, 2, 2, -2, 4, 4, 4, -4, 6, 6, 6, -6});
}

TEST_CASE("RowsThatAreNotThere_AreMissed") {
  const TemporaryDirectory scratch;
  Run(scratch / "before.h5").step(1);
  const Reader before(scratch / "before.h5");
  Run after(scratch / "after.h5");
  CHECK_THROWS_AS(after.writer.copy_rows(before, {{"/time", 2}, {"/force", 1}, {"/b/fields/p", 0}}), ReadError);
  CHECK_THROWS_AS(after.writer.copy_rows(before, {{"/time", 1}, {"/forces", 1}, {"/b/fields/p", 0}}), ReadError);
  CHECK_THROWS_AS(after.writer.copy_rows(before, {{"/time", 1}}), ReadError);
}

}  // namespace checkpoint_test
}  // namespace hersey::results
