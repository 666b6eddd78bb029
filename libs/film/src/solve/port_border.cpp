#include "solve/port_border.h"

#include <cmath>

#include "balance/flow_balance.h"

namespace hersey::film {
namespace {

// A feature whose flow no pressure changes, as one of constant flow in a film at rest without oil, has a conductance
// this small: a long step there, and none elsewhere.
constexpr double kLeastConductance = 1e-9;

}  // namespace

void PortBorder::take(const FlowBalance& balance) {
  nodes_.clear();
  for (const FlowBalance::RestrictedPort& port : balance.restricted_ports()) nodes_.push_back(port.node);
  forget_answers();
  if (is_empty()) return;
  balance.find_restricted(rows_, columns_);
  least_conductance_ = kLeastConductance * balance.conductance_scale();
}

// Rows^T answers is the change of the ports' balances with pressures taken with the opposite sign.
void PortBorder::factorise_ports() {
  Eigen::MatrixXd ports = rows_.transpose() * answers_;
  for (Eigen::Index k = 0; k < ports.rows(); ++k)
    if (std::abs(ports(k, k)) < least_conductance_) ports(k, k) -= least_conductance_;
  ports_.compute(ports);
}

Eigen::MatrixXd PortBorder::take_rows(Eigen::Ref<Eigen::MatrixXd> columns) const {
  Eigen::MatrixXd taken(static_cast<Eigen::Index>(nodes_.size()), columns.cols());
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    taken.row(static_cast<Eigen::Index>(k)) = columns.row(nodes_[k]);
    columns.row(nodes_[k]).setZero();
  }
  return taken;
}

void PortBorder::put_rows(const Eigen::MatrixXd& z, Eigen::Ref<Eigen::MatrixXd> columns) const {
  for (std::size_t k = 0; k < nodes_.size(); ++k) columns.row(nodes_[k]) = z.row(static_cast<Eigen::Index>(k));
}

Eigen::VectorXd PortBorder::at_ports(const Eigen::VectorXd& y) const {
  Eigen::VectorXd taken(static_cast<Eigen::Index>(nodes_.size()));
  for (std::size_t k = 0; k < nodes_.size(); ++k) taken[static_cast<Eigen::Index>(k)] = y[nodes_[k]];
  return taken;
}

void PortBorder::subtract_product(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::VectorXd& before,
                                  Eigen::VectorXd& y) const {
  for (std::size_t k = 0; k < nodes_.size(); ++k) y -= columns_.col(static_cast<Eigen::Index>(k)) * x[nodes_[k]];
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto port = static_cast<Eigen::Index>(k);
    y[nodes_[k]] = before[port] - rows_.col(port).dot(x);
  }
}

}  // namespace hersey::film
