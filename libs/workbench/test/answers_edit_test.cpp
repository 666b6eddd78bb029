#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "answers_support.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/skin.h"
#include "hersey/model/written.h"
#include "temporary_directory.h"

namespace hersey::workbench {
namespace answers_edit_test {

const std::string kText = R"(# A bearing to be changed.
hersey: 1
title: "a: title"   # in quotes
parameters:
  load: 500 N   # of the rod

lubricants:
  oil: {viscosity: 15 mPa.s}   # cold
bearings:
  main:
    diameter: 45 mm
    # between two keys
    width: 15.6 mm
    grid: {circumferential: 24, axial: 5}
    supply:
      line: widest_gap
      pressure: "1 bar"
    features:
      hole: {type: hole, phi: 45 deg, z: 0 mm, diameter: 5 mm, pressure: 2 bar}
    lubricant: oil
  # the last word
study:
  parameters:
    load:
      - 300 N
      - 500 N
)";

Json set(const std::string& text, const std::string& key, const Json& value) {
  const Json request{{"path", "a.yaml"}, {"text", text}, {"key", key}, {"value", value}};
  return Json::parse(Answers("/tmp").set_value(request.dump()));
}

Json value_at(const std::string& text, const std::string& key) {
  return Json::parse(model::written_json(text, "a.yaml", {}, key));
}

TEST_CASE("SetValue_ThenRead_GivesTheValueAndLeavesAllOtherLines") {
  const std::vector<std::pair<std::string, std::string>> changes{
      {"title", "another"},
      {"parameters.load", "600 N"},
      {"lubricants.oil.viscosity", "12 mPa.s"},
      {"bearings.main.diameter", "50 mm"},
      {"bearings.main.width", "20 mm"},
      {"bearings.main.grid.axial", "25"},
      {"bearings.main.supply.pressure", "3 bar"},
      {"bearings.main.features.hole.phi", "-90 deg"},
      {"bearings.main.features.hole.pressure", "4 bar"},
      {"study.parameters.load.1", "700 N"},
  };
  for (const auto& change : changes) {
    const std::string &key = change.first, &value = change.second;
    CAPTURE(key);
    const Json answer = set(kText, key, value);
    const std::string changed = answer["text"];
    CHECK(value_at(changed, key) == value);
    CHECK(with_edits(kText, answer["edits"]) == changed);
    const std::vector<std::string> before = lines_of(kText), after = lines_of(changed);
    REQUIRE(before.size() == after.size());
    int different = 0;
    for (std::size_t i = 0; i < before.size(); ++i) different += before[i] != after[i] ? 1 : 0;
    CHECK(different == 1);
    // Back again: not a byte is lost, but for the kind of quotes.
    if (key != "title" && key != "bearings.main.supply.pressure")
      CHECK(set(changed, key, value_at(kText, key))["text"] == kText);
  }
}

TEST_CASE("SetValue_OfAMissingKey_AddsOneLineOrPiece") {
  const std::vector<std::pair<std::string, std::string>> additions{
      {"bearings.main.radial_clearance", "34 um"},
      {"bearings.main.supply.temperature", "40 degC"},
      {"bearings.main.features.hole.surface", "journal"},
      {"bearings.main.operating_point.load", "500 N"},
      {"bearings.main.thermal.shell.wall", "given"},
      {"gravity", "0 -9.81 0 m/s^2"},
      {"simulation.duration", "1 s"},
      {"study.parameters.load.2", "900 N"},
      {"lubricants.water", "{viscosity: 1 mPa.s}"},
  };
  for (const auto& change : additions) {
    const std::string &key = change.first, &value = change.second;
    CAPTURE(key);
    const Json answer = set(kText, key, value);
    const std::string changed = answer["text"];
    const Json found = value_at(changed, key);
    CHECK((found.is_object() ? found == Json{{"viscosity", "1 mPa.s"}} : found == value));
    // Without the new piece the text is the old one.
    const std::vector<std::string> before = lines_of(kText), after = lines_of(changed);
    CHECK(after.size() - before.size() <= 1);
    for (const std::string& line : before) {
      const bool stays = std::find(after.begin(), after.end(), line) != after.end();
      CHECK((stays || line.find('{') != std::string::npos));
    }
    CHECK(set(changed, key, nullptr)["text"].get<std::string>().size() <= changed.size());
  }
}

TEST_CASE("RemoveOfWhatWasAdded_GivesTheTextBack") {
  for (const std::string key : {"bearings.main.radial_clearance", "bearings.main.supply.temperature",
                                "bearings.main.features.hole.surface", "gravity", "study.parameters.load.2"}) {
    CAPTURE(key);
    const std::string added = set(kText, key, "1 m")["text"];
    CHECK(set(added, key, nullptr)["text"] == kText);
  }
}

TEST_CASE("ValuesThatNeedIt_AreQuotedInBraces") {
  const std::string changed = set(kText, "lubricants.oil.note", "one, {two}")["text"];
  CHECK(value_at(changed, "lubricants.oil.note") == "one, {two}");
}

TEST_CASE("LinesEndAsTheTextHasThem") {
  std::string text = "hersey: 1\r\nbearings:\r\n  main:\r\n    width: 1 mm\r\n";
  const std::string changed = set(text, "bearings.main.diameter", "2 mm")["text"];
  CHECK(changed == "hersey: 1\r\nbearings:\r\n  main:\r\n    width: 1 mm\r\n    diameter: 2 mm\r\n");
}

TEST_CASE("WhatCannotBeSet_IsRefused") {
  const auto status = [](const std::string& text, const std::string& key, const Json& value) {
    return status_of([&] { return set(text, key, value); });
  };
  CHECK(status(kText, "bearings.main.diameter.inner", "1 mm") == 422);  // of a number
  CHECK(status(kText, "study.parameters.load.7", "1 N") == 422);        // beyond the next item
  CHECK(status(kText, "title", "[1") == 422);
  CHECK(status(kText, "title", "a\nb: c") == 422);
  CHECK(status(kText, "title", "a # comment") == 422);
  CHECK(status(kText, "titel", nullptr) == 422);
  CHECK(status("hersey: [", "title", "a") == 422);
  CHECK(status("a: &x {b: 1}\nc: *x\n", "c.b", "2") == 422);  // stands in a
}

TEST_CASE("NewKeys_ArePlainWords") {
  for (const std::string key : {"bearings.main.a: b", "bearings.main.a\nb", "bearings.main.", "bearings.main.[a]",
                                "parameters.#", "parameters.&a", "parameters.*a", "parameters.<<", "parameters.null",
                                "lubricants.oil.a, b", "lubricants.oil.{", "new.a: b", "a b"}) {
    CAPTURE(key);
    CHECK(status_of([&] { return set(kText, key, "1 m"); }) == 422);
  }
  for (const std::string key : {"parameters.new-key", "parameters.Größe", "parameters.3", "lubricants.oil.a_1"})
    CHECK(value_at(set(kText, key, "1 m")["text"], key) == "1 m");
}

TEST_CASE("WhereAnythingElseWouldChange_TheRequestIsRefused") {
  const auto status = [](const std::string& text, const std::string& key, const Json& value) {
    return status_of([&] { return set(text, key, value); });
  };
  CHECK(status("? a\n: 1\nb: 2\n", "a", "3") == 422);          // a key in a form that is not known
  CHECK(status("a: &x {b: &y 1}\nc: *y\n", "a", "2") == 422);  // c would name nothing
  CHECK(status("a: &x {b: &y 1}\nc: *y\n", "a.b", nullptr) == 422);
  CHECK(status("a: &x {b: 1}\nc: {<<: *x}\n", "a", "2") == 422);  // c would merge a number
  CHECK(status("l: [a: 1, b: 2]\n", "l.0.c", "2") == 422);
}

TEST_CASE("AnchorsAndAliases_StayAtTheirPlaces") {
  const auto text_of = [](const std::string& text, const std::string& key, const Json& value) {
    return set(text, key, value)["text"].get<std::string>();
  };
  CHECK(text_of("d: &d 3\nl:\n  - *d\n  - 2\n", "l.0", "4") == "d: &d 3\nl:\n  - 4\n  - 2\n");
  CHECK(text_of("d: &d 3\nl:\n  - *d\n  - 2\n", "l.0", nullptr) == "d: &d 3\nl:\n  - 2\n");
  CHECK(text_of("d: &d 3\nl:\n  - 1\n  - *d\n", "l.2", "4") == "d: &d 3\nl:\n  - 1\n  - *d\n  - 4\n");
  CHECK(text_of("l:\n  -\n  - 2\n", "l.0", "4") == "l:\n  - 4\n  - 2\n");
  CHECK(text_of("d: &d 3\ne: *d\n", "d", "4") == "d: &d 4\ne: *d\n");
  CHECK(text_of("d: &d {a: 1}\nm: {<<: *d}\n", "m.b", "4") == "d: &d {a: 1}\nm: {<<: *d, b: 4}\n");
  CHECK(text_of("l:\n  - -1\n  - 2\n", "l.2", "-3") == "l:\n  - -1\n  - 2\n  - -3\n");
  CHECK(text_of("l:\n  - -1\n  - 2\n", "l.0", nullptr) == "l:\n  - 2\n");
}

/// The environment of a test: where the examples are.
struct ExamplesAt {
  explicit ExamplesAt(const std::string& folder) { ::setenv("HERSEY_EXAMPLES", folder.c_str(), 1); }
  ExamplesAt(const ExamplesAt&) = delete;
  ExamplesAt& operator=(const ExamplesAt&) = delete;
  ~ExamplesAt() { ::unsetenv("HERSEY_EXAMPLES"); }
};

TEST_CASE("Examples_AreCopiedWithWhatTheyRead_AndOverwriteNothing") {
  const ExamplesAt examples(examples_folder());
  const TemporaryDirectory folder;
  const Answers answers(folder.path());
  const Json list = Json::parse(answers.examples());
  REQUIRE(list.size() > 30);
  for (const Json& one : list) CHECK_FALSE(one["title"].get<std::string>().empty());
  const std::string of_piston = R"({"example": "piston/model.yaml", "path": "PATH"})";
  const auto at = [&](std::string request, const std::string& path) {
    return request.replace(request.find("PATH"), 4, path);
  };
  // Its table lies in a neighbouring folder, which a file at the top of the folder has none of.
  CHECK(status_of([&] { return answers.new_model(at(of_piston, "piston.yaml")); }) == 422);
  CHECK(std::filesystem::is_empty(folder.path()));
  const Json made = Json::parse(answers.new_model(at(of_piston, "own/piston")));
  CHECK(made["path"] == "own/piston.yaml");
  const std::string source = contents_of(examples_folder() + "/piston/model.yaml");
  CHECK(contents_of(folder.path() / "own/piston.yaml") == source);
  CHECK(contents_of(folder.path() / "slider_crank/gas_pressure.csv") ==
        contents_of(examples_folder() + "/slider_crank/gas_pressure.csv"));
  const Json checked{{"path", "own/piston.yaml"}, {"text", source}, {"depth", "text"}};
  CHECK(Json::parse(answers.check(checked.dump()))["faults"].empty());
  // A second copy uses the same table, unless that has become another one.
  CHECK(status_of([&] { return answers.new_model(at(of_piston, "own/piston")); }) == 409);
  CHECK(Json::parse(answers.new_model(at(of_piston, "own/second")))["files"].size() == 1);
  std::ofstream(folder.path() / "slider_crank/gas_pressure.csv") << "own";
  CHECK(status_of([&] { return answers.new_model(at(of_piston, "own/third")); }) == 409);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "own/third.yaml"));
  CHECK(contents_of(folder.path() / "slider_crank/gas_pressure.csv") == "own");
  // A pipe is not waited for.
  std::filesystem::remove(folder.path() / "slider_crank/gas_pressure.csv");
  REQUIRE(::mkfifo((folder.path() / "slider_crank/gas_pressure.csv").c_str(), 0600) == 0);
  CHECK(status_of([&] { return answers.new_model(at(of_piston, "own/third")); }) == 409);
  CHECK(status_of([&] { return answers.new_model(R"({"example": "../piston/model.yaml", "path": "a"})"); }) == 404);
  CHECK(status_of([&] { return answers.new_model(R"({"example": "four_bar/model.yaml", "path": "../a"})"); }) == 403);
}

TEST_CASE("Examples_MayBeNamedRelativeToWhereTheProgramIs") {
  const ExamplesAt examples(std::filesystem::relative(examples_folder()).string());
  const TemporaryDirectory folder;
  const Answers answers(folder.path());
  const Json made = Json::parse(answers.new_model(R"({"example": "piston/model.yaml", "path": "own/piston"})"));
  CHECK(made["files"].size() == 2);
  CHECK(contents_of(folder.path() / "own/piston.yaml") == contents_of(examples_folder() + "/piston/model.yaml"));
}

TEST_CASE("TemplateScene_IsThatOfItsTextInTheFolder") {
  const ExamplesAt examples(examples_folder());
  const TemporaryDirectory folder;
  const Answers answers(folder.path());
  const auto scene = [&](const char* request) { return Json::parse(answers.template_scene(request))["scene"]; };
  const Json copy = Json::parse(Answers(examples_folder()).check(example_request("piston/model.yaml").dump()))["scene"];
  CHECK(scene(R"({"example": "piston/model.yaml"})") == copy);
  CHECK(scene(R"({"template": "bearing"})")["bearings"].size() == 1);
  // Of pads by themselves their machine is drawn.
  CHECK(scene(R"({"template": "tilting_pads"})")["bearings"].size() == 5);
  CHECK(status_of([&] { return answers.template_scene(R"({"template": "none"})"); }) == 422);
}

TEST_CASE("Templates_AreReadWithoutFault_AndWrittenOnce") {
  const TemporaryDirectory folder;
  const Answers answers(folder.path());
  const Json templates = Json::parse(answers.templates());
  REQUIRE(templates.size() > 5);
  for (const Json& one : templates) {
    const std::string name = one["name"];
    CAPTURE(name);
    CHECK_FALSE(one["title"].get<std::string>().empty());
    const Json request{{"path", name + ".yaml"}, {"text", one["text"]}, {"depth", "text"}};
    CHECK(Json::parse(answers.check(request.dump()))["faults"].empty());
  }
  const std::string request = R"({"template": "bearing", "path": "mine"})";
  CHECK(Json::parse(answers.new_model(request))["path"] == "mine.yaml");
  std::ofstream(folder.path() / "mine.yaml") << "own";
  CHECK(status_of([&] { return answers.new_model(request); }) == 409);
  CHECK(contents_of(folder.path() / "mine.yaml") == "own");
  std::filesystem::create_symlink("elsewhere.yaml", folder.path() / "linked.yaml");
  CHECK(status_of([&] { return answers.new_model(R"({"template": "bearing", "path": "linked"})"); }) == 403);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "elsewhere.yaml"));
  CHECK(status_of([&] { return answers.new_model(R"({"template": "none", "path": "b"})"); }) == 422);
  CHECK(status_of([&] { return answers.new_model(R"({"template": "bearing", "path": "../b"})"); }) == 403);
  CHECK(status_of([&] { return answers.new_model(R"({"template": "bearing", "path": ".b"})"); }) == 403);
  const TemporaryDirectory elsewhere;
  std::filesystem::create_directory_symlink(elsewhere.path(), folder.path() / "link");
  CHECK(status_of([&] { return answers.new_model(R"({"template": "bearing", "path": "link/b"})"); }) == 403);
  CHECK(status_of([&] { return answers.mesh_info(R"({"path": "link/b.msh"})"); }) == 403);
  CHECK(std::filesystem::is_empty(elsewhere.path()));
}

TEST_CASE("SurfacesOfAMesh_ArePickedAndWrittenIntoAModel") {
  const Answers answers(examples_folder() + "/meshes");
  const Json request{{"path", "conrod.msh"}, {"length_unit", "mm"}, {"picture", true}, {"body", "rod"}};
  const Json answer = Json::parse(answers.mesh_info(request.dump()));
  // Every triangle of the outside belongs to one surface or to the rest.
  std::size_t triangles = answer["picture"]["rest"]["triangles"].size() / 3;
  for (const Json& surface : answer["picture"]["surfaces"]) {
    triangles += surface["triangles"].size() / 3;
    const int corners = static_cast<int>(surface["corners"].size() / 3);
    for (const Json& corner : surface["triangles"]) CHECK(corner < corners);
  }
  const fem::Mesh mesh = fem::read_mesh(examples_folder() + "/meshes/conrod.msh", 1e-3);
  CHECK(triangles == fem::skin(mesh).triangles.size());
  // What is written for a bore is a frame and a bearing, as the lines for all of them say it.
  const Json& uses = answer["uses"];
  const auto bore = std::find_if(uses.begin(), uses.end(), [](const Json& use) { return use["bearing"] != ""; });
  REQUIRE(bore != uses.end());
  const std::string lines = answer["lines"], frame = (*bore)["frame"], bearing = (*bore)["bearing"];
  CHECK(lines.find(": " + frame + "\n") != std::string::npos);
  CHECK(bearing.starts_with("{shell: rod." + (*bore)["key"].get<std::string>() + ", "));
  // With names for all surfaces there are uses of all.
  const TemporaryDirectory folder;
  std::filesystem::copy_file(examples_folder() + "/meshes/conrod.msh", folder.path() / "conrod.msh");
  const Answers in_folder(folder.path());
  const std::string naming = R"({"path": "conrod.msh", "length_unit": "mm", "output": "named.msh"})";
  CHECK(Json::parse(in_folder.name_surfaces(naming))["path"] == "named.msh");
  CHECK(status_of([&] { return in_folder.name_surfaces(naming); }) == 409);
  const Json named = Json::parse(in_folder.mesh_info(R"({"path": "named.msh", "length_unit": "m"})"));
  CHECK(named["unnamed"] == 0);
  CHECK(named["uses"].size() >= answer["found"].size());
}

TEST_CASE("NamesOfAMesh_AreQuotedWhereYamlNeedsIt") {
  const std::string mesh = contents_of(examples_folder() + "/meshes/conrod.msh");
  const TemporaryDirectory folder;
  const Answers answers(folder.path());
  const auto info_with = [&](const std::string& name, const std::string& body) {
    std::string text = mesh;
    text.replace(text.find("big_end"), 7, name);
    std::ofstream(folder.path() / "the rod.msh", std::ios::binary) << text;
    const Json request{{"path", "the rod.msh"}, {"length_unit", "mm"}, {"body", body}, {"picture", true}};
    return Json::parse(answers.mesh_info(request.dump()));
  };
  for (const std::string name : {"big end", "a, b", "bore: {1", "it's #1", "back\\slash", "true", "1e3", "bore"}) {
    CAPTURE(name);
    const Json answer = info_with(name, "rod: 2");
    const auto use = [&] {
      for (const Json& one : answer["uses"])
        if (one["name"] == name) return one;
      return Json();
    }();
    REQUIRE(use.is_object());
    // Both texts, and the lines for all, are read as what they say.
    const auto written = [&](const std::string& text, const std::string& key) {
      return Json::parse(model::written_json(text, "a.yaml", {}, key));
    };
    const std::string frame = use["frame"], bearing = use["bearing"], lines = answer["lines"], key = use["key"];
    CHECK(written("bodies: {rod: {frames: {a: " + frame + "}}}", "bodies.rod.frames.a.nodes") == name);
    const std::string whole = "bearings: {a: " + bearing + "}";
    CHECK(written(whole, "bearings.a.shell") == "rod: 2." + key);
    CHECK(written(whole, "bearings.a.shell_surface.faces") == name);
    const std::string model = lines.substr(lines.find('\n') + 1);
    CHECK(written(model, "bodies.part.flexible.mesh") == "the rod.msh");
    CHECK(written(model, "bodies.part.frames." + key + ".nodes") == name);
    CHECK((bearing.find('"') != std::string::npos));
    CHECK((frame.find('"') == std::string::npos) == (name == "bore"));
  }
  // Bytes that are no text are shown as such.
  const Json answer = info_with("\xff", "rod");
  CHECK(answer["mesh"]["sets"]["surfaces"].contains("\xef\xbf\xbd"));
}

}  // namespace answers_edit_test
}  // namespace hersey::workbench
