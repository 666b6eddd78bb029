#include "hersey/mbd/nodal_body.h"

#include <utility>

#include "elastic/modal_workspace.h"
#include "elastic/nodal_factors.h"
#include "elastic/nodal_fields.h"
#include "elastic/nodal_setup.h"
#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "tree/momentum_share.h"

namespace hersey::mbd {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSolves = 2;           // most solutions per evaluation
constexpr int kSolvesAtRest = 30;    // the same of a body of finite strain in statics
constexpr double kBalanced = 1e-12;  // of the forces on the nodes: no further solution
constexpr double kServes = 1e-4;     // the same: the matrix of a body of finite strain serves for this step

// Share of the sum of magnitudes of the forces on all nodes that counts as a magnitude of their sums: small resultants
// on frames still have the round-off of these forces.
constexpr double kNodalShare = 1e-4;

// Square of the time step in which released nodes get their acceleration [s^2]: it is too short for the stiffness of a
// mesh to act.
constexpr double kInstant = 1e-24;

constexpr Index kRotation = 3;  // the first of these columns of (flexible-bodies.19)

Eigen::Map<const Matrix3Xd> nodes_of(const VectorXd& u) { return {u.data(), 3, u.size() / 3}; }

VectorXd flat(const Matrix3Xd& field) { return Eigen::Map<const VectorXd>(field.data(), field.size()); }

}  // namespace

NodalBody::NodalBody(fem::ElasticBody body, const fem::ReducedBody& reduced, const RayleighDamping& damping,
                     Strain strain)
    : ModalBody(strain == Strain::small ? static_data(body, reduced, damping) : finite_data(body, reduced, damping)),
      body_(std::move(body)),
      damping_(damping),
      strain_(strain),
      fields_(std::make_unique<NodalFields>()) {
  HERSEY_REQUIRE(static_cast<std::size_t>(body_.node_count()) == reduced.nodes.size(), "both of one mesh");
  x_.resize(3, body_.node_count());
  for (Index i = 0; i < x_.cols(); ++i) x_.col(i) = reduced.nodes[static_cast<std::size_t>(i)];
  nodal_mass_ = Eigen::RowVectorXd::Ones(x_.cols()) * body_.m;
  const Index shapes = data().shapes();
  frame_shapes_ = data().shapes_per_frame * (frame_count() - 1);
  Psi_size_ = Psi().cwiseAbs();
  vibrations_ = reduced.Phi.rightCols(reduced.size() - reduced.internal_first());
  for (Index a = 0; a < vibrations_.cols(); ++a) {
    const VectorXd shape = vibrations_.col(a);
    vibrations_.col(a) /= nodes_of(shape).colwise().norm().maxCoeff();
  }
  vibration_mass_ = vibrations_.cwiseProduct(fem::mass_times(body_.m, vibrations_)).colwise().sum();

  columns_ = MatrixXd::Zero(body_.size(), kInertiaColumns + (strain == Strain::small ? shapes : 2 * shapes));
  const Matrix3Xd moments = x_ * body_.m;
  for (Index k = 0; k < 3; ++k) {
    for (Index i = 0; i < x_.cols(); ++i) columns_(3 * i + k, k) = nodal_mass_[i];
    for (Index p = 0; p < 3; ++p)
      for (Index i = 0; i < x_.cols(); ++i) columns_(3 * i + k, kRotation + 3 * p + k) = moments(p, i);
  }
  columns_.middleCols(kInertiaColumns, shapes) = fem::mass_times(body_.m, Psi());
  for (std::size_t p = 0; p < 3; ++p) {
    m_Psi_[p].resize(x_.cols(), shapes);
    for (Index a = 0; a < shapes; ++a)
      m_Psi_[p].col(a) =
          Eigen::Map<const VectorXd, 0, Eigen::InnerStride<3>>(columns_.col(kInertiaColumns + a).data() + p, x_.cols());
  }

  factors_ = std::make_unique<NodalFactors>(body_, supports_of(body_, reduced), damping_, columns_, Psi());
  if (strain == Strain::finite) {
    drawn_frames_ = reduced.Phi.middleCols(6, reduced.internal_first() - 6);
    columns_.rightCols(shapes) = body_.K * Psi();
    stiffness_of_shapes_ = data().stiffness;
  }
  w_.start(VectorXd::Zero(body_.size()));
  followed_ = VectorXd::Zero(data().shapes());
  sizes_ = VectorXd::Zero(body_.size());
}

NodalBody::~NodalBody() = default;

long NodalBody::solves() const { return factors_->solves(); }

void NodalBody::add_load(const NodalLoad& load) {
  ModalBody::add_load(load);
  loads_.push_back(load);
}

/// Loads at their present values, in the body's axes: all, or those given in `axes`.
Matrix3Xd NodalBody::loads_on_nodes(const ElasticMotion& motion, std::optional<LoadAxes> axes) const {
  Matrix3Xd sum = Matrix3Xd::Zero(3, x_.cols());
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    if (axes && loads_[i].axes != *axes) continue;
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
  MatrixXd amplitudes(n, 3);
  amplitudes << w.q.tail(n), w.rate.tail(n), w.acceleration.tail(n);
  if (fields_->amplitudes.size() == 0 || amplitudes != fields_->amplitudes) {
    fields_->carried.noalias() = Psi() * amplitudes;
    fields_->amplitudes = amplitudes;
  }
  fields_->u = fields_->carried.col(0) + w_.position();
  fields_->y = x_ + nodes_of(fields_->u);
  fields_->y_rate = nodes_of(fields_->carried.col(1) + w_.rate());
  fields_->y_acc = nodes_of(fields_->carried.col(2) + w_.acceleration());
}

/// Theory manual eq. (flexible-bodies.3) at each node.
void NodalBody::update_accelerations(const ElasticFrame& base) {
  const Vector3 omega = base.V.head<3>();
  const Matrix3 omega_x = skew(omega), Omega = skew(Vector3(base.A.head<3>())) + omega_x * omega_x;
  const Vector3 a = base.A.tail<3>() + omega.cross(base.V.tail<3>());
  fields_->acceleration = ((Omega * fields_->y + 2 * omega_x * fields_->y_rate + fields_->y_acc).colwise() + a).eval();
}

/// Sums over nodes instead of those over shapes, theory manual eq. (flexible-bodies.5).
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
  const MatrixXd all = fields_->side_by_side();
  for (std::size_t p = 0; p < 3; ++p) {
    const MatrixXd sums = m_Psi_[p].transpose() * all;
    for (std::size_t r = 0; r < 3; ++r) {
      const auto column = static_cast<Index>(r);
      w.h[3 * p + r].tail(sums.rows()) = sums.col(column);
      w.h_rate[3 * p + r].tail(sums.rows()) = sums.col(3 + column);
      w.h_acc[3 * p + r].tail(sums.rows()) = sums.col(6 + column);
    }
  }
  for (Index a = 1; a <= data().shapes(); ++a) {
    const auto at = static_cast<std::size_t>(a);
    for (std::size_t i = 0; i < 9; ++i) {
      const auto row = static_cast<Index>(i / 3), column = static_cast<Index>(i % 3);
      w.H[at](row, column) = w.h[i][a];
      w.H_rate[at](row, column) = w.h_rate[i][a];
      w.H_acc[at](row, column) = w.h_acc[i][a];
    }
  }
}

/// Returns the forces of the material on the nodes, theory manual eq. (flexible-bodies.16) or (flexible-bodies.21).
VectorXd NodalBody::elastic_forces() {
  if (strain_ == Strain::small) return body_.K * (w_.position() + damping_.stiffness * w_.rate());
  const VectorXd rate = flat(fields_->y_rate);
  fem::finite_strain(body_, fields_->u, finite_, false, damping_.stiffness > 0 ? &rate : nullptr);
  return finite_.force + damping_.stiffness * finite_.rate;
}

/// The matrix of the displacement at hand, theory manual eq. (flexible-bodies.21).
void NodalBody::refresh_stiffness() {
  update_fields();
  fem::finite_strain(body_, fields_->u, finite_);
  factors_->restiffen(finite_.tangent);
  const Index n = data().shapes();
  columns_.rightCols(n).noalias() = finite_.tangent * Psi();
  stiffness_of_shapes_.noalias() = Psi().transpose() * columns_.rightCols(n);
  is_stale_ = false;
}

/// Moves the nodes with frames that have moved since the last evaluation; otherwise the elements next to a frame would
/// deform by its whole motion. Directly after the prediction of a step nodes and frames are consistent.
void NodalBody::follow_frames(const solver::Stage& stage) {
  const Index n = data().shapes();
  const VectorXd moved = work().q.tail(n) - followed_;
  followed_ = work().q.tail(n);
  const bool goes_along = !is_predicted_ && !is_let_go_ && !moved.isZero(0);
  is_predicted_ = false;
  if (!goes_along) return;
  const NodalFactor* factor = factors_->of(stage, failure_);
  if (factor == nullptr) return;
  const VectorXd forces = columns_.rightCols(n) * ((stage.k + stage.c * damping_.stiffness) * moved) +
                          columns_.middleCols(kInertiaColumns, n) * ((stage.m + stage.c * damping_.mass) * moved);
  w_.move(stage, factors_->solve(*factor, -forces));
}

/// Forces on the nodes that nothing balances, into r_; their norm relative to those of the forces they are sums of.
double NodalBody::unbalance(const ElasticMotion& motion) {
  update_fields();
  const ElasticFrame& base = motion.frames[0];
  update_accelerations(base);
  const VectorXd inertia = flat((fields_->acceleration + damping_.mass * fields_->y_rate) * body_.m);
  elastic_ = elastic_forces();
  r_ = inertia + elastic_;
  sizes_ = inertia.cwiseAbs() + elastic_.cwiseAbs();
  double size = inertia.norm() + elastic_.norm();
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

/// True if the nodes are solved for this motion of the frames; false if they are only observed.
bool NodalBody::follows(const ElasticMotion& motion) const {
  return at_rest_ || is_let_go_ || (motion.stage.dt > 0 && motion.stage.k != 0);
}

/// Returns the stage of the nodes' equations: that of statics at rest, that of accelerations alone if the nodes are
/// released.
solver::Stage NodalBody::stage_of(const ElasticMotion& motion) const {
  if (at_rest_) return solver::Stage{};
  if (is_let_go_) return {.dt = 0, .k = kInstant, .c = 0, .m = 1, .dq = {}};
  return motion.stage;
}

/// Solves the equations of the nodes for this motion of the frames, theory manual eq. (flexible-bodies.17); at the
/// start (flexible-bodies.20).
void NodalBody::settle(const ElasticMotion& motion) {
  const bool moves = follows(motion);
  if (moves && !at_rest_ && !is_let_go_) w_.predict(motion.stage);
  ModalBody::gather(motion, false);
  if (moves) {
    iterate(motion, stage_of(motion));
  } else if (strain_ == Strain::finite) {  // observed, not solved
    update_fields();
    elastic_ = elastic_forces();
  }
}

void NodalBody::iterate(const ElasticMotion& motion, const solver::Stage& stage) {
  // At rest nothing but the material resists, so that its present matrix is needed each time.
  const bool renews = strain_ == Strain::finite && at_rest_;
  const int most = renews ? kSolvesAtRest : kSolves;
  solver::Stage moved = stage;
  if (is_let_go_) moved.k = 0;  // accelerated, but not yet displaced
  if (strain_ == Strain::finite) follow_frames(stage);
  for (int solve = 0;; ++solve) {
    if (renews || (strain_ == Strain::finite && is_stale_)) refresh_stiffness();
    internal_residual_ = unbalance(motion);
    const NodalFactor* factor = factors_->of(stage, failure_);
    if (factor == nullptr) return;
    failure_.clear();
    if (internal_residual_ <= kBalanced || solve == most) break;
    w_.move(moved, factors_->solve(*factor, -r_));
  }
  is_stale_ = internal_residual_ > kServes;
}

void NodalBody::evaluate(const ElasticMotion& motion, bool want_tangent, ElasticResponse& response) {
  settle(motion);
  ModalBody::evaluate(motion, want_tangent, response);
}

void NodalBody::add_elasticity(bool want_tangent) {
  if (strain_ == Strain::small) return ModalBody::add_elasticity(want_tangent);
  Workspace& w = work();
  const Index n = data().shapes();
  w.force.tail(n) += Psi().transpose() * elastic_ + data().damping * w.rate.tail(n);
  w.magnitude.tail(n) += round_off();
  if (!want_tangent) return;
  w.K.bottomRightCorner(n, n) += stiffness_of_shapes_;
  w.C.bottomRightCorner(n, n) += damping_.stiffness * stiffness_of_shapes_ + data().damping;
}

void NodalBody::add_nodes(const ElasticMotion& motion, bool want_tangent) {
  Workspace& w = work();
  const Index n = data().shapes();
  w.force.tail(n) += damping_.mass * (columns_.middleCols(kInertiaColumns, n).transpose() * w_.rate());
  if (!loads_.empty()) {
    w.force.head<3>() += torque_of_loads(loads_on_nodes(motion), w_.position());
    if (want_tangent)
      for (Index k = 0; k < 3; ++k)
        w.K.col(k).head<3>() -= torque_of_loads(nodes_of(rotated_loads(motion).col(k)), w_.position());
  }
  const VectorXd size = kNodalShare * sizes_;
  const Eigen::RowVectorXd each = nodes_of(size).colwise().norm();
  w.magnitude.head<3>().array() += each.dot(fields_->y.colwise().norm());
  w.magnitude.segment<3>(3).array() += each.sum();
  w.magnitude.tail(n) += Psi_size_.transpose() * size;
  if (want_tangent && follows(motion) && failure_.empty()) condense(motion);
}

void NodalBody::begin_step(const ElasticMotion&, double dt) {
  at_rest_ = dt == 0 && !lets_go_;
  is_let_go_ = dt == 0 && lets_go_;
  is_stale_ = true;
  is_predicted_ = !at_rest_;
  w_.begin_step();
  if (at_rest_) w_.start(w_.position());
  if (is_let_go_) w_.start(VectorXd::Zero(body_.size()));
}

void NodalBody::accept_step(const ElasticMotion& end) {
  if (at_rest_ || is_let_go_) settle(end);
  if (!at_rest_ && !is_let_go_) lets_go_ = false;
  w_.accept();
}

VectorXd NodalBody::amplitudes(const ElasticMotion& motion) {
  ModalBody::gather(motion, false);
  const Index films = data().shapes() - frame_shapes_;
  const VectorXd of_frames = frame_amplitudes();
  VectorXd all(of_frames.size() + vibrations_.cols());
  all.head(of_frames.size()) = of_frames;
  const VectorXd internal =
      strain_ == Strain::small
          ? VectorXd(Psi().rightCols(films) * work().q.tail(films) + w_.position())
          : VectorXd(Psi() * work().q.tail(data().shapes()) + w_.position() - drawn_frames_ * of_frames);
  const VectorXd momentum = fem::mass_times(body_.m, internal);
  all.tail(vibrations_.cols()) = (vibrations_.transpose() * momentum).cwiseQuotient(vibration_mass_);
  return all;
}

/// Returns for each frame but the first the sine of its rotation angle times the axis, and its displacement.
VectorXd NodalBody::frame_amplitudes() {
  const VectorXd q = work().q.segment(1, frame_shapes_);
  if (strain_ == Strain::small) return q;
  const Index further = frame_count() - 1;
  VectorXd all(6 * further);
  for (Index i = 0; i < further; ++i) {
    const auto A = q.segment<12>(12 * i);
    all.segment<6>(6 * i) << 0.5 * (A[7] - A[5]), 0.5 * (A[2] - A[6]), 0.5 * (A[3] - A[1]), A.tail<3>();
  }
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
    elastic_ = elastic_forces();
    const VectorXd y_rate = flat(fields_->y_rate);
    e.strain = finite_.energy;
    e.strain_rate = finite_.force.dot(y_rate);
    e.dissipation = damping_.stiffness * finite_.rate.dot(y_rate);
  } else {
    const VectorXd K_w = body_.K * w_.position();
    e.strain = 0.5 * (q.dot(data().stiffness * q) + w_.position().dot(K_w));
    e.strain_rate = rate.dot(data().stiffness * q) + w_.rate().dot(K_w);
    e.dissipation = damping_.stiffness * (rate.dot(data().stiffness * rate) + w_.rate().dot(body_.K * w_.rate()));
  }
  e.dissipation += damping_.mass * fields_->y_rate.cwiseProduct(fields_->y_rate * body_.m).sum();
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
  archive.io("lets_go", lets_go_);
  archive.io("is_let_go", is_let_go_);
  const Archive::Group group(archive, "factors");
  factors_->persist(archive);
}

}  // namespace hersey::mbd
