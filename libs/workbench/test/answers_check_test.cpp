#include <algorithm>

#include "answers_support.h"
#include "hersey/model/read.h"

namespace hersey::workbench {
namespace answers_check_test {

/// A bearing in a machine, to be spoilt.
const std::string kRig = R"(hersey: 1   # a comment
parameters: {load: 500 N}
bodies:
  pin: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
  rod:
    mass: 0.5 kg
    inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}
joints:
  main: {type: revolute, between: [ground, pin]}
  guide:
    type: planar
    between: [ground, rod]
drives:
  motor: {joint: main, coordinate: rotation, speed: 3000 rpm}
forces:
  push: {type: force, body: rod, components: [0 N, "-${load}", 0 N]}
lubricants:
  oil: {viscosity: 15 mPa.s}
bearings:
  big_end:
    shell: rod
    journal: pin
    diameter: 45 mm
    width: 15.6 mm
    radial_clearance: 34 um
    lubricant: oil
    grid: {circumferential: 24, axial: 5}
simulation:
  duration: 4 ms
  step: 0.1 ms
)";

std::string replaced(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), replacement);
}

Json check_of(const std::string& text, const std::string& depth = "text") {
  return Json::parse(Answers("/tmp").check(Json{{"path", "rig.yaml"}, {"text", text}, {"depth", depth}}.dump()));
}

std::vector<Fault> faults_of(const std::string& text) {
  try {
    (void)model::read_text(text, "/tmp/rig.yaml");
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

/// What a user may do wrong, by what the text has and what takes its place.
const std::vector<std::pair<std::string, std::string>> kMistakes{
    {"    mass: 0.5 kg", "    mas: 0.5 kg"},
    {"type: revolute", "type: revolut"},
    {"between: [ground, rod]", "between: [ground, rodd]"},
    {"    diameter: 45 mm\n", ""},
    {"    diameter: 45 mm", "    diameter: 45"},
    {"width: 15.6 mm", "width: 15.6 mmm"},
    {"width: 15.6 mm", "width: 15,6 mm"},
    {"    lubricant: oil\n", ""},
    {"lubricant: oil", "lubricant: oyl"},
    {"lubricant: oil", "lubricant: oil\n    radius: 3 mm"},
    {"radial_clearance: 34 um", "radial_clearance: 34 um\n    diametral_clearance: 68 um"},
    {"    radial_clearance: 34 um\n", ""},
    {"  step: 0.1 ms\n", ""},
    {"type: revolute, ", ""},
    {"coordinate: rotation", "coordinate: rotatoin"},
};

TEST_CASE("Check_OfAGoodText_HasNoFaultAndAScene") {
  const Json answer = check_of(kRig, "start");
  CHECK(answer["faults"].empty());
  CHECK(answer["missing"].empty());
  CHECK(answer["parameters"] == Json{{"load", "500 N"}});
  CHECK(answer["runs"] == 1);
  CHECK(answer["scene"]["rows"] == 1);
}

TEST_CASE("Faults_StandWhereTheReaderFindsThem") {
  for (const auto& change : kMistakes) {
    const std::string &old = change.first, &mistake = change.second;
    CAPTURE(mistake);
    const std::string text = replaced(kRig, old, mistake);
    const std::vector<Fault> expected = faults_of(text);
    const Json answer = check_of(text);
    REQUIRE(!expected.empty());
    REQUIRE(answer["faults"].size() == expected.size());
    CHECK(answer["scene"].is_null());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Json& fault = answer["faults"][i];
      CHECK(fault["line"] == expected[i].position.line);
      CHECK(fault["column"] == expected[i].position.column);
      CHECK(fault["file"] == "rig.yaml");
      CHECK(fault["found"] == expected[i].found);
      // The mark is a word of the text, on one line.
      CHECK(fault["endLine"] == fault["line"]);
      CHECK(fault["endColumn"] > fault["column"]);
      const std::string line = lines_of(text)[fault["line"].get<std::size_t>() - 1];
      CHECK(fault["endColumn"].get<std::size_t>() <= line.size() + 1);
    }
  }
}

TEST_CASE("EveryRepair_RemovesItsFault") {
  for (const auto& change : kMistakes) {
    const std::string &old = change.first, &mistake = change.second;
    CAPTURE(mistake);
    const std::string text = replaced(kRig, old, mistake);
    const Json answer = check_of(text);
    std::size_t repairs = 0;
    for (const Json& fault : answer["faults"]) {
      for (const Json& repair : fault["repairs"]) {
        CAPTURE(repair["label"].get<std::string>());
        const std::string mended = with_edits(text, repair["edits"]);
        for (const Json& left : check_of(mended)["faults"])
          CHECK_FALSE((left["found"] == fault["found"] && left["path"] == fault["path"]));
        ++repairs;
      }
    }
    CHECK(repairs > 0);
  }
}

TEST_CASE("TheFirstRepair_OfANearName_GivesTheTextBack") {
  for (const auto& change : kMistakes) {
    const std::string &old = change.first, &mistake = change.second;
    if (mistake.find("mas:") == std::string::npos && mistake.find("revolut") == std::string::npos &&
        mistake.find("rodd") == std::string::npos && mistake.find("oyl") == std::string::npos &&
        mistake.find("mmm") == std::string::npos)
      continue;
    CAPTURE(mistake);
    const std::string text = replaced(kRig, old, mistake);
    const Json answer = check_of(text);
    const auto fault = std::find_if(answer["faults"].begin(), answer["faults"].end(), [](const Json& one) {
      return one["suggestion"].get<std::string>().starts_with("did you mean");
    });
    REQUIRE(fault != answer["faults"].end());
    CHECK(with_edits(text, (*fault)["repairs"][0]["edits"]) == kRig);
  }
}

TEST_CASE("AStudyWithoutParameters_GetsThatOfTheModel") {
  const std::string text = kRig + "study:\n";
  const Json answer = check_of(text);
  REQUIRE(answer["faults"].size() == 1);
  const std::string mended = with_edits(text, answer["faults"][0]["repairs"][0]["edits"]);
  CHECK(mended.find("parameters: {load: [500 N]}") != std::string::npos);
  CHECK(check_of(mended)["faults"].empty());
}

TEST_CASE("ARepair_InAValueOfSeveralLines_IsMadeInItsLine") {
  for (const std::string value : {"width: 15.6\n      mmm", "width: \"15.6\n\n      mmm\""}) {
    CAPTURE(value);
    const std::string text = replaced(kRig, "width: 15.6 mm", value);
    const Json answer = check_of(text);
    REQUIRE(answer["faults"].size() == 1);
    REQUIRE(!answer["faults"][0]["repairs"].empty());
    const Json edits = answer["faults"][0]["repairs"][0]["edits"];
    CHECK(with_edits(text, edits) == replaced(text, "mmm", "mm"));
    CHECK(lines_of(text)[edits[0]["line"].get<std::size_t>() - 1].find("mmm") != std::string::npos);
    CHECK(edits[0]["column"] == 7);
  }
}

TEST_CASE("OfThousandsOfFaults_FiveHundredAreListedAndTheOthersCounted") {
  constexpr std::size_t kMany = 2000;
  std::string unknown, parameters;
  for (std::size_t i = 0; i < kMany; ++i) {
    unknown += "  unknown_" + std::to_string(i) + ": {mass: 1}\n";
    parameters += "  p_" + std::to_string(i) + ": " + std::to_string(i) + " N\n";
  }
  const std::string text = replaced(replaced(kRig, "  pin:", unknown + "  pin:"), "parameters: {load: 500 N}\n",
                                    "parameters:\n  load: 500 N\n" + parameters);
  const Json answer = check_of(text);
  CHECK(answer["faults"].size() == 500);
  CHECK(answer["outline"].size() == 500);
  CHECK(answer["missing"].size() <= 500);
  CHECK(answer["left_out"]["faults"] == faults_of(text).size() - 500);
  CHECK(answer["left_out"]["outline"] > kMany);
  CHECK(answer["left_out"]["warnings"] == 0);
  CHECK(answer["parameters"].size() == kMany + 1);
  CHECK(answer["parameters"]["p_7"] == "7 N");
  const Json few = check_of(replaced(kRig, "    mass: 0.5 kg", "    mas: 0.5 kg"));
  for (const char* key : {"faults", "warnings", "outline"}) CHECK(few["left_out"][key] == 0);
}

TEST_CASE("AByteOrderMark_ShiftsColumnsOfTheFirstLineAlone") {
  const std::string mark = "\xEF\xBB\xBF";
  const std::string spoilt = replaced(kRig, "hersey: 1   # a comment\nparameters: {load: 500 N}",
                                      "{hersey: 1, parameters: {load: 500 N}, bodis: {}}");
  const std::string first_line = spoilt.substr(0, spoilt.find('\n') + 1);
  const Json plain = check_of(first_line), marked = check_of(mark + first_line);
  REQUIRE(!plain["faults"].empty());
  REQUIRE(plain["faults"][0]["line"] == 1);
  REQUIRE(plain["faults"].size() == marked["faults"].size());
  for (std::size_t i = 0; i < plain["faults"].size(); ++i) {
    Json before = plain["faults"][i], after = marked["faults"][i];
    const bool is_placed = before["line"] == 1;
    CHECK(after["found"] == before["found"]);
    // The mark is one unit for a browser.
    if (is_placed) CHECK(after["column"].get<int>() == before["column"].get<int>() + 1);
    if (is_placed) CHECK(after["endColumn"].get<int>() == before["endColumn"].get<int>() + 1);
    CHECK(after["repairs"].size() == before["repairs"].size());
  }
  const std::string later = replaced(kRig, "    mass: 0.5 kg", "    mas: 0.5 kg");
  CHECK(check_of(mark + later)["faults"] == check_of(later)["faults"]);
  const std::string tabs = mark + "\thersey: 1\n";
  for (const Json& fault : check_of(tabs)["faults"])
    for (const Json& repair : fault["repairs"]) CHECK(repair["edits"][0]["column"] == 2);
}

TEST_CASE("ColumnsCountAsBrowsersDo") {
  // Two bytes for the letter, four for the sign, which a browser counts as two.
  const std::string plain = replaced(kRig, "500 N}", "500 N, note: aaa, load_2: 1 M}");
  const std::string wide = replaced(kRig, "500 N}", "500 N, note: ä😀, load_2: 1 M}");
  const auto last_edit = [](const std::string& text) {
    const Json request{{"path", "rig.yaml"}, {"text", text}, {"key", "parameters.load_2"}, {"value", "2 N"}};
    return Json::parse(Answers("/tmp").set_value(request.dump()))["edits"].back();
  };
  CHECK(last_edit(plain) == last_edit(wide));
}

TEST_CASE("SyntaxErrors_AreFaults") {
  for (const std::string text :
       {"hersey: 1\nbodies: [", "hersey: 1\nbodies:\n\tpin: {}", "", "- 1\n- 2\n", "a: b: c"}) {
    CAPTURE(text);
    const Json answer = check_of(text, "start");
    CHECK(!answer["faults"].empty());
    CHECK(answer["scene"].is_null());
  }
  const std::string tabs = "hersey: 1\nbodies:\n\tpin: {}\n";
  const Json repair = check_of(tabs)["faults"][0]["repairs"][0];
  CHECK(with_edits(tabs, repair["edits"]) == "hersey: 1\nbodies:\n  pin: {}\n");
}

TEST_CASE("WrongIndentation_IsMendedToAnyDepthThatIsAllowed") {
  for (const char* spaces : {"     ", "   "}) {
    const std::string text = replaced(kRig, "    width: 15.6 mm", spaces + std::string("width: 15.6 mm"));
    const Json faults = check_of(text)["faults"];
    REQUIRE(faults.size() == 1);
    const Json& repairs = faults[0]["repairs"];
    REQUIRE(repairs.size() == 3);
    CHECK(repairs[0]["label"] == "Indent as 'diameter'");
    CHECK(with_edits(text, repairs[0]["edits"]) == kRig);
    CHECK(with_edits(text, repairs[2]["edits"]) == replaced(kRig, "    width: 15.6 mm", "width: 15.6 mm"));
  }
}

TEST_CASE("MisspelledKey_IsMendedByOneRepair") {
  for (const char* key : {"bodies:", "lubricants:", "joints:", "    diameter:"}) {
    const std::string word(key),
        wrong = word.substr(0, word.size() - 3) + word[word.size() - 2] + word[word.size() - 3] + ":";
    const std::string text = replaced(kRig, "\n" + word, "\n" + wrong);
    const Json faults = check_of(text)["faults"];
    REQUIRE(faults.size() == 1);
    CHECK(with_edits(text, faults[0]["repairs"][0]["edits"]) == kRig);
  }
}

TEST_CASE("WhatIsMissingToRun_IsListed") {
  const Json unfinished = check_of(replaced(kRig, "    lubricant: oil\n", ""));
  REQUIRE(unfinished["missing"].size() == 1);
  CHECK(unfinished["missing"][0].get<std::string>().starts_with("bearings.big_end: 'lubricant'"));
  const Json alone = Json::parse(Answers(examples_folder()).check(example_request("bearing_alone/model.yaml").dump()));
  CHECK(alone["faults"].empty());
  CHECK(alone["missing"].size() == 2);
}

TEST_CASE("AStartThatIsNone_IsAFaultOfTheDeeperCheckAlone") {
  const std::string text =
      replaced(kRig, "    between: [ground, rod]", "    between: [ground, rod]\n    initial: {x: 1 mm}");
  CHECK(check_of(text, "text")["faults"].empty());
  const Json answer = check_of(text, "start");
  REQUIRE(answer["faults"].size() == 1);
  CHECK(answer["faults"][0]["path"] == "bearings.big_end");
  CHECK(answer["scene"]["rows"] == 1);  // drawn as it is
}

TEST_CASE("BadRequests_AreRefused") {
  const Answers answers("/tmp");
  CHECK(status_of([&] { return answers.check("no json"); }) == 400);
  CHECK(status_of([&] { return answers.check("[1]"); }) == 400);
  CHECK(status_of([&] { return answers.check(R"({"path": "a.yaml"})"); }) == 400);
  CHECK(status_of([&] { return answers.check(R"({"path": "../a.yaml", "text": ""})"); }) == 403);
  CHECK(status_of([&] { return answers.check(R"({"path": "/etc/passwd", "text": ""})"); }) == 403);
  CHECK(status_of([&] { return answers.explain(R"({"key": "bearings.x.diamter"})"); }) == 404);
  CHECK(status_of([&] { return answers.convert(R"({"text": "45 mm", "unit": "s"})"); }) == 422);
  CHECK(status_of([&] { return answers.convert(R"({"text": "wide", "unit": "m"})"); }) == 422);
}

TEST_CASE("ConversionAndBack_GivesTheValueBack") {
  const Answers answers("/tmp");
  const auto convert = [&](const std::string& text, const std::string& unit) {
    return Json::parse(answers.convert(Json{{"text", text}, {"unit", unit}}.dump()))["text"].get<std::string>();
  };
  const std::vector<std::pair<std::string, std::string>> values{
      {"45 mm", "in"}, {"3570 rpm", "rad/s"}, {"20 degC", "K"}, {"0 48 12.5 mm", "m"}, {"2 bar", "Pa"}};
  for (const auto& change : values) {
    const std::string &text = change.first, &unit = change.second;
    CAPTURE(text);
    const std::string there = convert(text, unit);
    CHECK(there.ends_with(" " + unit));
    CHECK(convert(there, text.substr(text.rfind(' ') + 1)) == text);
  }
}

TEST_CASE("Explanations_AreThoseOfTheCommand") {
  const Answers answers("/tmp");
  const Json clearance = Json::parse(answers.explain(R"({"key": "bearings.main.radial_clearance"})"));
  CHECK(clearance["kind"] == "quantity");
  CHECK(clearance["unit"] == "m");
  CHECK(clearance["plain"].get<std::string>().find(clearance["text"].get<std::string>()) != std::string::npos);
  const Json type = Json::parse(answers.explain(R"({"key": "joints.main.type"})"));
  CHECK(type["kind"] == "choice");
  CHECK(type["allowed"].size() > 5);
  CHECK(type["example"] == "fixed");
  CHECK_FALSE(Json::parse(answers.explain(R"({"key": ""})"))["plain"].get<std::string>().empty());
  CHECK(Json::parse(answers.schema())["$schema"].is_string());
}

TEST_CASE("Outline_NamesKeysWhereTheyStand") {
  const Answers answers(examples_folder());
  for (const std::string path : {"engine_oil/model.yaml", "slider_crank/model.yaml", "hot_bearing/model.yaml"}) {
    const Json request = example_request(path);
    const std::string text = request["text"];
    const Json answer = Json::parse(answers.check(Json{{"path", path}, {"text", text}, {"depth", "text"}}.dump()));
    for (const auto& entry : answer["outline"]) {
      const std::string key = entry["path"];
      CAPTURE(key);
      const std::string line = lines_of(text)[entry["line"].get<std::size_t>() - 1];
      CHECK(line.substr(entry["column"].get<std::size_t>() - 1).starts_with(key.substr(key.rfind('.') + 1)));
    }
  }
}

}  // namespace answers_check_test
}  // namespace hersey::workbench
