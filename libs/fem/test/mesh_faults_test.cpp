// Contents of mesh files are followed, refused or reported: each keyword and entry that changes geometry, connections,
// material or coordinates.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "hersey/fem/elastic_body.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"

namespace hersey::fem {
namespace mesh_faults_test {

/// What reading a text leads to: a refusal, or warnings and faults of materials, as "line: found; line: found".
struct Answer {
  std::string refusal;
  std::string warnings, materials;
  std::vector<Fault> material_faults;
  Mesh mesh;
};

std::string text_of(const Fault& fault) { return std::to_string(fault.position.line) + ": " + fault.found; }

std::string text_of(const std::vector<Fault>& faults) {
  std::string all;
  for (const Fault& fault : faults) all += (all.empty() ? "" : "; ") + text_of(fault);
  return all;
}

Answer read(const std::string& text, MeshFormat format, const IncludeLoader& include = {}) {
  Answer answer;
  std::vector<Fault> warnings;
  try {
    answer.mesh = parse_mesh(text, format, "x", 1, &warnings, include, &answer.material_faults);
  } catch (const InputError& error) {
    answer.refusal = text_of(error.faults().at(0));
  }
  answer.warnings = text_of(warnings);
  answer.materials = text_of(answer.material_faults);
  return answer;
}

const std::string kNodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,1,1,1\n";
// Elements 1 and 2 in sets a and b, lines 7 to 10.
const std::string kTets = kNodes + "*ELEMENT,TYPE=C3D4,ELSET=a\n1,1,2,3,4\n*ELEMENT,TYPE=C3D4,ELSET=b\n2,2,3,4,5\n";
const std::string kAlu = "*MATERIAL,NAME=Alu\n*DENSITY\n2.7\n*ELASTIC\n70,0.3\n";
const std::string kSteel = "*MATERIAL,NAME=Steel\n*DENSITY\n7.85\n*ELASTIC\n210,0.3\n";

Answer abaqus(const std::string& text) { return read(text, MeshFormat::abaqus); }

TEST_CASE("SectionOfAnUnknownMaterial_IsReportedWithBothNames_AndGivesNone") {
  const std::string sections = "*SOLID SECTION,ELSET=a,MATERIAL=STELL\n*SOLID SECTION,ELSET=b,MATERIAL=Alu\n";
  const Answer answer = abaqus(kTets + kAlu + kSteel + sections);
  CHECK(answer.materials == "21: the section of 'a' names the material 'STELL', which the file does not define");
  CHECK(answer.material_faults.at(0).expected == "a material of the file: Alu or Steel");
  CHECK(answer.material_faults.at(0).suggestion == "did you mean 'Steel'?");
  CHECK(answer.mesh.elements[0].material == -1);
  CHECK(answer.mesh.elements[1].material == 0);
  CHECK_FALSE(quality_of(answer.mesh).mass.has_value());
}

TEST_CASE("ElementsWithoutASection_OrWithTwo_AreReported") {
  const std::string of_a = "*SOLID SECTION,ELSET=a,MATERIAL=Alu\n";
  CHECK(abaqus(kTets + kAlu + of_a).materials == "10: 1 element has no material by any section: 2");
  CHECK(abaqus(kTets + kAlu + kSteel).materials == "8: 2 elements have no material by any section: 1, 2");
  const std::string both = "*ELSET,ELSET=c\na,b\n*SOLID SECTION,ELSET=c,MATERIAL=Steel\n";
  CHECK(abaqus(kTets + kAlu + kSteel + of_a + both).materials ==
        "24: element 1 gets the material 'Steel', but has 'Alu' by another section");
  CHECK(abaqus(kTets + kAlu + "*SOLID SECTION,ELSET=d,MATERIAL=Alu\n").materials ==
        "16: a section of the element set 'd', which the file does not define; 8: 2 elements have no material by any "
        "section: 1, 2");
  CHECK(abaqus(kTets + kAlu + "*SOLID SECTION,ELSET=a\n*SOLID SECTION,ELSET=b,MATERIAL=Alu\n").materials ==
        "16: the section of 'a' names no material");
}

TEST_CASE("TheOnlyMaterial_IsTakenWithoutASection_AndThatIsReported") {
  const Answer answer = abaqus(kTets + kAlu);
  CHECK(answer.materials.empty());
  CHECK(answer.warnings == "11: material 'Alu', which no section gives to elements");
  CHECK(answer.mesh.elements[1].material == 0);
}

TEST_CASE("AMeshWithoutMaterials_SaysNothingOfThem") {
  const Answer answer = abaqus(kTets);
  CHECK(answer.materials.empty());
  CHECK(answer.warnings.empty());
}

TEST_CASE("Abaqus_MaterialsThatSayMoreThanIsRead_AreReported") {
  const std::string sections = "*ELSET,ELSET=c\na,b\n*SOLID SECTION,ELSET=c,MATERIAL=Alu\n";
  const auto warnings = [&](const std::string& material) { return abaqus(kTets + material + sections).warnings; };
  CHECK(warnings(kAlu + "*PLASTIC\n1,0\n") == "16: 1 *PLASTIC");
  CHECK(warnings(kAlu + "*EXPANSION\n1e-5\n").empty());
  CHECK(warnings("*MATERIAL,NAME=Alu\n*DENSITY\n2.7\n2.6,,100\n*ELASTIC\n70,0.3,20\n60,0.3,200\n") ==
        "14: a second line of *DENSITY of material 'Alu'; 17: a second line of *ELASTIC of material 'Alu'");
  CHECK(warnings("*MATERIAL,NAME=Alu\n*ELASTIC,TYPE=ENGINEERING CONSTANTS\n1,1,1,.3,.3,.3,1,1\n1\n") ==
        "12: *ELASTIC of type ENGINEERING CONSTANTS");
  CHECK(warnings("*MATERIAL,NAME=Alu\n*ELASTIC,NO COMPRESSION\n70,.3\n") == "12: *ELASTIC with NO COMPRESSION");
  CHECK(abaqus(kTets + kAlu + kAlu).refusal == "16: material 'Alu' is already defined in line 11");
  CHECK(abaqus(kTets + kAlu + "*DENSITY\n3\n").refusal == "16: a second *DENSITY of material 'Alu'");
  CHECK(abaqus(kTets + "*MATERIAL\n").refusal == "11: *MATERIAL without NAME");
  CHECK(abaqus(kTets + "*SOLID SECTION,MATERIAL=a\n").refusal == "11: *SOLIDSECTION without ELSET");
}

TEST_CASE("Abaqus_WhatMovesOrMakesNodes_IsRefused") {
  for (const std::string keyword : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "IMPERFECTION", "ADJUST",
                                    "SYMMETRIC MODEL GENERATION", "MODEL CHANGE"}) {
    CAPTURE(keyword);
    CHECK(abaqus(kTets + "*" + keyword + "\n1,2\n").refusal.starts_with("11: *"));
  }
  CHECK(abaqus("*NODE,SYSTEM=Q\n1,1,90,0\n").refusal == "1: *NODE with SYSTEM=Q");
  CHECK(abaqus("*NODE,INPUT=a.txt\n").refusal == "1: *NODE with INPUT");
  CHECK(abaqus(kTets + "*INSTANCE,NAME=i,PART=p\n*INSTANCE,NAME=j,PART=p\n").refusal == "12: a second *INSTANCE");
  CHECK(abaqus(kTets + "*INSTANCE,NAME=i,PART=p\n1,0,0\n").warnings == "11: an *INSTANCE with a position");
}

TEST_CASE("Abaqus_OneOfSeveralParts_IsReadByItsName") {
  const std::string other = "*NODE\n1,7,0,0\n2,8,0,0\n3,7,1,0\n4,7,0,1\n*ELEMENT,TYPE=C3D4,ELSET=a\n1,1,2,3,4\n";
  const std::string text = "*PART,NAME=First\n" + other + "*END PART\n*PART,NAME=Second\n" + kTets +
                           "*END PART\n*ASSEMBLY\n*INSTANCE,NAME=i,PART=First\n*END INSTANCE\n"
                           "*INSTANCE,NAME=j,PART=second\n*END INSTANCE\n*NSET,NSET=n,INSTANCE=i\n1,2\n"
                           "*NSET,NSET=m,INSTANCE=j\n5\n*ELSET,ELSET=e,INSTANCE=i\n1\n*SURFACE,NAME=s\ne,S1\n"
                           "*TIE,NAME=t\ns,r\n*END ASSEMBLY\n";
  std::vector<Fault> warnings;
  const Mesh mesh = parse_mesh(text, MeshFormat::abaqus, "x", 1, &warnings, {}, nullptr, "SECOND");
  CHECK(mesh.elements.size() == 2);
  CHECK(mesh.node_sets.at("m") == std::vector<int>{4});
  CHECK_FALSE(mesh.node_sets.contains("n"));
  CHECK(mesh.surfaces.empty());
  CHECK(text_of(warnings) == "35: 1 *TIE");
  CHECK(parse_mesh(text, MeshFormat::abaqus, "x", 1, nullptr, {}, nullptr, "first").nodes.at(0).x() == 7);
  CHECK_THROWS_WITH((void)parse_mesh(text, MeshFormat::abaqus, "x", 1, nullptr, {}, nullptr, "Third"),
                    doctest::Contains("a part of the file: First or Second"));
}

TEST_CASE("Abaqus_WhatConnectsOrLoadsTheMesh_IsReportedOrIgnored") {
  CHECK(abaqus(kTets + "*COUPLING,REF NODE=1\n*KINEMATIC\n*COUPLING\n").warnings ==
        "11: 2 *COUPLING; 12: 1 *KINEMATIC");
  CHECK(abaqus(kTets + "*ELEMENT,TYPE=SPRINGA,ELSET=s\n9,1,2\n").warnings == "11: 1 *ELEMENT of type SPRINGA");
  CHECK(abaqus(kTets + "*ELEMNT,TYPE=C3D4\n3,1,2,3,5\n").warnings == "11: 1 *ELEMNT");
  CHECK(abaqus(kTets + "*HEADING\nx\n*TRANSFORM,NSET=a\n1,0,0,0,1,0\n*BOUNDARY\n1,1\n*STEP\n*STATIC\n*CLOAD\n1,1,1\n"
                       "*END STEP\n")
            .warnings.empty());
}

TEST_CASE("Abaqus_ParametersThatWouldBePassedOver_AreRefused") {
  CHECK(abaqus(kTets + "*NSET,NSET=n,GENERTAE\n1,4,1\n").refusal == "11: *NSET with GENERTAE");
  CHECK(abaqus(kTets + "*NSET,NSET=n,ELSET=a\n").refusal == "11: *NSET with ELSET");
  CHECK(abaqus(kTets + "*ELEMENT,TYPE=C3D4,OFFSET=9\n3,1,2,3,5\n").refusal == "11: *ELEMENT with OFFSET");
  CHECK(abaqus("*NODE,\n1,0,0,0\n").refusal == "2: '1' after a keyword's line that ends in a comma");
  CHECK(abaqus(kTets + "*NSET,NSET=n,\nGENERATE\n1,4,1\n").refusal.empty());
}

TEST_CASE("Abaqus_ALastLineWithoutItsEnd_IsReported") {
  CHECK(abaqus(kTets + "*NSET,NSET=n\n1,2,3").warnings == "12: a last line that does not end: '1,2,3'");
  CHECK(abaqus(kTets + "*STEP\n*END STEP").warnings.empty());
  const auto include = [](const std::string&) -> std::string { return "1,0,0,0\n2,1,0"; };
  const Answer answer = read("*INCLUDE,INPUT=a\n" + kTets, MeshFormat::abaqus, include);
  CHECK(answer.refusal == "1: '1,0,0,0'");
}

TEST_CASE("ALabelOfAShell_IsNotThatOfAnother") {
  const std::string shell = "*ELEMENT,TYPE=S3,ELSET=s\n7,1,2,3\n";
  CHECK(abaqus(kTets + shell + shell).refusal.empty());
  CHECK(abaqus(kTets + shell + "*ELEMENT,TYPE=S3,ELSET=t\n7,1,2,4\n").refusal ==
        "14: element 7 is already defined in line 12");
  CHECK(abaqus(kTets + "*ELEMENT,TYPE=S3\n2,1,2,3\n").refusal == "12: element 2 is already defined in line 10");
}

TEST_CASE("CoordinatesAndConstants_BeyondAllMachines_AreRefused") {
  const auto refusal = [](const std::string& text, double unit) {
    try {
      (void)parse_mesh(text, MeshFormat::abaqus, "x", unit);
    } catch (const InputError& error) {
      return text_of(error.faults().at(0));
    }
    return std::string();
  };
  CHECK(refusal("*NODE\n1,0,0,0\n2,1e300,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n", 1) ==
        "3: node 2 at 1e+300 m");
  CHECK(refusal(kTets + "*MATERIAL,NAME=a\n*ELASTIC\n1e308,0.3\n", 1e-3) ==
        "11: material 'a' with constants that overflow");
}

const std::string kGrid = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n";
const std::string kTet = kGrid + "CTETRA,1,1,1,2,3,4\n";  // lines 1 to 5
const std::string kEnd = "ENDDATA\n";

Answer nastran(const std::string& text) { return read(text, MeshFormat::nastran); }

TEST_CASE("Nastran_GridPointsInAnotherSystem_AlsoByGrdset") {
  const std::string system = "CORD2R,5,,100.,0.,0.,100.,0.,1.\n,101.,1.,0.\n";
  const Vector3 origin(100, 0, 0);
  for (const std::string& text : {system + "GRDSET,,5\n" + kTet + kEnd, kTet + "GRDSET,,5\n" + system + kEnd})
    CHECK(nastran(text).mesh.nodes.at(0) == origin);
  CHECK(nastran("GRDSET,,5\n" + kTet + kEnd).refusal == "2: the coordinate system 5, which the file does not define");
  CHECK(nastran(system + "GRDSET,,0,,,,,456\n" + kTet + kEnd).mesh.nodes.at(0) == Vector3(0, 0, 0));
  // A zero of the grid point itself overrides GRDSET.
  std::string in_basic = kTet;
  for (std::size_t at = in_basic.find(",,"); at != std::string::npos; at = in_basic.find(",,"))
    in_basic.insert(at + 1, "0");
  CHECK(nastran("GRDSET,,5\n" + in_basic + kEnd).refusal.empty());
}

TEST_CASE("Nastran_AFileWithoutItsEnd_IsReported") {
  CHECK(nastran(kTet + kEnd).warnings.empty());
  CHECK(nastran(kTet).warnings == "5: no ENDDATA at the end");
  CHECK(nastran("CEND\nBEGIN  BULK\n" + kTet + kEnd).warnings.empty());
  CHECK(nastran(kTet + kEnd + "GRID,1,,9.,9.,9.\n").refusal.empty());
}

TEST_CASE("Nastran_LinesThatDoNotBelongTogether_AreRefused") {
  const std::string nodes =
      "GRID,5,,.5,0.,0.\nGRID,6,,.5,.5,0.\nGRID,7,,0.,.5,0.\nGRID,8,,0.,0.,.5\nGRID,9,,.5,0.,.5\n"
      "GRID,10,,0.,.5,.5\n";
  CHECK(nastran(kGrid + nodes + "CTETRA,1,1,1,2,3,4,5,6,+A\n+A,7,8,9,10\n" + kEnd).refusal.empty());
  CHECK(nastran(kGrid + nodes + "CTETRA,1,1,1,2,3,4,5,6,+A\n+B,7,8,9,10\n" + kEnd).refusal ==
        "12: a continuation that is not the one its entry names (CTETRA)");
  CHECK(nastran(kGrid + nodes + "CTETRA,1,1,1,2,3,4,5,6,7,8,9,10\n" + kEnd).refusal ==
        "11: more fields than a line has (CTETRA)");
  CHECK(nastran("+A,7,8,9,10\n" + kTet + kEnd).refusal == "1: +A");
  CHECK(nastran("=,*1,=,*1.,==\n" + kTet + kEnd).refusal == "1: a replication of no entry (=)");
}

TEST_CASE("Nastran_MaterialsThatAreMissing_OrSayMore_AreReported") {
  const std::string mat = "MAT1,5,210.,,.3,7.8\n";
  CHECK(nastran(kTet + "PSOLID,1,5\n" + mat + kEnd).materials.empty());
  CHECK(nastran(kTet + "PSOLID,1,6\n" + mat + kEnd).materials ==
        "6: the section of 'pid_1' names the material 'mid_6', which the file does not define");
  CHECK(nastran(kTet + "PSOLID,2,5\n" + mat + kEnd).materials == "5: 1 element has no material by any section: 1");
  CHECK(nastran(kTet + "PSOLID,1,5\nPSOLID,1,5\n" + kEnd).refusal == "7: property 1 is already defined in line 6");
  CHECK(nastran(kTet + mat + mat + kEnd).refusal == "7: material 'mid_5' is already defined in line 6");
  CHECK(nastran(kTet + "PSOLID,1,5,,,,,PFLUID\n" + kEnd).refusal == "6: PSOLID of a fluid");
  const auto of_material = [](const std::string& entry) {
    return nastran(kTet + "PSOLID,1,5\n" + entry + kEnd).warnings;
  };
  CHECK(of_material("MAT1,5,210.,100.,.3,7.8\n") == "7: MAT1 with E = 210, G = 100, nu = 0.3");
  CHECK(of_material("MAT1,5,210.,80.7692,.3,7.8\n").empty());
  CHECK(of_material("MAT1,5,210.\n") == "7: MAT1 with one elastic constant");
  CHECK(of_material("MAT1,5,210.,,.3,7.8,,,.02\n") == "7: MAT1 with structural damping GE");
  CHECK(of_material("MAT9,5,210.,1.,1.,1.,1.,1.\n") == "7: MAT9");
  // Only where an element has it.
  const std::string odd = "MAT1,6,210.,,.3,-7.8\nMAT1,7,1.,2.,3.,.1\n";
  CHECK(nastran(kTet + "PSOLID,1,5\n" + mat + odd + kEnd).materials.empty());
  CHECK(nastran(kTet + "PSOLID,1,5\n" + mat + odd + kEnd).mesh.materials.size() == 1);
  CHECK(nastran(kTet + "PSOLID,1,6\n" + mat + odd + kEnd).materials == "8: MAT1 with the density -7.8");
  CHECK(nastran(kTet + "PSOLID,1,7\n" + mat + odd + kEnd).materials == "9: MAT1 with E = 1, nu = 3");
}

TEST_CASE("Nastran_WtmassScalesDensities") {
  const std::string body = kTet + "PSOLID,1,5\nMAT1,5,30.+6,,.3,.283\n" + kEnd;
  const Mesh mesh = nastran("PARAM,WTMASS,.00259\n" + body).mesh;
  CHECK(mesh.materials.at(0).density.value() == 0.283 * 0.00259);
  CHECK(nastran("PARAM,WTMASS,0.\n" + body).refusal == "1: WTMASS = 0");
}

TEST_CASE("Nastran_EntriesThatAreNotRead_AreRefusedReportedOrIgnored") {
  CHECK(nastran(kTet + "CONM2,1,2,,3.\nCTETTRA,2,1,1,2,3,4\nCONM2,2,1,,3.\nCBEAM3,3,1,1,2,3\nCBEND,4,1,1,2\n" + kEnd)
            .warnings == "9: 1 CBEAM3; 10: 1 CBEND; 6: 2 CONM2; 7: 1 CTETTRA");
  CHECK(nastran(kTet + "MPC,1,2,1,1.,3,1,-1.\n" + kEnd).warnings == "6: MPC 1, which no case control section selects");
  CHECK(nastran("CEND\nBEGIN BULK\n" + kTet + "MPC,1,2,1,1.,3,1,-1.\n" + kEnd).warnings ==
        "8: 1 sets of MPC, none of them selected");
  CHECK(nastran("CEND\nMPC = 1\nBEGIN BULK\n" + kTet + "MPC,1,2,1,1.,3,1,-1.\n" + kEnd).mesh.ties.size() == 1);
  CHECK(nastran(kTet + "PLOAD4,1,1,1.\nSPC1,1,123,1\nEIGRL,1\nCORD2R,5\nPARAM,POST,-1\n" + kEnd).warnings.empty());
  for (const std::string entry : {"CTRIAX", "CTETRAR", "GRIDB", "BEGIN SUPER=1", "BEGIN BULK SUPER=1"}) {
    CAPTURE(entry);
    CHECK(nastran(kTet + entry + ",1\n" + kEnd).refusal.starts_with("6: "));
  }
  CHECK(nastran("INCLUDE 'sets.txt'\nBEGIN BULK\n" + kTet + kEnd).warnings == "1: INCLUDE before BEGIN BULK");
}

TEST_CASE("Gmsh_SectionsThatAreNotRead_AreReported_AndPartitionsRefused") {
  const std::string mesh =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
      "$Elements\n1\n1 4 0 1 2 3 4\n$EndElements\n";
  const auto gmsh = [&](const std::string& more) { return read(mesh + more, MeshFormat::gmsh); };
  CHECK(gmsh("$NodeData\n1\n$EndNodeData\n").warnings.empty());
  CHECK(gmsh("$Units\nmm\n$EndUnits\n").warnings == "15: a section $Units");
  CHECK(gmsh("$PartitionedEntities\n$EndPartitionedEntities\n").refusal == "15: $PartitionedEntities");
  CHECK(gmsh("$Elements\n1\n1 4 0 1 2 3 4\n").refusal == "17: ''");
}

TEST_CASE("ElementsOfDifferentOrder_OnOneFace_AreWarnedOf") {
  Mesh mesh = box_mesh(ElementType::tet10, {1, 1, 1}, {1, 1, 1});
  CHECK(quality_of(mesh).mismatched.empty());
  // The last element loses its midside nodes, as where a file is cut within it.
  mesh.elements.back().type = ElementType::tet4;
  const MeshQuality quality = quality_of(mesh);
  REQUIRE_FALSE(quality.mismatched.empty());
  for (const auto& [a, b] : quality.mismatched) CHECK(std::max(a, b) == mesh.elements.back().label);
  const std::vector<Fault> warnings = warnings_of(quality, "x");
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].found.starts_with("elements whose common face has not the same midside nodes: "));
}

}  // namespace mesh_faults_test
}  // namespace hersey::fem
