#include "hersey/run/named_part.h"

#include <doctest/doctest.h>

#include <map>
#include <string>

namespace hersey::run {
namespace {

const std::map<std::string, SourcePosition> kPositions{{"bearings", {"model.yaml", 1, 1}},
                                                       {"bearings.big_end", {"model.yaml", 2, 3}},
                                                       {"bearings.big_end.grid", {"model.yaml", 3, 5}},
                                                       {"joints.crank", {"model.yaml", 7, 3}},
                                                       {"circuit.elements.feed", {"model.yaml", 9, 5}}};

std::string path_in(const std::string& message) {
  const auto part = named_part(message, kPositions);
  return part ? part->path : "";
}

TEST_CASE("NamedPart_IsTheFirstThatAMessageNames") {
  CHECK(path_in("t = 0.001 s: bearing big_end: the journal touches the shell; joint crank is far") ==
        "bearings.big_end");
  CHECK(path_in("joint crank, rotation: the forces there are not numbers; bearing big_end") == "joints.crank");
  CHECK(path_in("circuit: pump feed turns backwards") == "circuit.elements.feed");
  CHECK(named_part("bearing big_end", kPositions)->position.line == 2);
}

TEST_CASE("NamedPart_IsNoneThatTheTextDoesNotHave") {
  CHECK(path_in("the disk is full") == "");
  CHECK(path_in("the body has no mass") == "");
  CHECK(path_in("bearing main: touches") == "");
  CHECK(path_in("") == "");
  CHECK_FALSE(named_part("bearing big_end", {{"bearings.big_end", {"model.yaml", 0, 0}}}));
}

}  // namespace
}  // namespace hersey::run
