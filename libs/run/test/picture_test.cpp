#include "hersey/run/picture.h"

#include <doctest/doctest.h>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulation.h"
#include "source_dir.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace picture_test {

model::Model example(const std::string& name) {
  return model::read(std::string(source_dir()) + "/examples/" + name + "/model.yaml");
}

constexpr double kClosed = 1e-12;  // relative residual of the assembly of both, lengths below 1 m

TEST_CASE("Picture_HasThePosesInWhichTheRunStarts") {
  for (const std::string name : {"four_bar", "slider_crank", "engine_oil", "squeezer", "piston", "double_pendulum"}) {
    CAPTURE(name);
    const model::Model model = example(name);
    const Picture picture(model);
    CHECK(picture.assembly().solved());
    CHECK(picture.residual() < kClosed);
    const TemporaryDirectory folder;
    const std::filesystem::path file = folder / "start.h5";
    {
      Options options;
      options.results = file;
      (void)Simulation(model, options).finish();
    }
    const results::Reader reader(file);
    const auto poses = picture.poses();
    REQUIRE(poses.size() == model.bodies.size());
    for (const auto& [body, pose] : poses) {
      const results::Array position = reader.read_rows("/bodies/" + body + "/position", 0, 1);
      const Vector3 r(position.values[0], position.values[1], position.values[2]);
      CHECK((r - pose.r).norm() < 10 * kClosed);
    }
  }
}

TEST_CASE("Picture_WritesWhatAResultsFileHas") {
  const model::Model model = example("slider_crank");
  const TemporaryDirectory folder;
  {
    Options options;
    options.results = folder / "start.h5";
    (void)Simulation(model, options).finish();
  }
  const results::Reader reader(folder / "start.h5");
  results::Writer writer(results::InMemory{.keeps_all = true});
  Picture(model).write(writer);
  for (const auto& [object, attributes] : writer.kept().attributes)
    for (const auto& [name, value] : attributes) {
      const std::string place = object + " " + name;
      CAPTURE(place);
      if (const auto* text = std::get_if<std::string>(&value)) CHECK(reader.text_attribute(object, name) == *text);
      if (const auto* number = std::get_if<double>(&value)) CHECK(reader.number_attribute(object, name) == *number);
    }
  REQUIRE(writer.kept().constants.size() > 30);
  for (const auto& named : writer.kept().constants) {
    const std::string& path = named.first;
    const results::KeptConstant& constant = named.second;
    CAPTURE(path);
    const results::Array array = reader.read(path);
    CHECK(array.values == constant.values);
    CHECK(array.info.unit == constant.unit);
  }
  for (const results::LatestRow& row : writer.latest()) {
    CAPTURE(row.path);
    CHECK(reader.info(row.path).unit == row.unit);
  }
}

TEST_CASE("Picture_OfAnOpenLoopSaysWhereItIsOpen") {
  model::Model model = example("four_bar");
  model.bodies.front().frames.front().X_BF.r *= 10;  // longer than the others together
  const Picture picture(model);
  CHECK_FALSE(picture.assembly().solved());
  CHECK(picture.assembly().message.find("joint") != std::string::npos);
  CHECK(picture.poses().size() == model.bodies.size());
}

}  // namespace picture_test
}  // namespace hersey::run
