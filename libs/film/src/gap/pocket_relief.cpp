#include "gap/pocket_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "hersey/core/two_pi.h"

namespace hersey::film {
namespace {

// Gauss' rule with four points on [-1, 1]: Abramowitz and Stegun (1964), table 25.4. It is applied to both halves of a
// width, as for the fractions of control volumes (feature_cover.cpp), so that a rotating pocket keeps its volume.
constexpr std::array<double, 4> gauss_point{-0.861136311594052575, -0.339981043584856265, 0.339981043584856265,
                                            0.861136311594052575};
constexpr std::array<double, 4> gauss_weight{0.347854845137453857, 0.652145154862546143, 0.652145154862546143,
                                             0.347854845137453857};

/// Calls visit(fraction of the width, position within it from 0 to 1).
template <class Visit>
void over_gauss_points(Visit&& visit) {
  for (const double half : {0.25, 0.75}) {
    for (std::size_t k = 0; k < gauss_point.size(); ++k) visit(0.25 * gauss_weight[k], half + 0.25 * gauss_point[k]);
  }
}

/// A position and its derivative by phi_journal.
struct Border {
  double at = 0, journal = 0;
  bool operator<(const Border& other) const { return at < other.at; }
};

/// Returns the length of the interval from `first` to `last` that lies within +-half or a revolution away from there.
double length_within(double first, double last, double half) {
  if (half >= 0.5 * two_pi) return last - first;
  double sum = 0;
  for (const double image : {-two_pi, 0.0, two_pi, 2 * two_pi}) {
    sum += std::max(0.0, std::min(last, image + half) - std::max(first, image - half));
  }
  return sum;
}

}  // namespace

struct PocketRelief::Extent {
  double across = 0, along = 0;  ///< middle
  double half_across = 0, half_along = 0;
  double across_journal = 0, along_journal = 0;  ///< of the middle by phi_journal
  FeatureShape shape;
  bool in_journal = false;
  double depth = 0;
};

double swept_area(const SurfaceFeature& pocket, double R, double phi, double low, double high, double start,
                  double end) {
  // In the frame of the pocket the face moves from phi - start back to phi - end.
  const double turned = std::remainder(end - start, two_pi), from = std::remainder(phi - pocket.phi - start, two_pi);
  const double first = std::min(from, from - turned), last = std::max(from, from - turned);
  const double sign = turned < 0 ? -1 : 1, half = 0.5 * pocket.arc, half_length = 0.5 * pocket.length;
  if (std::holds_alternative<Rectangle>(pocket.shape)) {
    const double height = std::max(0.0, std::min(high, pocket.z + half_length) - std::max(low, pocket.z - half_length));
    return sign * R * height * length_within(first, last, half);
  }
  double sum = 0;
  over_gauss_points([&](double fraction, double position) {
    const double y = (low + position * (high - low) - pocket.z) / half_length;
    if (std::abs(y) >= 1) return;
    const double reach = std::visit([y](const auto& shape) { return shape.reach(y); }, pocket.shape);
    sum += fraction * length_within(first, last, half * reach);
  });
  return sign * R * (high - low) * sum;
}

PocketRelief::PocketRelief(const FilmModel& model, const GridGeometry& geometry) : model_(model), geometry_(geometry) {
  for (const SurfaceFeature& feature : model.features) {
    if (feature.depth == 0) continue;
    (feature.is_fed ? fed_ : pockets_).push_back(without_border(feature, model, geometry));
    any_rotates_ = any_rotates_ || feature.surface == Surface::journal;
  }
}

void PocketRelief::add_cells(const SurfaceFeature& feature, double phi_journal, Eigen::VectorXd& depth,
                             Eigen::VectorXd* slope) {
  cells_.clear();
  cover_cells(model_, geometry_, feature, phi_journal, cells_);
  for (const CoveredNode& cell : cells_) {
    depth[cell.node] += feature.depth * cell.fraction;
    if (slope != nullptr) (*slope)[cell.node] += feature.depth * cell.fraction_journal;
  }
}

void PocketRelief::set_rotation(double phi_journal, double phi_start, double dt, double speed) {
  const Arguments asked{phi_journal, phi_start, dt, dt > 0 ? 0 : speed};
  if (evaluated_ && (!any_rotates_ || *evaluated_ == asked)) return;
  const int n = model_.grid.size();
  covered_.clear();
  for (const auto* features : {&pockets_, &fed_}) {
    for (const SurfaceFeature& feature : *features) {
      cells_.clear();
      cover_cells(model_, geometry_, feature, phi_journal, cells_);
      for (const CoveredNode& cell : cells_)
        covered_.push_back({cell.node, cell.fraction, cell.fraction_journal, feature.depth});
    }
  }
  evaluated_ = asked;
  if (pockets_.empty()) return;
  for (auto* field : {&depth_, &depth_start_, &depth_journal_, &rotating_depth_}) field->setZero(n);
  for (const SurfaceFeature& pocket : pockets_) {
    const bool rotates = pocket.surface == Surface::journal;
    add_cells(pocket, phi_journal, depth_, &depth_journal_);
    add_cells(pocket, rotates && dt > 0 ? phi_start : phi_journal, depth_start_, nullptr);
    if (rotates) add_cells(pocket, phi_journal, rotating_depth_, nullptr);
  }
  locate_flow_tubes(phi_journal);
  sweep(phi_journal, phi_start, dt, speed);
}

void PocketRelief::locate_flow_tubes(double phi_journal) {
  flow_tubes_.clear(), strips_.clear(), segments_.clear();
  const Grid& grid = model_.grid;
  const auto image_nearest_to = [this](double middle, double phi) { return middle + geometry_.from_to(middle, phi); };
  std::vector<Extent> around, along;
  for (int i = 0; i < grid.n_phi; ++i) {
    const double phi = geometry_.phi[i], step = geometry_.dphi(i);
    const int before = grid.before(i), next = grid.next(i);
    const double back = before < 0 ? 0 : 0.5 * geometry_.dphi(before), ahead = 0.5 * step;
    around.clear(), along.clear();
    for (const SurfaceFeature& pocket : pockets_) {
      const bool rotates = pocket.surface == Surface::journal, all_around = pocket.arc >= two_pi;
      const double journal = rotates && !all_around ? 1 : 0;
      const double middle = image_nearest_to(phi + ahead, pocket.phi + (rotates ? phi_journal : 0.0));
      const double half_arc = all_around ? two_pi : 0.5 * pocket.arc, half_length = 0.5 * pocket.length;
      for (const double image : {-two_pi, 0.0, two_pi}) {
        if (all_around && image != 0) continue;
        const double at = middle + image;
        if (at + half_arc <= phi - back || at - half_arc >= phi + step) continue;
        around.push_back({pocket.z, at, half_length, half_arc, 0, journal, pocket.shape, rotates, pocket.depth});
        along.push_back({at, pocket.z, half_arc, half_length, journal, 0, pocket.shape, rotates, pocket.depth});
      }
    }
    if (around.empty()) continue;
    for (int j = 0; j < grid.n_z; ++j) {
      const double z = geometry_.z[j], low = j > 0 ? z - 0.5 * geometry_.dz[j - 1] : z;
      if (next >= 0)
        add_flow_tube(static_cast<std::size_t>(grid.index(i, j)), around, low, geometry_.width_z[j], phi, step);
      if (j + 1 == grid.n_z) continue;
      const auto face = static_cast<std::size_t>(grid.size() + i * (grid.n_z - 1) + j);
      add_flow_tube(face, along, phi - back, back + ahead, z, geometry_.dz[j]);
    }
  }
}

void PocketRelief::add_flow_tube(std::size_t face, const std::vector<Extent>& extents, double across, double width,
                                 double along, double length) {
  std::vector<Extent> near;
  for (const Extent& e : extents) {
    const bool beside = e.across + e.half_across <= across || e.across - e.half_across >= across + width;
    const bool beyond = e.along + e.half_along <= along || e.along - e.half_along >= along + length;
    if (!beside && !beyond) near.push_back(e);
  }
  if (near.empty()) return;
  PocketFlowTube flow_tube{.face = face, .first_strip = static_cast<int>(strips_.size())};
  std::vector<Border> borders{{across, 0}, {across + width, 0}};
  bool all_straight = true;
  for (const Extent& e : near) {
    (e.in_journal ? flow_tube.in_journal : flow_tube.in_shell) = true;
    const bool is_straight = std::visit([](const auto& shape) { return shape.has_straight_ends; }, e.shape);
    all_straight = all_straight && is_straight;
    if (!is_straight) continue;
    for (const double at : {e.across - e.half_across, e.across + e.half_across}) {
      if (at > across && at < across + width) borders.push_back({at, e.across_journal});
    }
  }
  std::sort(borders.begin(), borders.end());
  for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
    const Border &low = borders[k], &high = borders[k + 1];
    const double fraction = (high.at - low.at) / width, fraction_journal = (high.journal - low.journal) / width;
    const auto strip = [&](double part, double position) {
      add_strip(near, low.at + position * (high.at - low.at), low.journal + position * (high.journal - low.journal),
                part * fraction, part * fraction_journal, along, length);
    };
    if (all_straight) {
      strip(1, 0.5);
    } else {
      over_gauss_points(strip);
    }
  }
  flow_tube.strips = static_cast<int>(strips_.size()) - flow_tube.first_strip;
  flow_tubes_.push_back(flow_tube);
}

void PocketRelief::add_strip(const std::vector<Extent>& extents, double y, double y_journal, double fraction,
                             double fraction_journal, double along, double length) {
  struct Covered {
    Border from, to;
    double depth;
  };
  std::vector<Covered> intervals;
  std::vector<Border> borders{{along, 0}, {along + length, 0}};
  for (const Extent& e : extents) {
    const double off = (y - e.across) / e.half_across;
    if (std::abs(off) >= 1) continue;
    const auto [chord, slope] =
        std::visit([off](const auto& shape) { return std::pair(shape.reach(off), shape.reach_slope(off)); }, e.shape);
    const double reach = e.half_along * chord;
    const double reach_journal = e.half_along * slope * (y_journal - e.across_journal) / e.half_across;
    const auto clipped = [&](double at, double journal) {
      if (at <= along) return Border{along, 0};
      if (at >= along + length) return Border{along + length, 0};
      borders.push_back({at, journal});
      return Border{at, journal};
    };
    intervals.push_back({clipped(e.along - reach, e.along_journal - reach_journal),
                         clipped(e.along + reach, e.along_journal + reach_journal), e.depth});
  }
  std::sort(borders.begin(), borders.end());
  Strip strip{fraction, fraction_journal, static_cast<int>(segments_.size()), 0};
  for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
    const Border &from = borders[k], &to = borders[k + 1];
    if (to.at <= from.at) continue;
    const double middle = 0.5 * (from.at + to.at);
    Segment segment{(to.at - from.at) / length, (to.journal - from.journal) / length, 0};
    for (const Covered& c : intervals) {
      if (c.from.at < middle && middle < c.to.at) segment.depth += c.depth;
    }
    segments_.push_back(segment);
    ++strip.segments;
  }
  strips_.push_back(strip);
}

FlowTubeGap PocketRelief::gap(const PocketFlowTube& flow_tube, double h) const {
  FlowTubeGap sum;
  for (int s = flow_tube.first_strip; s < flow_tube.first_strip + flow_tube.strips; ++s) {
    const Strip& strip = strips_[s];
    // Integrals I_1 to I_4, and the derivatives of I_2 and I_3 by phi_journal.
    std::array<double, 5> I{};
    double I1_journal = 0, I2_journal = 0, I3_journal = 0;
    for (int k = strip.first_segment; k < strip.first_segment + strip.segments; ++k) {
      const Segment& segment = segments_[k];
      const double x = 1 / (h + segment.depth), x2 = x * x;
      I[1] += segment.fraction * x, I[2] += segment.fraction * x2, I[3] += segment.fraction * x2 * x;
      I[4] += segment.fraction * x2 * x2;
      I1_journal += segment.fraction_journal * x;
      I2_journal += segment.fraction_journal * x2, I3_journal += segment.fraction_journal * x2 * x;
    }
    const double cube = 1 / I[3], cube_h = 3 * I[4] * cube * cube, cube_journal = -I3_journal * cube * cube;
    const double carry = I[2] * cube, carry_h = -2 * I[3] * cube + I[2] * cube_h;
    const double carry_journal = I2_journal * cube + I[2] * cube_journal;
    sum.cube.value += strip.fraction * cube, sum.cube.h += strip.fraction * cube_h;
    sum.cube.journal += strip.fraction_journal * cube + strip.fraction * cube_journal;
    sum.carry.value += strip.fraction * carry, sum.carry.h += strip.fraction * carry_h;
    sum.carry.journal += strip.fraction_journal * carry + strip.fraction * carry_journal;
    if (strip.segments == 1) continue;
    const double excess = I[1] - I[2] * carry;
    sum.excess.value += strip.fraction * excess, sum.excess.h += 3 * strip.fraction * (I[2] - carry * carry * I[4]);
    sum.excess.journal += strip.fraction_journal * excess +
                          strip.fraction * (I1_journal - 2 * carry * I2_journal + carry * carry * I3_journal);
  }
  return sum;
}

// Sets the volumes that rotate over the faces around the bearing, as means of the step: together with the change of the
// control volumes' depth a pocket neither brings nor removes oil.
void PocketRelief::sweep(double phi_journal, double phi_start, double dt, double speed) {
  if (!any_rotates_) return;
  const Grid& grid = model_.grid;
  // A pocket may have passed a face in the step and cover no flow tube there any more, so that every face of the
  // pocket's rows is tested. Flow tubes are in the order of faces of one direction, not of all.
  std::vector<int> tube_of(static_cast<std::size_t>(grid.size()), -1);
  for (std::size_t t = 0; t < flow_tubes_.size(); ++t) {
    if (flow_tubes_[t].face < tube_of.size()) tube_of[flow_tubes_[t].face] = static_cast<int>(t);
  }
  for (int i = 0; i < grid.n_phi; ++i) {
    const double face = geometry_.phi[i] + 0.5 * geometry_.dphi(i);
    for (int j = 0; j < grid.n_z && grid.next(i) >= 0; ++j) {
      const double R = geometry_.R * geometry_.stretch[j];
      const double z = geometry_.z[j], low = j > 0 ? z - 0.5 * geometry_.dz[j - 1] : z;
      const double high = low + geometry_.width_z[j];
      double swept = 0, swept_journal = 0, swept_speed = 0;
      for (const SurfaceFeature& pocket : pockets_) {
        if (pocket.surface != Surface::journal) continue;
        if (low >= pocket.z + 0.5 * pocket.length || high <= pocket.z - 0.5 * pocket.length) continue;
        // The rate at the present angle is that with which the pocket covers the face, from a step too small to pass
        // anything.
        const double sliver = 1e-9;
        const double cover = swept_area(pocket, R, face, low, high, phi_journal - sliver, phi_journal) / sliver;
        if (dt > 0) {
          swept += pocket.depth * swept_area(pocket, R, face, low, high, phi_start, phi_journal) / dt;
          swept_journal += pocket.depth * cover / dt;
        } else {
          swept += pocket.depth * cover * speed / model_.R;
          swept_speed += pocket.depth * cover / R;
        }
      }
      if (swept == 0 && swept_journal == 0) continue;
      int& at = tube_of[static_cast<std::size_t>(grid.index(i, j))];
      if (at < 0) {
        at = static_cast<int>(flow_tubes_.size());
        flow_tubes_.push_back({.face = static_cast<std::size_t>(grid.index(i, j)), .in_journal = true});
        flow_tubes_.back().first_strip = static_cast<int>(strips_.size());
        flow_tubes_.back().strips = 1;
        strips_.push_back({1, 0, static_cast<int>(segments_.size()), 1});
        segments_.push_back({1, 0, 0});
      }
      PocketFlowTube& flow_tube = flow_tubes_[static_cast<std::size_t>(at)];
      flow_tube.swept = swept, flow_tube.swept_journal = swept_journal, flow_tube.swept_speed = swept_speed;
    }
  }
}

}  // namespace hersey::film
