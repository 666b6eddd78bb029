#include "hersey/fem/reduced_body_file.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "hersey/core/input_error.h"
#include "hersey/fem/imported_body.h"
#include "hersey/fem/matrix_market.h"
#include "reduction/hdf5_file.h"
#include "temporary_directory.h"

namespace hersey::fem {
namespace reduced_body_file_test {

constexpr double kSums = 1e-13;  // round-off of sums over the mesh

ElasticBody box_body() {
  const SolidMaterial steel = isotropic({.youngs_modulus = 2.1e11, .poisson_ratio = 0.3, .density = 7850});
  return assemble(box_mesh(ElementType::hex8, {0.4, 0.1, 0.1}, {4, 1, 1}), {steel});
}

ReducedBody reduced() {
  const ElasticBody body = box_body();
  const std::vector<InterfaceFrame> frames = {
      {"left", {0, 0.05, 0.05}, body.mesh.node_sets.at("x0"), Connection::rigid, {}},
      {"right", {0.4, 0.05, 0.05}, body.mesh.node_sets.at("x1"), Connection::average, {0.1, 0.2, 0.3, 0.4}}};
  Reduction reduction = reduce(body, frames, {.modes = 5});
  REQUIRE(reduction.solved());
  return reduction.body;
}

TEST_CASE("ReducedBody_IsReadBackBitForBit") {
  const TemporaryDirectory folder;
  const ReducedBody body = reduced();
  write_reduced_body(folder / "rod.h5", body);
  const ReducedBody back = read_reduced_body(folder / "rod.h5");
  CHECK(back.Phi == body.Phi);
  CHECK(back.K == body.K);
  CHECK(back.M == body.M);
  CHECK(back.nodes == body.nodes);
  CHECK((back.m - body.m).norm() == 0);
  CHECK(back.internal_omega == body.internal_omega);
  CHECK(back.energy_missed == body.energy_missed);
  REQUIRE(back.frames.size() == 2);
  for (std::size_t f = 0; f < 2; ++f) {
    CHECK(back.frames[f].name == body.frames[f].name);
    CHECK(back.frames[f].origin == body.frames[f].origin);
    CHECK(back.frames[f].nodes == body.frames[f].nodes);
    CHECK(back.frames[f].connection == body.frames[f].connection);
    CHECK(back.frames[f].weights == body.frames[f].weights);
  }
  CHECK_FALSE(std::filesystem::exists(folder / "rod.h5.new"));
}

TEST_CASE("ReducedBody_KeepsItsMesh") {
  const TemporaryDirectory folder;
  const ReducedBody body = reduced();
  write_reduced_body(folder / "rod.h5", body);
  const ReducedBody back = read_reduced_body(folder / "rod.h5");
  CHECK(back.mesh.nodes == body.mesh.nodes);
  CHECK(back.mesh.node_labels == body.mesh.node_labels);
  CHECK(back.mesh.connectivity == body.mesh.connectivity);
  CHECK(back.mesh.node_sets == body.mesh.node_sets);
  REQUIRE(back.mesh.elements.size() == 4);
  CHECK(back.mesh.elements[3].type == ElementType::hex8);
  CHECK(back.mesh.elements[3].first == body.mesh.elements[3].first);
  CHECK(back.mesh.elements[3].label == body.mesh.elements[3].label);
  REQUIRE(back.mesh.surfaces.size() == body.mesh.surfaces.size());
  CHECK(back.mesh.surfaces.at("x1")[0].element == 3);
  CHECK(back.mesh.surfaces.at("x1")[0].face == body.mesh.surfaces.at("x1")[0].face);
  REQUIRE(back.materials.size() == 1);
  CHECK(back.materials[0].D == body.materials[0].D);
  CHECK(back.materials[0].density == 7850);
}

TEST_CASE("ReducedBodyOfAnotherProgram_NeedsNoElements") {
  const TemporaryDirectory folder;
  ReducedBody body = reduced();
  body.mesh = {};
  write_reduced_body(folder / "rod.h5", body);
  const ReducedBody back = read_reduced_body(folder / "rod.h5");
  CHECK(back.mesh.elements.empty());
  CHECK(back.mesh.nodes == body.nodes);
}

/// What is said of a file that another program wrote wrong.
template <typename Spoil>
std::string fault_after(const Spoil& spoil) {
  const TemporaryDirectory folder;
  ReducedBody body = reduced();
  spoil(body);
  write_reduced_body(folder / "rod.h5", body);
  try {
    (void)read_reduced_body(folder / "rod.h5");
  } catch (const InputError& error) {
    return error.faults().at(0).found;
  }
  return "no fault";
}

TEST_CASE("SpoiledReducedBodies_AreReportedByTheirDataSet") {
  CHECK(fault_after([](ReducedBody&) {}) == "no fault");
  CHECK(fault_after([](ReducedBody& b) { b.K(0, 1) += 1e9; }) == "data set 'K' is not symmetric");
  CHECK(fault_after([](ReducedBody& b) { b.M(3, 3) = std::nan(""); }) ==
        "data set 'M' has a number that is not finite");
  CHECK(fault_after([](ReducedBody& b) { b.Phi.conservativeResize(b.Phi.rows() - 1, Eigen::NoChange); }) ==
        "data set 'Phi' is not 60 rows of finite numbers, three for each node");
  CHECK(fault_after([](ReducedBody& b) { b.M.conservativeResize(4, 4); }) ==
        "data set 'M' is 4 x 4, but Phi has 17 columns");
  CHECK(fault_after([](ReducedBody& b) { b.frames[0].nodes[0] = 20; }) ==
        "frame 'left' has node 20, but there are 20, counted from 0");
  CHECK(fault_after([](ReducedBody& b) { b.frames[1].weights.pop_back(); }) ==
        "frame 'right' has 3 weights for 4 nodes");
  CHECK(fault_after([](ReducedBody& b) { b.internal_omega.conservativeResize(2); }) ==
        "data set 'internal_omega' has 2 numbers for 5 internal coordinates");
  CHECK(fault_after([](ReducedBody& b) { b.mesh.connectivity[2] = 20; }) ==
        "data set 'mesh/connectivity' has 20, not from 0 to 19");
  CHECK(fault_after([](ReducedBody& b) { b.mesh.connectivity.pop_back(); }) ==
        "data set 'mesh/connectivity' has 31 nodes for elements of 32");
  CHECK(fault_after([](ReducedBody& b) { b.mesh.surfaces["x0"][0].face = 6; }) ==
        "data set 'mesh/surfaces/0/faces' has 6, not from 0 to 5");
  CHECK(fault_after([](ReducedBody& b) { b.mesh.elements[1].material = 1; }) ==
        "element 2 has a material that is not in 'materials'");
  CHECK(fault_after([](ReducedBody& b) { b.m *= 0.0; }) == "'mass' adds up to nothing");
  CHECK(fault_after([](ReducedBody& b) { b.M(14, 14) *= -1; }) ==
        "data set 'M' has a diagonal that is negative or nothing at all");
  CHECK(fault_after([](ReducedBody& b) { b.M(0, 14) = b.M(14, 0) = 2 * std::sqrt(b.M(0, 0) * b.M(14, 14)); }) ==
        "data set 'M' gives some motion a negative energy");
  CHECK(fault_after([](ReducedBody& b) { b.K(12, 13) = b.K(13, 12) = 2 * std::sqrt(b.K(12, 12) * b.K(13, 13)); }) ==
        "data set 'K' gives some motion a negative energy");
  CHECK(fault_after([](ReducedBody& b) { b.frames[0].origin.x() = std::nan(""); }) ==
        "the origin of frame 'left' has a number that is not finite");
  CHECK(fault_after([](ReducedBody& b) { b.internal_omega[0] = -1; }) ==
        "data set 'internal_omega' has a frequency that is not > 0");
  CHECK(fault_after([](ReducedBody& b) { b.materials[0].density = std::nan(""); }) ==
        "data set 'materials/density' has a density that is negative or not finite");
}

TEST_CASE("ReducedBodyWithOneFrame_IsReadBack_ThoughItsRigidMotionsStoreRoundOff") {
  const TemporaryDirectory folder;
  const ElasticBody body = box_body();
  for (const int modes : {0, 3}) {
    const Reduction reduction = reduce(
        body, {{"left", {0, 0.05, 0.05}, body.mesh.node_sets.at("x0"), Connection::rigid, {}}}, {.modes = modes});
    REQUIRE(reduction.solved());
    write_reduced_body(folder / "rod.h5", reduction.body);
    CHECK(read_reduced_body(folder / "rod.h5").K == reduction.body.K);
  }
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_CASE("ABitThatFlipsInAReducedBody_IsReportedOrHarmless") {
  const TemporaryDirectory folder;
  const ReducedBody body = reduced();
  write_reduced_body(folder / "rod.h5", body);
  const std::string good = bytes_of(folder / "rod.h5");
  int reported = 0, tried = 0;
  for (std::size_t bit = 5; bit < 8 * good.size(); bit += 997, ++tried) {
    std::string flipped = good;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    std::ofstream(folder / "flipped.h5", std::ios::binary) << flipped;
    try {
      const ReducedBody back = read_reduced_body(folder / "flipped.h5");
      CHECK(back.K == body.K);  // the bit is one of the seal
      CHECK(back.Phi == body.Phi);
    } catch (const InputError& error) {
      CHECK(error.faults().at(0).found == "has changed since it was written: its checksum is another");
      ++reported;
    }
  }
  CHECK(reported >= tried - 1);  // the seal is 46 bytes, less than a step
}

TEST_CASE("FilesThatAreNoReducedBody_AreReported") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "text.h5") << "no HDF5";
  CHECK_THROWS_AS((void)read_reduced_body(folder / "text.h5"), InputError);
  CHECK_THROWS_AS((void)read_reduced_body(folder / "missing.h5"), InputError);
  {
    Hdf5File file = Hdf5File::create(folder / "other.h5");
    file.write("nodes", Eigen::MatrixXd::Zero(2, 3));
  }
  CHECK_THROWS_AS((void)read_reduced_body(folder / "other.h5"), InputError);
  CHECK_THROWS_AS(write_reduced_body("/no/such/folder/rod.h5", reduced()), std::runtime_error);
}

void write_matrix(const std::filesystem::path& path, const Eigen::SparseMatrix<double>& matrix) {
  std::ofstream file(path);
  file.precision(17);
  file << "%%MatrixMarket matrix coordinate real symmetric\n% lower triangle\n"
       << matrix.rows() << " " << matrix.cols() << " "
       << Eigen::SparseMatrix<double>(matrix.triangularView<Eigen::Lower>()).nonZeros() << "\n";
  for (Eigen::Index c = 0; c < matrix.outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, c); entry; ++entry)
      if (entry.row() >= entry.col()) file << entry.row() + 1 << " " << entry.col() + 1 << " " << entry.value() << "\n";
}

Eigen::SparseMatrix<double> full_mass(const Eigen::SparseMatrix<double>& m) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index c = 0; c < m.outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(m, c); entry; ++entry)
      for (int i = 0; i < 3; ++i)
        entries.emplace_back(static_cast<int>(3 * entry.row()) + i, static_cast<int>(3 * c) + i, entry.value());
  Eigen::SparseMatrix<double> M(3 * m.rows(), 3 * m.cols());
  M.setFromTriplets(entries.begin(), entries.end());
  return M;
}

TEST_CASE("MatricesOfAnotherProgram_GiveTheSameBody") {
  const TemporaryDirectory folder;
  const ElasticBody body = box_body();
  write_matrix(folder / "K.mtx", body.K);
  write_matrix(folder / "M.mtx", full_mass(body.m));
  const ElasticBody back =
      import_body(body.mesh, read_matrix_market(folder / "K.mtx"), read_matrix_market(folder / "M.mtx"), "K.mtx");
  // 17 figures in the file; the mass is averaged over three directions.
  // 17 figures, and the mean of three.
  CHECK((back.K - body.K).norm() <= 1e-15 * body.K.norm());
  CHECK((back.m - body.m).norm() <= 1e-15 * body.m.norm());
  CHECK(back.mass == doctest::Approx(0.4 * 0.1 * 0.1 * 7850).epsilon(kSums));
  CHECK((back.inertia - body.inertia).norm() <= kSums * body.inertia.norm());
  CHECK((import_body(body.mesh, body.K, body.m, "m").m - body.m).norm() == 0);
}

std::string import_fault(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& M) {
  try {
    (void)import_body(box_body().mesh, K, M, "K.mtx");
  } catch (const InputError& error) {
    return error.faults().at(0).found;
  }
  return "no fault";
}

TEST_CASE("MatricesThatAreNoFreeBody_AreReported") {
  const ElasticBody body = box_body();
  const Eigen::SparseMatrix<double> M = full_mass(body.m);
  CHECK(import_fault(body.K, M) == "no fault");
  Eigen::SparseMatrix<double> fixed = body.K;
  fixed.coeffRef(0, 0) += body.K.coeff(0, 0);
  CHECK(import_fault(fixed, M) == "a stiffness that resists turning about y rigidly");
  Eigen::SparseMatrix<double> uneven = body.K;
  uneven.coeffRef(0, 1) += body.K.coeff(0, 0);
  CHECK(import_fault(uneven, M) == "a stiffness matrix that is not symmetric");
  CHECK(import_fault(body.m, M) == "a stiffness matrix of 20 x 20");
  Eigen::SparseMatrix<double> heavy = M;
  heavy.coeffRef(0, 0) *= 2;
  CHECK(import_fault(body.K, heavy) == "a mass matrix that differs between x, y and z");
  CHECK(import_fault(body.K, 0.0 * M) == "a mass that adds up to nothing");
}

TEST_CASE("MatrixMarket_ReadsEveryKindOfRealMatrix") {
  const auto read = [](const std::string& text) { return Eigen::MatrixXd(parse_matrix_market(text, "x.mtx")); };
  Eigen::MatrixXd expected(2, 2);
  expected << 1, 2, 2, 4;
  CHECK(read("%%MatrixMarket matrix coordinate real general\n% c\n\n2 2 4\n1 1 1\n1 2 2\n2 1 2\n2 2 4.0\n") ==
        expected);
  CHECK(read("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n2 1 2\n2 2 4e0\n") == expected);
  CHECK(read("%%MatrixMarket matrix array real general\n2 2\n1\n2\n2\n4\n") == expected);
  CHECK(read("%%MatrixMarket matrix array integer symmetric\n2 2\n1\n2\n4\n") == expected);
  expected << 0, -2, 2, 0;
  CHECK(read("%%MatrixMarket matrix coordinate real skew-symmetric\n2 2 1\n2 1 2\n") == expected);
  const auto line_of_fault = [](const std::string& text) {
    try {
      (void)parse_matrix_market(text, "x.mtx");
    } catch (const InputError& error) {
      return error.faults().at(0).position.line;
    }
    return 0;
  };
  CHECK(line_of_fault("%%MatrixMarket matrix coordinate complex general\n") == 1);
  CHECK(line_of_fault("%%MatrixMarket matrix coordinate real general\n2 2 1\n3 1 5\n") == 3);
  CHECK(line_of_fault("%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 5\n") == 3);
  CHECK(line_of_fault("%%MatrixMarket matrix coordinate real general\n2 2 1\n1 1 inf\n") == 3);
  CHECK(line_of_fault("%%MatrixMarket matrix coordinate real symmetric\n2 3 1\n") == 2);
}

}  // namespace reduced_body_file_test
}  // namespace hersey::fem
