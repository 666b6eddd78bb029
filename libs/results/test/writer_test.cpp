#include "hersey/results/writer.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numeric>

#include "hersey/core/contract.h"
#include "hersey/results/reader.h"
#include "temporary_directory.h"

namespace hersey::results {
namespace writer_test {

/// System calls of this process that read, so far.
long read_calls() {
  std::ifstream counts("/proc/self/io");
  std::string name;
  for (long value = 0; counts >> name >> value;)
    if (name == "syscr:") return value;
  return -1;
}

TEST_CASE("Flush_ReadsNothingBack") {
  const TemporaryDirectory directory;
  Writer writer(directory / "run.h5", {.flush_interval = 0});
  const Series time = writer.series("/time", 1, "s", "time");
  std::vector<Series> many;
  many.reserve(2500);
  for (int i = 0; i < 2500; ++i)
    many.push_back(writer.series("/bodies/body" + std::to_string(i) + "/position", 3, "m", "place"));
  writer.flush();
  REQUIRE(read_calls() >= 0);
  const long before = read_calls();
  for (int row = 0; row < 200; ++row) {
    time.append(row);
    for (const Series& one : many) one.append({1.0, 2.0, 3.0 * row});
    if (row % 50 == 49) writer.flush();
  }
  // Reading the counts themselves takes a few.
  CHECK(read_calls() - before < 20);
}

TEST_CASE("Dimensions_AreScalesWithOneName") {
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5";
  {
    Writer writer(path);
    writer.constant("/a/fields/phi", std::vector<double>{0, 1}, "rad", "angle");
    const Series time = writer.series("/time", 1, "s", "time");
    const Series force = writer.series("/a/force", 3, "N", "force");
    const Series around = writer.series("/a/around", 2, "m", "thickness", Precision::float64, "/a/fields/phi");
    const Series mixed = writer.series("/a/mixed", 3, "SI", "three things", Precision::float64, "/a/thing");
    time.append(0);
    force.append({1, 2, 3});
    around.append({1, 2});
    mixed.append({1, 2, 3});
    writer.finish(Status::completed);
  }
  const Reader reader(path);
  // Links to scales in the groups that use them are no datasets of their own.
  CHECK(reader.datasets() ==
        std::vector<std::string>{"/a/around", "/a/fields/phi", "/a/force", "/a/mixed", "/a/thing", "/time", "/xyz"});
  CHECK(reader.has("/a/time"));
  CHECK(reader.has("/a/phi"));
  CHECK(reader.info("/xyz").is_text);
  CHECK(reader.texts("/xyz") == std::vector<std::string>{"x", "y", "z"});
  CHECK(reader.dimensions("/a/force") == std::vector<std::string>{"/time", "/xyz"});
  CHECK(reader.dimensions("/a/around") == std::vector<std::string>{"/time", "/a/fields/phi"});
  CHECK(reader.dimensions("/a/phi") == std::vector<std::string>{"/a/fields/phi"});  // a link to it
  CHECK_THROWS_AS(reader.dimensions("/nowhere"), ReadError);
  CHECK(reader.read("/a/thing").values == std::vector<double>{0, 1, 2});
}

TEST_CASE("WhatIsWritten_IsReadBackExactly") {
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5";
  const std::vector<double> angles{0, 0.5, 1.0};
  {
    Writer writer(path);
    writer.attribute("/", "title", "Big end: 45 mm × 15.6 mm");
    writer.attribute("/bearings/big_end", "radius", 0.0225);
    writer.attribute("/", "study_parameters", std::vector<std::string>{"load", "clearance"});
    writer.text("/model", "hersey: 1\ntitle: Kurbelzapfen µ\n", "the model");
    writer.text_table("/assumptions", {{"cavitation", "mass conserving"}, {"supply", "none"}}, "assumptions");
    writer.constant("/bearings/big_end/fields/phi", angles, "rad", "bearing angle");
    const Series time = writer.series("/time", 1, "s", "time");
    const Series force = writer.series("/bearings/big_end/force", 3, "N", "force on the shell");
    const Series field_time = writer.series("/bearings/big_end/fields/time", 1, "s", "time of the fields");
    const Series pressure = writer.field("/bearings/big_end/fields/pressure", {3, 2}, "Pa", "film pressure");
    CHECK(pressure.width() == 6);
    for (int k = 0; k < 1000; ++k) {
      time.append(1e-3 * k);
      force.append({1.0 * k, -2.0 * k, std::sqrt(k)});
      if (k % 100 == 0) {
        field_time.append(1e-3 * k);
        std::vector<double> row(6);
        std::iota(row.begin(), row.end(), 10.0 * k);
        pressure.append(row);
      }
      if (k % 37 == 0) writer.flush();
    }
    writer.finish(Status::completed, "reached the end");
  }
  const Reader reader(path);
  CHECK(reader.rows() == 1000);
  CHECK(reader.text_attribute("/", "title") == "Big end: 45 mm × 15.6 mm");
  CHECK(reader.text_attribute("/", "status") == "completed");
  CHECK(reader.text_attribute("/", "message") == "reached the end");
  CHECK(reader.number_attribute("/bearings/big_end", "radius") == 0.0225);
  CHECK_FALSE(reader.text_attribute("/", "study_parameters").has_value());  // a list is not a text
  CHECK_FALSE(reader.number_attribute("/", "title").has_value());
  CHECK_FALSE(reader.text_attribute("/nowhere", "title").has_value());
  CHECK(reader.list_attribute("/", "study_parameters") == std::vector<std::string>{"load", "clearance"});
  CHECK(reader.text("/model") == "hersey: 1\ntitle: Kurbelzapfen µ\n");
  CHECK(reader.text_table("/assumptions")[1] == std::pair<std::string, std::string>{"supply", "none"});
  CHECK(reader.groups() == std::vector<std::string>{"/", "/bearings", "/bearings/big_end", "/bearings/big_end/fields"});
  CHECK(reader.datasets().size() == 12);  // five of them name rows and columns
  CHECK(reader.info("/time").grows);
  CHECK_FALSE(reader.info("/bearings/big_end/fields/phi").grows);
  CHECK(reader.children("/bearings") == std::vector<std::string>{"big_end"});
  CHECK(reader.read("/bearings/big_end/fields/phi").values == angles);

  const Array force = reader.read("/bearings/big_end/force");
  CHECK(force.info.shape == std::vector<std::size_t>{1000, 3});
  CHECK(force.info.unit == "N");
  CHECK(force.info.description == "force on the shell");
  for (std::size_t k = 0; k < 1000; ++k) REQUIRE(force.values[3 * k + 2] == std::sqrt(static_cast<double>(k)));

  const Array some = reader.read_rows("/bearings/big_end/fields/pressure", 1, 100, 4);
  CHECK(some.info.shape == std::vector<std::size_t>{3, 3, 2});
  CHECK(some.values[0] == 1000.0);
  CHECK(some.values[17] == 9005.0);
}

TEST_CASE("ExistingFile_IsKeptUnlessOverwritten") {
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5";
  std::ofstream(path) << "precious";
  CHECK_THROWS_WITH_AS(Writer{path}, doctest::Contains("exists already"), FileExists);
  std::string content;
  std::ifstream(path) >> content;
  CHECK(content == "precious");
  {
    Writer writer(path, {.overwrite = true});
    writer.finish(Status::stopped, "on request");
  }
  CHECK(Reader(path).text_attribute("/", "status") == "stopped");
}

TEST_CASE("UnwritablePath_IsReportedWithItsReason") {
  CHECK_THROWS_WITH_AS(Writer{"/nonexistent/run.h5"}, doctest::Contains("No such file or directory"), WriteError);
  const TemporaryDirectory directory;  // a directory under the file's name is never removed, overwrite or not
  CHECK_THROWS_AS(Writer(directory / "", {.overwrite = true}), WriteError);
}

TEST_CASE("RunWithoutFinish_IsMarkedFailed") {
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5";
  {
    Writer writer(path);
    writer.series("/time", 1, "s", "time").append(1.5);
  }
  const Reader reader(path);
  CHECK(reader.text_attribute("/", "status") == "failed");
  CHECK(reader.read("/time").values == std::vector<double>{1.5});
}

TEST_CASE("GrowingFile_IsReadableBetweenFlushes") {
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5";
  Writer writer(path);
  const Series time = writer.series("/time", 1, "s", "time");
  for (int k = 0; k < 600; ++k) time.append(k);
  writer.flush();
  for (int k = 600; k < 900; ++k) time.append(k);
  const Reader reader(path);
  CHECK(reader.text_attribute("/", "status") == "running");
  CHECK(reader.rows() == 600);
  CHECK(reader.read("/time").values.back() == 599);
}

TEST_CASE("SeriesBlock_GivesEachSeriesItsRow") {
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5";
  Writer file(path), memory(InMemory{});
  for (Writer* writer : {&file, &memory}) {
    SeriesBlock block;
    const Series time = writer->series("/time", 1, "s", "time");
    block.add(writer->series("/force", 3, "N", "force"));
    block.add(writer->series("/power", 1, "W", "power"));
    CHECK(block.width() == 4);
    for (const double t : {1.0, 2.0}) {
      time.append(t);
      block.append([&](std::span<double> row) {
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = t + 10.0 * static_cast<double>(i);
      });
    }
    const auto give_up = [](std::span<double>) { throw std::runtime_error("no numbers"); };
    CHECK_THROWS_AS(block.append(give_up), std::runtime_error);
    CHECK_THROWS_WITH_AS(block.add(time), doctest::Contains("one right after the other"), ContractError);
  }
  file.finish(Status::completed);
  const Reader reader(path);
  CHECK(reader.read("/force").values == std::vector{1.0, 11.0, 21.0, 2.0, 12.0, 22.0});
  CHECK(reader.read("/power").values == std::vector{31.0, 32.0});
  CHECK(reader.read("/time").values == std::vector{1.0, 2.0});
  CHECK(memory.latest()[1].values == std::vector{2.0, 12.0, 22.0});
  CHECK(memory.latest()[2].values == std::vector{32.0});
}

TEST_CASE("FlushIfDue_WaitsForItsInterval") {
  const TemporaryDirectory directory;
  const auto eager = directory / "eager.h5", lazy = directory / "lazy.h5";
  Writer writes_now(eager, {.flush_interval = 0}), waits(lazy, {.flush_interval = 3600});
  for (Writer* writer : {&writes_now, &waits}) {
    writer->series("/time", 1, "s", "time").append(1);
    writer->flush_if_due();
  }
  CHECK(Reader(eager).rows() == 1);
  CHECK_FALSE(Reader(lazy).has("/time"));
}

// Rows that fill chunks go into the file before a flush is due. It still shows those of the last flush, as it would
// after a kill: a copy of it is what is there then.
TEST_CASE("RowsThatFillChunks_LeaveMemory_AndShowOnceFlushed") {
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5", killed = directory / "killed.h5";
  bool writes_beside = false;
  SUBCASE("at once") {}
  SUBCASE("beside") { writes_beside = true; }
  constexpr int columns = 1000, flushed = 10, steps = 1400;  // in all more than the 8 MiB that are worth moving
  Writer writer(path, {.flush_interval = 3600, .rows = steps, .writes_beside = writes_beside});
  const Series time = writer.series("/time", 1, "s", "time");
  const Series pressure = writer.series("/pressure", columns, "Pa", "pressure");
  std::vector<double> row(columns);
  const auto add = [&](int k) {
    time.append(k);
    for (int i = 0; i < columns; ++i) row[i] = k + 1e-3 * i;
    pressure.append(row);
    writer.flush_if_due();
  };
  int k = 0;
  while (k < flushed) add(k++);
  writer.flush();
  const auto size_then = std::filesystem::file_size(path);
  while (k < steps) add(k++);
  writer.attribute("/", "rows", "all on their way");  // waits for them
  CHECK(std::filesystem::file_size(path) > size_then + 8 * columns * steps / 2);
  std::filesystem::copy_file(path, killed);
  {
    const Reader reader(killed);
    CHECK(reader.rows() == flushed);
    CHECK(reader.read("/pressure").values.back() == flushed - 1 + 1e-3 * (columns - 1));
  }
  writer.finish(Status::completed);
  const Reader reader(path);
  CHECK(reader.rows() == steps);
  const std::vector<double> values = reader.read("/pressure").values;
  REQUIRE(values.size() == std::size_t{columns} * steps);
  bool all_there = true;
  for (int step = 0; step < steps; ++step)
    for (int i = 0; i < columns; ++i) all_there &= values[step * columns + i] == step + 1e-3 * i;
  CHECK(all_there);
}

TEST_CASE("RowsWrittenBeside_AreThoseWrittenAtOnce") {
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5";
  Writer writer(path, {.flush_interval = 0, .writes_beside = true});
  const Series time = writer.series("/time", 1, "s", "time");
  const Series force = writer.series("/force", 3, "N", "force", Precision::float32);
  for (int k = 0; k < 5000; ++k) {
    time.append(k);
    force.append({0.5 * k, 1.0 * k, 2.0 * k});
    writer.flush_if_due();
    if (k == 2500) writer.attribute("/", "half", "way");
  }
  writer.flush();
  const Reader under_way(path);
  CHECK(under_way.rows() == 5000);
  CHECK(under_way.text_attribute("/", "half") == "way");
  writer.finish(Status::completed);
  const Reader reader(path);
  const std::vector<double> times = reader.read("/time").values, forces = reader.read("/force").values;
  REQUIRE(times.size() == 5000);
  REQUIRE(forces.size() == 15000);
  for (std::size_t k = 0; k < times.size(); ++k) {
    REQUIRE(times[k] == static_cast<double>(k));
    for (std::size_t i = 0; i < 3; ++i) REQUIRE(forces[3 * k + i] == times[k] * std::array{0.5, 1.0, 2.0}[i]);
  }
}

TEST_CASE("WrongUse_IsAContractError") {
  const TemporaryDirectory directory;
  Writer writer(directory / "run.h5");
  const Series force = writer.series("/force", 3, "N", "force");
  CHECK_THROWS_WITH_AS(force.append(1.0), doctest::Contains("a row of 1 numbers was given, 3 are due"), ContractError);
  CHECK_THROWS_WITH_AS((void)writer.series("force", 1, "N", "again"), doctest::Contains("declared twice"),
                       ContractError);
  CHECK_THROWS_AS(Series().append(1.0), ContractError);
  writer.finish(Status::completed);
  CHECK_THROWS_AS(force.append({1, 2, 3}), ContractError);
}

TEST_CASE("ForeignFiles_AreRefusedWithAReason") {
  const TemporaryDirectory directory;
  CHECK_THROWS_WITH_AS(Reader{directory / "none.h5"}, doctest::Contains("no such file"), ReadError);
  std::ofstream(directory / "text.h5") << "not HDF5 at all";
  CHECK_THROWS_WITH_AS(Reader{directory / "text.h5"}, doctest::Contains("not a readable HDF5 file"), ReadError);
  const auto path = directory / "future.h5";
  {
    Writer writer(path);
    writer.attribute("/", "format_version", 99);
  }
  CHECK_THROWS_WITH_AS(Reader{path}, doctest::Contains("results format 99"), ReadError);
}

TEST_CASE("MissingOrWrongDataset_IsNamed") {
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5";
  {
    Writer writer(path);
    writer.text("/model", "text", "the model");
    writer.series("/time", 1, "s", "time").append(1);
  }
  const Reader reader(path);
  CHECK_THROWS_WITH_AS((void)reader.read("/bearings/a/h_min"), doctest::Contains("no dataset /bearings/a/h_min"),
                       ReadError);
  CHECK_THROWS_WITH_AS((void)reader.read("/model"), doctest::Contains("does not hold numbers"), ReadError);
  CHECK_THROWS_WITH_AS((void)reader.text("/time"), doctest::Contains("does not hold text"), ReadError);
}

TEST_CASE("ABitThatFlipsInFinishedResults_IsReportedOrHarmless") {
  const TemporaryDirectory scratch;
  {
    Writer writer(scratch / "run.h5");
    const Series time = writer.series("/time", 1, "s", "time");
    for (int k = 0; k < 9; ++k) time.append(k);
    writer.finish(Status::completed);
  }
  std::ifstream file(scratch / "run.h5", std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(file), {}};
  const auto written = Reader(scratch / "run.h5").read("/time").values;
  int reported = 0, tried = 0;
  for (std::size_t bit = 1; bit < 8 * good.size(); bit += 499, ++tried) {
    std::string turned = good;
    turned[bit / 8] = static_cast<char>(turned[bit / 8] ^ (1 << (bit % 8)));
    std::ofstream(scratch / "turned.h5", std::ios::binary) << turned;
    try {
      // Read outside of CHECK, which would take the error for a failure of its own.
      const auto values = Reader(scratch / "turned.h5").read("/time").values;
      CHECK(values == written);
    } catch (const ReadError&) {
      ++reported;
    }
  }
  CHECK(reported >= tried - 1);  // one of them may be a bit of the seal
  // Behind its end nothing matters to HDF5, and a file without a seal is that of a run that was killed.
  std::ofstream(scratch / "killed.h5", std::ios::binary) << good.substr(0, good.size() - 10);
  CHECK(Reader(scratch / "killed.h5").read("/time").values.size() == 9);
}

}  // namespace writer_test
}  // namespace hersey::results
