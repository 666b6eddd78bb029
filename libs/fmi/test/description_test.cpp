#include "hersey/fmi/description.h"

#include <doctest/doctest.h>

namespace hersey::fmi {
namespace description_test {

constexpr const char* kTwo = R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="pump &amp; valve" guid="{1-2}">
 <CoSimulation modelIdentifier="pump" canGetAndSetFMUstate="true" canSerializeFMUstate="1"/>
 <UnitDefinitions>
  <Unit name="degC"><BaseUnit K="1" offset="273.15"/></Unit>
  <Unit name="bar"><BaseUnit kg="1" m="-1" s="-2" factor="1e5"/><DisplayUnit name="psi" factor="14.5"/></Unit>
 </UnitDefinitions>
 <TypeDefinitions><SimpleType name="Pressure"><Real quantity="Pressure" unit="bar"/></SimpleType>
  <SimpleType name="Rise"><Real unit="degC" relativeQuantity="true"/></SimpleType></TypeDefinitions>
 <ModelVariables>
  <ScalarVariable name="T" valueReference="3" causality="input"><Real unit="degC" start="20"/></ScalarVariable>
  <ScalarVariable name="p" valueReference="4" causality="output"><Annotations/><Real declaredType="Pressure"/></ScalarVariable>
  <ScalarVariable name="n" valueReference="4294967295" causality="parameter" variability="fixed"><Integer start="2"/></ScalarVariable>
  <ScalarVariable name="x" valueReference="5"><Real unit="bananas"/></ScalarVariable>
  <ScalarVariable name="rise" valueReference="6"><Real unit="degC" relativeQuantity="true"/></ScalarVariable>
  <ScalarVariable name="fall" valueReference="7"><Real declaredType="Rise"/></ScalarVariable>
 </ModelVariables>
</fmiModelDescription>)";

constexpr const char* kThree = R"(<fmiModelDescription fmiVersion="3.0.1" modelName="m" instantiationToken="t">
 <ModelExchange modelIdentifier="other"/>
 <CoSimulation modelIdentifier="m" canGetAndSetFMUState="true" fixedInternalStepSize="1e-3"/>
 <TypeDefinitions><Float64Type name="Speed" unit="rad/s"/></TypeDefinitions>
 <ModelVariables>
  <Float64 name="w" valueReference="1" causality="input" declaredType="Speed"/>
  <Float64 name="row" valueReference="2" causality="output"><Dimension start="3"/></Float64>
  <Float32 name="f" valueReference="3" causality="output"/>
  <Boolean name="b" valueReference="4" causality="parameter" variability="constant" start="true"/>
 </ModelVariables>
</fmiModelDescription>)";

std::string error_of(const std::string& xml) {
  try {
    (void)read_description(xml);
  } catch (const FmuError& error) {
    return error.what();
  }
  return {};
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

TEST_CASE("DescriptionOfFmi2_IsReadWithUnitsOfDeclaredTypes") {
  const Description found = read_description(kTwo);
  CHECK(found.version == 2);
  CHECK(found.model_name == "pump & valve");
  CHECK(found.token == "{1-2}");
  CHECK(found.model_identifier == "pump");
  CHECK(found.saves_state);
  REQUIRE(found.variables.size() == 6);
  for (const char* name : {"rise", "fall"}) {
    CHECK(found.find(name)->is_relative);
    CHECK(found.find(name)->unit->offset == 0);
    CHECK(found.find(name)->unit->powers[4] == 1);
  }
  CHECK(!found.find("T")->is_relative);
  CHECK(found.find("T")->unit->offset == 273.15);
  const Variable &T = *found.find("T"), &p = *found.find("p"), &n = *found.find("n");
  CHECK(T.causality == Causality::input);
  CHECK(T.unit->offset == 273.15);
  CHECK(T.unit->base_units() == "K");
  CHECK(p.unit->factor == 1e5);
  CHECK(p.unit->base_units() == "kg.m-1.s-2");
  CHECK(n.type == VariableType::integer);
  CHECK(n.reference == 4294967295U);
  CHECK(!n.unit);
  CHECK(found.find("x")->causality_name == "local");
  CHECK(!found.find("x")->unit->is_defined);
  CHECK(found.find("y") == nullptr);
  CHECK(found.names(Causality::output) == std::vector<std::string>{"p"});
}

TEST_CASE("DescriptionOfFmi3_IsReadWithArraysAndOtherTypes") {
  const Description found = read_description(kThree);
  CHECK(found.version == 3);
  CHECK(found.token == "t");
  CHECK(found.model_identifier == "m");
  CHECK(!found.saves_state);  // it can be got and set, and not serialised
  CHECK(found.fixed_internal_step == 1e-3);
  CHECK(found.find("w")->unit->name == "rad/s");
  CHECK(found.find("row")->is_array);
  CHECK(found.find("f")->type == VariableType::other);
  CHECK(found.find("b")->is_constant);
  CHECK(found.names(Causality::output) == std::vector<std::string>{"f"});
}

TEST_CASE("DescriptionThatIsNone_IsRefusedWithItsReason") {
  CHECK(error_of("<a>").find("line 1") != std::string::npos);
  CHECK(error_of("").find("modelDescription.xml") == 0);
  CHECK(error_of("<a/>").find("begins with <a>") != std::string::npos);
  CHECK(error_of(changed(kTwo, "2.0", "1.0")).find("FMI '1.0'") != std::string::npos);
  CHECK(error_of(changed(kTwo, "CoSimulation", "ModelExchange")).find("model exchange") != std::string::npos);
  CHECK(error_of(changed(kTwo, "\"pump\"", "\"../pump\"")).find("no name of a library") != std::string::npos);
  CHECK(error_of(changed(kTwo, "\"3\"", "\"-3\"")).find("no whole number") != std::string::npos);
  CHECK(error_of(changed(kTwo, "1e5", "nan")).find("no number") != std::string::npos);
  CHECK(error_of("<!DOCTYPE a [<!ENTITY b \"c\">]><a>&b;</a>").find("document type") != std::string::npos);
  std::string deep;
  for (int i = 0; i < 1000; ++i) deep += "<a>";
  CHECK(error_of(deep).find("too deep") != std::string::npos);
}

}  // namespace description_test
}  // namespace hersey::fmi
