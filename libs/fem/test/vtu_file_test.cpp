#include "hersey/fem/vtu_file.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>

#include "hersey/core/contract.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/mesh_file.h"
#include "seeded_random.h"
#include "source_dir.h"
#include "temporary_directory.h"

namespace hersey::fem {
namespace vtu_file_test {

Mesh block() {
  return read_mesh(std::filesystem::path(hersey::source_dir()) / "libs/fem/test/data/block_22.msh", 1e-3);
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The values of an appended array, by its name.
template <typename T>
std::vector<T> array_of(const std::string& content, const std::string& name) {
  const std::size_t header = content.find("Name=\"" + name + "\"");
  REQUIRE(header != std::string::npos);
  const std::size_t offset_at = content.find("offset=\"", header) + 8;
  const std::size_t data = content.find('_', content.find("<AppendedData encoding=\"raw\">")) + 1;
  const std::size_t offset = data + std::stoul(content.substr(offset_at));
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, content.data() + offset, sizeof bytes);
  std::vector<T> values(bytes / sizeof(T));
  std::memcpy(values.data(), content.data() + offset + sizeof bytes, bytes);
  return values;
}

TEST_CASE("Vtu_HoldsTheMeshAndItsFields_BitForBit") {
  const TemporaryDirectory folder;
  const Mesh mesh = block();
  VtuFrame frame;
  frame.node_fields.push_back({"displacement", seeded_random(3, 72, 1)});
  frame.node_fields.push_back({"stress <MPa>", seeded_random(6, 72, 2)});
  frame.element_fields.push_back({"energy", seeded_random(1, 12, 3)});
  write_vtu(folder / "block.vtu", mesh, frame);
  const std::string content = content_of(folder / "block.vtu");
  const std::vector<double> points = array_of<double>(content, "Points");
  REQUIRE(points.size() == 3 * mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    for (std::size_t i = 0; i < 3; ++i) CHECK(points[3 * n + i] == mesh.nodes[n][static_cast<Eigen::Index>(i)]);
  const std::vector<double> stress = array_of<double>(content, "stress &lt;MPa&gt;");
  CHECK(Eigen::Map<const Eigen::MatrixXd>(stress.data(), 6, 72) == frame.node_fields[1].values);
  CHECK(content.find(R"(ComponentName0="xx" ComponentName1="yy" ComponentName2="zz" ComponentName3="xy" )"
                     R"(ComponentName4="yz" ComponentName5="xz")") != std::string::npos);
  const std::vector<double> energy = array_of<double>(content, "energy");
  CHECK(Eigen::Map<const Eigen::MatrixXd>(energy.data(), 1, 12) == frame.element_fields[0].values);
  const std::vector<std::int64_t> connectivity = array_of<std::int64_t>(content, "connectivity");
  CHECK(std::equal(connectivity.begin(), connectivity.end(), mesh.connectivity.begin(), mesh.connectivity.end()));
  CHECK(array_of<std::int64_t>(content, "node")[71] == mesh.node_labels[71]);
  CHECK(array_of<std::int64_t>(content, "element")[11] == mesh.elements[11].label);
}

TEST_CASE("Vtu_OfAMovedBody_HasThePositionsGiven") {
  const TemporaryDirectory folder;
  const Mesh mesh = box_mesh(ElementType::hex8, {1, 1, 1}, {1, 1, 1});
  VtuFrame frame;
  frame.positions = Eigen::Matrix3Xd::Constant(3, 8, 2.5);
  write_vtu(folder / "box.vtu", mesh, frame);
  CHECK(array_of<double>(content_of(folder / "box.vtu"), "Points") == std::vector<double>(24, 2.5));
  frame.positions.resize(3, 7);
  CHECK_THROWS_AS(write_vtu(folder / "box.vtu", mesh, frame), ContractError);
}

TEST_CASE("Vtu_ThatCannotBeWritten_IsReportedByItsName") {
  CHECK_THROWS_WITH_AS(write_vtu("/no/such/folder/a.vtu", block(), {}),
                       "/no/such/folder/a.vtu: cannot be written: No such file or directory", std::runtime_error);
}

/// What a command prints; empty if it cannot be run.
std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  for (int c = 0; pipe && (c = std::fgetc(pipe.get())) != EOF;) text += static_cast<char>(c);
  return text;
}

TEST_CASE("PvdSeries_IsReadBackByAnotherProgram") {
  if (!std::filesystem::exists("/usr/bin/python3")) return;
  const TemporaryDirectory folder;
  const Mesh mesh = block();
  VtuSeries series(folder / "run.pvd");
  for (const double time : {0.0, 0.25}) {
    VtuFrame frame;
    frame.node_fields.push_back({"displacement", Eigen::MatrixXd::Constant(3, 72, time)});
    series.add(time, mesh, frame);
  }
  const std::string script = std::string(hersey::source_dir()) + "/libs/fem/test/read_vtu.py";
  CHECK(output_of("/usr/bin/python3 '" + script + "' '" + (folder / "run.pvd").string() + "'") ==
        "t=0.0 points=72 cells=12 types=24,25,26, displacement=3x72 sum=0.0;"
        "t=0.25 points=72 cells=12 types=24,25,26, displacement=3x72 sum=54.0;");
}

}  // namespace vtu_file_test
}  // namespace hersey::fem
