#include "hersey/fem/reduced_body_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hersey/core/input_error.h"
#include "hersey/core/sealed_file.h"
#include "hersey/core/untrusted_file.h"
#include "reduction/hdf5_file.h"
#include "reduction/mesh_data.h"

namespace hersey::fem {
namespace {

constexpr const char* kFormat = "hersey reduced body 1";
constexpr double kDefinite = 1e-6;   // of the largest eigenvalue: other programs write fewer figures
constexpr double kSymmetric = 1e-9;  // of the largest entry: other programs write fewer figures

std::string frame_path(std::size_t frame_index, const char* what) {
  return fmt::format("frames/{}/{}", frame_index, what);
}

std::vector<double> numbers_of(const Eigen::VectorXd& values) { return {values.data(), values.data() + values.size()}; }

void write_frame(Hdf5File& file, std::size_t frame_index, const InterfaceFrame& frame) {
  file.write_text(frame_path(frame_index, "name"), frame.name);
  file.write_text(frame_path(frame_index, "connection"), frame.connection == Connection::rigid ? "rigid" : "average");
  file.write(frame_path(frame_index, "origin"), numbers_of(frame.origin));
  file.write(frame_path(frame_index, "nodes"), std::vector<long long>(frame.nodes.begin(), frame.nodes.end()));
  if (!frame.weights.empty()) file.write(frame_path(frame_index, "weights"), frame.weights);
}

void write_mass(Hdf5File& file, const Eigen::SparseMatrix<double>& m) {
  std::vector<long long> rows, columns;
  std::vector<double> values;
  rows.reserve(static_cast<std::size_t>(m.nonZeros()));
  columns.reserve(rows.capacity());
  values.reserve(rows.capacity());
  for (Eigen::Index column = 0; column < m.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(m, column); entry; ++entry) {
      rows.push_back(entry.row());
      columns.push_back(entry.col());
      values.push_back(entry.value());
    }
  file.write("mass/rows", rows);
  file.write("mass/columns", columns);
  file.write("mass/values", values);
}

Eigen::MatrixXd positions(const std::vector<Vector3>& nodes) {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(nodes.size()), 3);
  for (std::size_t n = 0; n < nodes.size(); ++n) result.row(static_cast<Eigen::Index>(n)) = nodes[n].transpose();
  return result;
}

void require_content(bool condition, const std::string& what) {
  if (!condition) throw std::runtime_error(what);
}

Eigen::MatrixXd symmetric(const Hdf5File& file, const char* name, Eigen::Index size) {
  Eigen::MatrixXd values = file.read_matrix(name);
  require_content(
      values.rows() == size && values.cols() == size,
      fmt::format("data set '{}' is {} x {}, but Phi has {} columns", name, values.rows(), values.cols(), size));
  require_content(values.allFinite(), fmt::format("data set '{}' has a number that is not finite", name));
  require_content((values - values.transpose()).cwiseAbs().maxCoeff() <= kSymmetric * values.cwiseAbs().maxCoeff(),
                  fmt::format("data set '{}' is not symmetric", name));
  return values;
}

/// No motion has a negative energy: eigenvalues >= 0 but for round-off, of the matrix scaled to a unit diagonal.
void require_no_negative_energy(const Eigen::MatrixXd& values, const char* name) {
  const Eigen::VectorXd diagonal = values.diagonal();
  const double largest = diagonal.maxCoeff();
  require_content(diagonal.minCoeff() >= -kDefinite * largest && largest > 0,
                  fmt::format("data set '{}' has a diagonal that is negative or nothing at all", name));
  const Eigen::VectorXd scale = diagonal.cwiseMax(kDefinite * largest).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * (0.5 * (values + values.transpose())) * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  const bool is_definite = solver.info() == Eigen::Success &&
                           solver.eigenvalues()[0] >= -kDefinite * solver.eigenvalues()[values.rows() - 1];
  require_content(is_definite, fmt::format("data set '{}' gives some motion a negative energy", name));
}

void require_finite(const std::vector<double>& values, const std::string& what) {
  const bool all = std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  require_content(all, fmt::format("{} has a number that is not finite", what));
}

Eigen::SparseMatrix<double> read_mass(const Hdf5File& file, Eigen::Index nodes) {
  const std::vector<long long> rows = file.read_integers("mass/rows"), columns = file.read_integers("mass/columns");
  const std::vector<double> values = file.read_numbers("mass/values");
  require_content(rows.size() == values.size() && columns.size() == values.size(),
                  "data sets 'mass/rows', 'mass/columns' and 'mass/values' differ in length");
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const bool is_inside = rows[k] >= 0 && rows[k] < nodes && columns[k] >= 0 && columns[k] < nodes;
    require_content(is_inside && std::isfinite(values[k]), fmt::format("'mass' has an impossible entry, index {}", k));
    entries.emplace_back(static_cast<int>(rows[k]), static_cast<int>(columns[k]), values[k]);
  }
  Eigen::SparseMatrix<double> m(nodes, nodes);
  m.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double> transposed = m.transpose();
  require_content((m - transposed).norm() <= kSymmetric * m.norm(), "'mass' is not symmetric");
  require_content(m.sum() > 0, "'mass' adds up to nothing");
  return m;
}

InterfaceFrame read_frame(const Hdf5File& file, std::size_t frame_index, std::size_t nodes) {
  InterfaceFrame frame;
  frame.name = file.read_text(frame_path(frame_index, "name"));
  const std::string connection = file.read_text(frame_path(frame_index, "connection"));
  require_content(
      connection == "rigid" || connection == "average",
      fmt::format("frame '{}' has the connection '{}': rigid or average is allowed", frame.name, connection));
  frame.connection = connection == "rigid" ? Connection::rigid : Connection::average;
  const std::vector<double> origin = file.read_numbers(frame_path(frame_index, "origin"));
  require_content(origin.size() == 3, fmt::format("the origin of frame '{}' has no three numbers", frame.name));
  require_finite(origin, fmt::format("the origin of frame '{}'", frame.name));
  frame.origin = Vector3(origin[0], origin[1], origin[2]);
  for (const long long node : file.read_integers(frame_path(frame_index, "nodes"))) {
    require_content(node >= 0 && static_cast<std::size_t>(node) < nodes,
                    fmt::format("frame '{}' has node {}, but there are {}, counted from 0", frame.name, node, nodes));
    frame.nodes.push_back(static_cast<int>(node));
  }
  if (file.has(frame_path(frame_index, "weights")))
    frame.weights = file.read_numbers(frame_path(frame_index, "weights"));
  require_content(
      frame.weights.empty() || frame.weights.size() == frame.nodes.size(),
      fmt::format("frame '{}' has {} weights for {} nodes", frame.name, frame.weights.size(), frame.nodes.size()));
  require_finite(frame.weights, fmt::format("a weight of frame '{}'", frame.name));
  return frame;
}

Eigen::VectorXd read_vector(const Hdf5File& file, const char* name) {
  const std::vector<double> values = file.read_numbers(name);
  require_finite(values, fmt::format("data set '{}'", name));
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

ReducedBody read_body(const Hdf5File& file) {
  require_content(file.has("format") && file.read_text("format") == kFormat,
                  fmt::format("data set 'format' is not '{}'", kFormat));
  ReducedBody body;
  const Eigen::MatrixXd nodes = file.read_matrix("nodes");
  require_content(nodes.cols() == 3 && nodes.rows() > 0 && nodes.allFinite(),
                  "data set 'nodes' is not (nodes, 3) finite numbers");
  for (Eigen::Index n = 0; n < nodes.rows(); ++n) body.nodes.emplace_back(nodes.row(n).transpose());
  body.Phi = file.read_matrix("Phi");
  require_content(
      body.Phi.rows() == 3 * nodes.rows() && body.Phi.cols() > 0 && body.Phi.allFinite(),
      fmt::format("data set 'Phi' is not {} rows of finite numbers, three for each node", 3 * nodes.rows()));
  body.K = symmetric(file, "K", body.size());
  body.M = symmetric(file, "M", body.size());
  require_no_negative_energy(body.M, "M");
  body.m = read_mass(file, nodes.rows());
  for (std::size_t f = 0; file.has(fmt::format("frames/{}", f)); ++f)
    body.frames.push_back(read_frame(file, f, body.nodes.size()));
  require_content(body.internal_first() <= body.size(),
                  fmt::format("{} frames need {} columns of Phi, which has {}", body.frames.size(),
                              body.internal_first(), body.size()));
  // With all frames fixed: rigid motions store no energy except round-off, which may be negative.
  const Eigen::Index internal = body.size() - body.internal_first();
  if (internal > 0) require_no_negative_energy(body.K.bottomRightCorner(internal, internal), "K");
  body.internal_omega = read_vector(file, "internal_omega");
  require_content(body.internal_omega.size() == body.size() - body.internal_first(),
                  fmt::format("data set 'internal_omega' has {} numbers for {} internal coordinates",
                              body.internal_omega.size(), body.size() - body.internal_first()));
  require_content(body.internal_omega.size() == 0 || body.internal_omega.minCoeff() > 0,
                  "data set 'internal_omega' has a frequency that is not > 0");
  if (file.has("energy_missed")) body.energy_missed = read_vector(file, "energy_missed");
  read_mesh_data(file, body);
  return body;
}

}  // namespace

void write_reduced_body(const std::filesystem::path& path, const ReducedBody& body) {
  std::filesystem::path unfinished = path;
  unfinished += ".new";
  try {
    {
      Hdf5File file = Hdf5File::create(unfinished);
      file.write_text("format", kFormat);
      file.write("nodes", positions(body.nodes));
      file.write("Phi", body.Phi);
      file.write("K", body.K);
      file.write("M", body.M);
      write_mass(file, body.m);
      for (std::size_t f = 0; f < body.frames.size(); ++f) write_frame(file, f, body.frames[f]);
      file.write("internal_omega", numbers_of(body.internal_omega));
      file.write("energy_missed", numbers_of(body.energy_missed));
      write_mesh_data(file, body);
    }
    seal_file(unfinished);
    std::filesystem::rename(unfinished, path);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

ReducedBody read_reduced_body(const std::filesystem::path& path) {
  try {
    // Checked before HDF5 reads the file: the library trusts a file's structure.
    const Seal seal = check_seal(path);
    require_content(seal != Seal::broken, "has changed since it was written: its checksum is another");
    const UntrustedFile doubtful(seal == Seal::intact ? nullptr : path.c_str());
    return read_body(Hdf5File::open(path));
  } catch (const std::runtime_error& error) {
    throw InputError(
        Fault{{path.string(), 0, 0}, "", error.what(), "a reduced body", "docs/reduced-body-file.md has its format"});
  }
}

}  // namespace hersey::fem
