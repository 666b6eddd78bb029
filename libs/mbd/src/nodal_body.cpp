#include "hersey/mbd/nodal_body.h"

#include <utility>

#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "modal_workspace.h"
#include "nodal_factors.h"

namespace hersey::mbd {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSolves = 2;           // most solutions per evaluation
constexpr int kSolvesAtRest = 30;    // the same of a body of finite strain in statics
constexpr double kBalanced = 1e-12;  // of the forces on the nodes: no further solution

// As in inertia.cpp: the share of the force that would stop a body within the step.
constexpr double kMomentumShare = 1e-4;

// The share of the forces on all nodes, taken as positive, that counts as a magnitude of their sums: balances of frames
// that see little of these forces still have their round-off.
constexpr double kNodalShare = 1e-4;

// Columns of (flexible-bodies.18).
constexpr Index kTurning = 3, kShapes = 12;

Eigen::Map<const Matrix3Xd> nodes_of(const VectorXd& u) { return {u.data(), 3, u.size() / 3}; }

VectorXd flat(const Matrix3Xd& field) { return Eigen::Map<const VectorXd>(field.data(), field.size()); }

/// The same body with the static shapes alone: those of its frames, and those of the films on its surfaces.
ModalBodyData static_data(const fem::ElasticBody& body, const fem::ReducedBody& reduced,
                          const RayleighDamping& damping) {
  fem::ReducedBody still = reduced;
  const Index n = reduced.internal_first();
  Index size = n;
  for (const fem::FilmModes& film : reduced.film_modes) size += film.shapes.cols();
  still.Phi.resize(reduced.Phi.rows(), size);
  still.Phi.leftCols(n) = reduced.Phi.leftCols(n);
  still.K = MatrixXd::Zero(size, size);
  still.K.topLeftCorner(n, n) = reduced.K.topLeftCorner(n, n);
  Index at = n;
  for (const fem::FilmModes& film : reduced.film_modes) {
    still.Phi.middleCols(at, film.shapes.cols()) = film.shapes;
    at += film.shapes.cols();
  }
  // Frames at rest bear no work of the films' shapes, so that these strain the body independently of the frames'.
  const MatrixXd films = still.Phi.rightCols(size - n);
  const MatrixXd K = films.transpose() * (body.K * films);
  still.K.bottomRightCorner(size - n, size - n) = 0.5 * (K + K.transpose());
  still.M = still.Phi.transpose() * fem::mass_times(body.m, still.Phi);
  still.internal_omega.resize(0);
  return modal_data(still, damping);
}

/// What keeps the nodes' own displacements apart from the static shapes: they move no frame, and the pressures that
/// the films' shapes answer do no work on them.
fem::FrameSupports supports_of(const fem::ElasticBody& body, const fem::ReducedBody& reduced) {
  fem::FrameSupports supports = fem::frame_supports(body.mesh, reduced.frames);
  std::vector<Eigen::Triplet<double>> entries;
  const Eigen::SparseMatrix<double>& C = supports.C;
  for (Index j = 0; j < C.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(C, j); entry; ++entry)
      entries.emplace_back(static_cast<int>(entry.row()), static_cast<int>(j), entry.value());
  Index row = C.rows();
  for (const fem::FilmModes& film : reduced.film_modes) {
    for (Index k = 0; k < film.loads.cols(); ++k, ++row) {
      const double largest = film.loads.col(k).cwiseAbs().maxCoeff();
      for (Index i = 0; i < film.loads.rows(); ++i)
        if (film.loads(i, k) != 0)
          entries.emplace_back(static_cast<int>(row), static_cast<int>(i), film.loads(i, k) / largest);
    }
  }
  supports.C.resize(row, body.size());
  supports.C.setFromTriplets(entries.begin(), entries.end());
  return supports;
}

}  // namespace

/// Where the nodes are and how they move against the body's axes, and their accelerations in space, in these axes.
struct NodalBody::Fields {
  Matrix3Xd y, y_rate, y_acc, acceleration;
};

NodalBody::NodalBody(fem::ElasticBody body, const fem::ReducedBody& reduced, const RayleighDamping& damping,
                     Strain strain)
    : ModalBody(static_data(body, reduced, damping)),
      body_(std::move(body)),
      damping_(damping),
      strain_(strain),
      fields_(std::make_unique<Fields>()) {
  HERSEY_REQUIRE(strain == Strain::small || reduced.frames.size() == 1, "finite strains go with one frame");
  HERSEY_REQUIRE(static_cast<std::size_t>(body_.node_count()) == reduced.nodes.size(), "both of one mesh");
  x_.resize(3, body_.node_count());
  for (Index i = 0; i < x_.cols(); ++i) x_.col(i) = reduced.nodes[static_cast<std::size_t>(i)];
  nodal_mass_ = Eigen::RowVectorXd::Ones(x_.cols()) * body_.m;
  const Index shapes = data().shapes();
  frame_shapes_ = reduced.internal_first() - 6;
  Psi_size_ = Psi().cwiseAbs();
  vibrations_ = reduced.Phi.rightCols(reduced.size() - reduced.internal_first());
  for (Index a = 0; a < vibrations_.cols(); ++a) {
    const VectorXd shape = vibrations_.col(a);
    vibrations_.col(a) /= nodes_of(shape).colwise().norm().maxCoeff();
  }
  vibration_mass_ = vibrations_.cwiseProduct(fem::mass_times(body_.m, vibrations_)).colwise().sum();

  inertia_ = MatrixXd::Zero(body_.size(), kShapes + shapes);
  const Matrix3Xd moments = x_ * body_.m;
  for (Index k = 0; k < 3; ++k) {
    for (Index i = 0; i < x_.cols(); ++i) inertia_(3 * i + k, k) = nodal_mass_[i];
    for (Index p = 0; p < 3; ++p)
      for (Index i = 0; i < x_.cols(); ++i) inertia_(3 * i + k, kTurning + 3 * p + k) = moments(p, i);
  }
  inertia_.rightCols(shapes) = fem::mass_times(body_.m, Psi());

  factors_ = std::make_unique<NodalFactors>(body_, supports_of(body_, reduced), damping_, inertia_, Psi());
  w_.start(VectorXd::Zero(body_.size()));
  sizes_ = VectorXd::Zero(body_.size());
}

NodalBody::~NodalBody() = default;

long NodalBody::solves() const { return factors_->solves(); }

void NodalBody::add_load(const NodalLoad& load) {
  ModalBody::add_load(load);
  loads_.push_back(load);
}

/// All loads at their present values, in the body's axes.
Matrix3Xd NodalBody::loads_on_nodes(const ElasticMotion& motion) const {
  Matrix3Xd sum = Matrix3Xd::Zero(3, x_.cols());
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    const double value = motion.loads[static_cast<Index>(i)];
    if (loads_[i].axes == LoadAxes::body)
      sum += value * loads_[i].forces;
    else
      sum += motion.frames[0].X_WF.R.transpose() * (value * loads_[i].forces);
  }
  return sum;
}

void NodalBody::update_fields() {
  const Workspace& w = work();
  const Index n = data().shapes();
  fields_->y = x_ + nodes_of(Psi() * w.q.tail(n) + w_.position());
  fields_->y_rate = nodes_of(Psi() * w.rate.tail(n) + w_.rate());
  fields_->y_acc = nodes_of(Psi() * w.acceleration.tail(n) + w_.acceleration());
}

/// Theory manual eq. (flexible-bodies.3) at each node.
void NodalBody::update_accelerations(const ElasticFrame& base) {
  const Vector3 omega = base.V.head<3>();
  const Matrix3 omega_x = skew(omega), Omega = skew(Vector3(base.A.head<3>())) + omega_x * omega_x;
  const Vector3 a = base.A.tail<3>() + omega.cross(base.V.tail<3>());
  fields_->acceleration = ((Omega * fields_->y + 2 * omega_x * fields_->y_rate + fields_->y_acc).colwise() + a).eval();
}

/// Sums over nodes in place of those over shapes, theory manual eq. (flexible-bodies.5).
void NodalBody::gather(const ElasticMotion& motion, bool want_tangent) {
  ModalBody::gather(motion, want_tangent);
  update_fields();
  Workspace& w = work();
  const Matrix3Xd &y = fields_->y, &y_rate = fields_->y_rate, &y_acc = fields_->y_acc;
  w.S = y * nodal_mass_.transpose();
  w.S_rate = y_rate * nodal_mass_.transpose();
  w.S_acc = y_acc * nodal_mass_.transpose();
  const Matrix3Xd m_y = y * body_.m;
  w.Gamma = m_y * y.transpose();
  w.Gamma_rate = m_y * y_rate.transpose();
  w.Gamma_acc = m_y * y_acc.transpose();
  for (Index a = 1; a <= data().shapes(); ++a) {
    const Eigen::Map<const Matrix3Xd> m_shape(inertia_.col(kShapes + a - 1).data(), 3, x_.cols());
    const auto at = static_cast<std::size_t>(a);
    w.H[at] = m_shape * y.transpose();
    w.H_rate[at] = m_shape * y_rate.transpose();
    w.H_acc[at] = m_shape * y_acc.transpose();
    for (std::size_t i = 0; i < 9; ++i) {
      const auto row = static_cast<Index>(i / 3), column = static_cast<Index>(i % 3);
      w.h[i][a] = w.H[at](row, column);
      w.h_rate[i][a] = w.H_rate[at](row, column);
      w.h_acc[i][a] = w.H_acc[at](row, column);
    }
  }
}

/// Of the material on the nodes, theory manual eq. (flexible-bodies.16) or (flexible-bodies.24).
VectorXd NodalBody::elastic_forces() {
  if (strain_ == Strain::small) return body_.K * (w_.position() + damping_.stiffness * w_.rate());
  fem::finite_strain(body_, flat(fields_->y - x_), finite_, false);
  return finite_.force + damping_.stiffness * (body_.K * w_.rate());
}

/// The matrix of the displacement at hand, theory manual eq. (flexible-bodies.24).
void NodalBody::refresh_stiffness(const solver::Stage& stage) {
  update_fields();
  fem::finite_strain(body_, flat(fields_->y - x_), finite_);
  const double viscous = stage.c * damping_.stiffness, scale = stage.k + viscous;
  factors_->restiffen((stage.k / scale) * finite_.tangent + (viscous / scale) * body_.K);
  is_stale_ = false;
}

/// Forces on the nodes that nothing balances, into r_; their norm relative to those of the forces they are sums of.
double NodalBody::unbalance(const ElasticMotion& motion) {
  update_fields();
  const ElasticFrame& base = motion.frames[0];
  update_accelerations(base);
  const VectorXd inertia = flat((fields_->acceleration + damping_.mass * fields_->y_rate) * body_.m);
  const VectorXd elastic = elastic_forces();
  r_ = inertia + elastic;
  sizes_ = inertia.cwiseAbs() + elastic.cwiseAbs();
  double size = inertia.norm() + elastic.norm();
  if (!loads_.empty()) {
    const VectorXd loads = flat(loads_on_nodes(motion));
    r_ -= loads;
    sizes_ += loads.cwiseAbs();
    size += loads.norm();
  }
  factors_->leave_to_frames(r_);
  if (motion.stage.dt > 0) {
    const Matrix3Xd velocity =
        (skew(Vector3(base.V.head<3>())) * fields_->y + fields_->y_rate).colwise() + Vector3(base.V.tail<3>());
    size += kMomentumShare / motion.stage.dt * (velocity * body_.m).norm();
  }
  return size > 0 ? r_.norm() / size : 0;
}

/// Whether the nodes answer to this motion of the frames, or are only looked at where they are.
bool NodalBody::follows(const ElasticMotion& motion) const {
  return at_rest_ || (motion.stage.dt > 0 && motion.stage.k != 0);
}

/// Solves the equations of the nodes for this motion of the frames, theory manual eq. (flexible-bodies.17).
void NodalBody::settle(const ElasticMotion& motion) {
  const bool moves = follows(motion);
  if (moves && !at_rest_) w_.predict(motion.stage);
  ModalBody::gather(motion, false);
  if (moves) {
    iterate(motion, at_rest_ ? solver::Stage{} : motion.stage);
  } else if (strain_ == Strain::finite) {  // looked at, not moved
    update_fields();
    (void)elastic_forces();
  }
}

void NodalBody::iterate(const ElasticMotion& motion, const solver::Stage& stage) {
  // At rest nothing but the material resists, so that its present matrix is needed each time.
  const bool renews = strain_ == Strain::finite && at_rest_;
  const int most = renews ? kSolvesAtRest : kSolves;
  for (int solve = 0;; ++solve) {
    if (renews || (strain_ == Strain::finite && is_stale_)) refresh_stiffness(stage);
    internal_residual_ = unbalance(motion);
    const NodalFactor* factor = factors_->of(stage, trouble_);
    if (factor == nullptr) return;
    trouble_.clear();
    if (internal_residual_ <= kBalanced || solve == most) return;
    w_.move(stage, factors_->solve(*factor, -r_));
  }
}

void NodalBody::evaluate(const ElasticMotion& motion, bool want_tangent, ElasticResponse& response) {
  settle(motion);
  ModalBody::evaluate(motion, want_tangent, response);
}

void NodalBody::add_nodes(const ElasticMotion& motion, bool want_tangent) {
  Workspace& w = work();
  const Index n = data().shapes();
  w.force.tail(n) += damping_.mass * (inertia_.rightCols(n).transpose() * w_.rate());
  if (!loads_.empty()) w.force.head<3>() -= cross_moment(nodes_of(w_.position()) * loads_on_nodes(motion).transpose());
  const VectorXd size = kNodalShare * sizes_;
  const Eigen::RowVectorXd each = nodes_of(size).colwise().norm();
  w.magnitude.head<3>().array() += each.dot(fields_->y.colwise().norm());
  w.magnitude.segment<3>(3).array() += each.sum();
  w.magnitude.tail(n) += Psi_size_.transpose() * size;
  if (want_tangent && follows(motion) && trouble_.empty()) condense(motion);
}

/// How the nodes' answer changes the derivatives. It is sought among the columns of X: onto (X^T S X)^-1 from, theory
/// manual eq. (flexible-bodies.17) to (flexible-bodies.20).
void NodalBody::condense(const ElasticMotion& motion) {
  Workspace& w = work();
  const solver::Stage stage = at_rest_ ? solver::Stage{} : motion.stage;
  const NodalFactor& factor = *factors_->of(stage, trouble_);
  const ElasticFrame& base = motion.frames[0];
  const Matrix3 spin = 2 * skew(Vector3(base.V.head<3>()));
  MatrixXd S = factor.W;
  for (Index p = 0; p < 3; ++p)
    for (Index r = 0; r < 3; ++r)
      S += (stage.c * spin(p, r) + stage.k * w.Omega(p, r)) * factor.answers[static_cast<std::size_t>(3 * p + r)];
  const auto moments = [&](const Matrix3Xd& field) {
    Moments of;
    for (std::size_t r = 0; r < 3; ++r) of[r] = factor.m_X[r].transpose() * field.transpose();
    return of;
  };
  const Moments by_y = moments(fields_->y), by_rate = moments(fields_->y_rate), by_acc = moments(fields_->y_acc);
  const MatrixXd onto = forces_of_answers(factor, stage, base, by_y, by_rate, by_acc);
  const MatrixXd answer = S.transpose().fullPivLu().solve(onto.transpose()).transpose();
  add_forces_on_nodes(factor, base, by_y, by_rate, answer);
}

/// d forces on the nodes / d (accelerations, velocities, places) of [frame 0; amplitudes], taken by X^T, theory manual
/// eq. (flexible-bodies.18); `answer` carries them on to the derivatives of the forces.
void NodalBody::add_forces_on_nodes(const NodalFactor& factor, const ElasticFrame& base, const Moments& by_y,
                                    const Moments& by_rate, const MatrixXd& answer) {
  Workspace& w = work();
  const Index n = data().shapes();
  const Matrix3 omega_x = skew(Vector3(base.V.head<3>()));
  MatrixXd from = MatrixXd::Zero(factor.W.rows(), 6 + n);
  const auto turned = [&](const Matrix3& turn, const Moments& by) {
    VectorXd sum = VectorXd::Zero(from.rows());
    for (Index r = 0; r < 3; ++r) sum += by[static_cast<std::size_t>(r)] * turn.row(r).transpose();
    return sum;
  };
  const auto of_shapes = [&](const Matrix3& turn) {
    MatrixXd sum = MatrixXd::Zero(from.rows(), n);
    for (Index r = 0; r < 3; ++r)
      for (Index p = 0; p < 3; ++p) sum += turn(r, p) * factor.shapes[static_cast<std::size_t>(3 * r + p)];
    return sum;
  };
  const auto even = factor.W.leftCols<3>();
  for (Index j = 0; j < 3; ++j) from.col(j) = turned(skew(Vector3(Vector3::Unit(j))), by_y);
  from.middleCols<3>(3) = even;
  from.rightCols(n) = factor.W.rightCols(n);
  w.M.noalias() -= answer * from;

  for (Index j = 0; j < 3; ++j) {
    const Matrix3 unit = skew(Vector3(Vector3::Unit(j)));
    from.col(j) = turned(unit * omega_x + omega_x * unit, by_y) + turned(2 * unit, by_rate);
  }
  from.leftCols<3>() -= even * skew(Vector3(base.V.tail<3>()));
  from.middleCols<3>(3) = even * omega_x;
  from.rightCols(n) = of_shapes(2 * omega_x) + damping_.mass * factor.W.rightCols(n);
  w.C.noalias() -= answer * from;
  w.K.rightCols(n).noalias() -= answer * of_shapes(w.Omega);
}

/// d forces on [frame 0; amplitudes] / d answer of the nodes as a sum of columns of X, theory manual eq.
/// (flexible-bodies.19).
MatrixXd NodalBody::forces_of_answers(const NodalFactor& factor, const solver::Stage& stage, const ElasticFrame& base,
                                      const Moments& by_y, const Moments& by_rate, const Moments& by_acc) {
  const Workspace& w = work();
  const Matrix3 omega_x = skew(Vector3(base.V.head<3>()));
  const Index n = data().shapes();
  const double k = stage.k, c = stage.c, m = stage.m;
  const Matrix3 D = 2 * c * omega_x + k * w.Omega;
  const auto even = factor.W.topRows<3>();
  MatrixXd onto(6 + n, factor.W.cols());
  onto.topRows<3>() = -k * skew(w.a_true) * even;
  onto.middleRows<3>(3) = (m * Matrix3::Identity() + D) * even;
  const auto product = [](const Moments& by, Index z) {  // integral of rho (field) w^T
    Matrix3 B;
    for (Index r = 0; r < 3; ++r) B.col(r) = by[static_cast<std::size_t>(r)].row(z).transpose();
    return B;
  };
  for (Index z = 0; z < onto.cols(); ++z) {
    const Matrix3 B = product(by_y, z), B_rate = product(by_rate, z), B_acc = product(by_acc, z);
    onto.col(z).head<3>() +=
        cross_moment(k * (B + B.transpose()) * w.Omega.transpose() +
                     2 * (c * B + k * B_rate.transpose()) * omega_x.transpose() + m * B + k * B_acc.transpose());
  }
  onto.bottomRows(n) = (m + c * damping_.mass) * factor.W.bottomRows(n);
  for (Index p = 0; p < 3; ++p)
    for (Index r = 0; r < 3; ++r)
      onto.bottomRows(n) += D(p, r) * factor.shapes[static_cast<std::size_t>(3 * r + p)].transpose();
  return onto;
}

void NodalBody::begin_step(const ElasticMotion&, double dt) {
  at_rest_ = dt == 0;
  is_stale_ = true;
  w_.begin_step();
  if (at_rest_) w_.start(w_.position());
}

void NodalBody::accept_step(const ElasticMotion& end) {
  if (at_rest_) settle(end);
  w_.accept();
}

VectorXd NodalBody::amplitudes(const ElasticMotion& motion) {
  ModalBody::gather(motion, false);
  const Index n = data().shapes(), films = n - frame_shapes_;
  VectorXd all(frame_shapes_ + vibrations_.cols());
  all.head(frame_shapes_) = work().q.segment(1, frame_shapes_);
  const VectorXd internal = Psi().rightCols(films) * work().q.tail(films) + w_.position();
  const VectorXd momentum = fem::mass_times(body_.m, internal);
  all.tail(vibrations_.cols()) = (vibrations_.transpose() * momentum).cwiseQuotient(vibration_mass_);
  return all;
}

VectorXd NodalBody::displacements(const ElasticMotion& motion, const MatrixXd&) {
  ModalBody::gather(motion, false);
  return Psi() * work().q.tail(data().shapes()) + w_.position();
}

ElasticEnergy NodalBody::energy(const ElasticMotion& motion, const Vector3& gravity) {
  gather(motion, false);
  const Workspace& w = work();
  const ElasticFrame& base = motion.frames[0];
  update_accelerations(base);
  const Pose& X = base.X_WF;
  const Index n = data().shapes();
  const Vector3 omega = base.V.head<3>();
  const Matrix3Xd velocity = (skew(omega) * fields_->y + fields_->y_rate).colwise() + Vector3(base.V.tail<3>());
  const Matrix3Xd momentum = velocity * body_.m;
  const Vector3 p = momentum.rowwise().sum();
  const auto q = w.q.tail(n), rate = w.rate.tail(n);
  ElasticEnergy e;
  e.kinetic = 0.5 * velocity.cwiseProduct(momentum).sum();
  if (strain_ == Strain::finite) {
    (void)elastic_forces();
    e.strain = finite_.energy;
    e.strain_rate = finite_.force.dot(flat(fields_->y_rate));
  } else {
    const VectorXd K_w = body_.K * w_.position();
    e.strain = 0.5 * (q.dot(data().stiffness * q) + w_.position().dot(K_w));
    e.strain_rate = rate.dot(data().stiffness * q) + w_.rate().dot(K_w);
  }
  e.dissipation = damping_.stiffness * (rate.dot(data().stiffness * rate) + w_.rate().dot(body_.K * w_.rate())) +
                  damping_.mass * fields_->y_rate.cwiseProduct(fields_->y_rate * body_.m).sum();
  e.potential = -gravity.dot(data().mass * X.r + X.R * w.S);
  e.gravity = (X.R.transpose() * gravity).dot(p);
  e.momentum = X.R * p;
  Vector3 spin = Vector3::Zero();
  for (Index i = 0; i < momentum.cols(); ++i) spin += fields_->y.col(i).cross(momentum.col(i));
  e.angular_momentum = X.R * spin + X.r.cross(e.momentum);
  e.kinetic_rate = fields_->acceleration.cwiseProduct(momentum).sum() + e.gravity;
  add_load_energies(motion, e);
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    ElasticMotion alone = motion;
    alone.loads.setZero();
    alone.loads[static_cast<Index>(i)] = motion.loads[static_cast<Index>(i)];
    const Matrix3Xd f = loads_on_nodes(alone);
    const Vector3 further = cross_moment(nodes_of(w_.position()) * f.transpose());  // the nodes have moved
    e.loads[i].power += flat(f).dot(w_.rate()) + further.dot(omega);
    e.loads[i].wrench.head<3>() += X.R * further;
  }
  return e;
}

void NodalBody::persist(Archive& archive) {
  w_.persist(archive);
  archive.io("at_rest", at_rest_);
  const Archive::Group group(archive, "factors");
  factors_->persist(archive);
}

}  // namespace hersey::mbd
