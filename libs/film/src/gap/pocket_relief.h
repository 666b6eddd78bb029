#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "gap/feature_cover.h"
#include "gap/grid_geometry.h"
#include "hersey/film/film_model.h"

namespace hersey::film {

/// A value with its derivatives by film thickness and by phi_journal.
struct ByGap {
  double value = 0, h = 0, journal = 0;
};

/// Properties of a flow tube between two nodes that pockets cover in part, per width (film.26, film.28), by the
/// integrals I_n of 1/h^n over the flow tube's length, per length.
struct FlowTubeGap {
  ByGap cube;    ///< 1/I_3, which replaces h^3 [m^3]
  ByGap carry;   ///< I_2/I_3, which replaces h where surfaces carry oil past the pocket's steps [m]
  ByGap excess;  ///< I_1 - I_2^2/I_3: recirculation in the pockets, 0 without steps [1/m]
};

/// A flow tube from one node to the next that pockets cover in part. It is cut into strips along the flow and these
/// into segments of one depth each: strips are passed in parallel, segments in series.
struct PocketFlowTube {
  std::size_t face = 0;
  int first_strip = 0, strips = 0;
  bool in_shell = false, in_journal = false;  ///< surfaces that have the pockets
  double swept = 0;          ///< volume of the journal's pockets that passes the face by rotation [m^3/s]
  double swept_journal = 0;  ///< by phi_journal [m^3/(s rad)]
  double swept_speed = 0;    ///< by the journal's speed [m^2]
};

/// A feature's part of a node's control volume, with its depth.
struct CoveredDepth {
  int node = 0;
  double fraction = 0;          ///< of the volume [-]
  double fraction_journal = 0;  ///< by phi_journal [1/rad]
  double depth = 0;             ///< [m]
};

/// Depth of a film's features over its grid. It is no part of the gap between the surfaces, because it has steps and
/// the gap is smooth. Fed features have the pressure of their supply and need no flow inside: their depth changes only
/// the shear.
class PocketRelief {
 public:
  PocketRelief(const FilmModel& model, const GridGeometry& geometry);

  /// Sets the angle `phi_journal` of the journal's pockets [rad]. In a step of dt > 0 they come from `phi_start`; with
  /// dt = 0 they rotate at `speed` [m/s].
  void set_rotation(double phi_journal, double phi_start, double dt, double speed);

  [[nodiscard]] bool is_empty() const { return pockets_.empty() && fed_.empty(); }
  [[nodiscard]] bool has_pockets() const { return !pockets_.empty(); }
  [[nodiscard]] const std::vector<PocketFlowTube>& flow_tubes() const { return flow_tubes_; }
  [[nodiscard]] FlowTubeGap gap(const PocketFlowTube& flow_tube, double h) const;

  // Mean depth of pockets over each control volume (film.27) at present and at the start of the step [m], and its
  // derivative by phi_journal [m/rad]; empty where there are no pockets.
  [[nodiscard]] const Eigen::VectorXd& depth() const { return depth_; }
  [[nodiscard]] const Eigen::VectorXd& depth_start() const { return depth_start_; }
  [[nodiscard]] const Eigen::VectorXd& depth_by_journal() const { return depth_journal_; }
  /// Present mean depth of the journal's pockets alone [m].
  [[nodiscard]] const Eigen::VectorXd& turning_depth() const { return rotating_depth_; }
  /// Covered fractions of all pockets and fed features.
  [[nodiscard]] const std::vector<CoveredDepth>& covered() const { return covered_; }

 private:
  struct Segment {
    double fraction = 0, fraction_journal = 0, depth = 0;
  };
  struct Strip {
    double fraction = 0, fraction_journal = 0;
    int first_segment = 0, segments = 0;
  };
  /// Extent of a feature relative to a flow tube: across and along the flow, with the rate at which it rotates.
  struct Extent;
  /// Arguments of the last set_rotation().
  struct Arguments {
    double phi_journal = 0, phi_start = 0, dt = 0, speed = 0;
    bool operator==(const Arguments&) const = default;
  };

  void locate_flow_tubes(double phi_journal);
  void add_flow_tube(std::size_t face, const std::vector<Extent>& extents, double across, double width, double along,
                     double length);
  void add_strip(const std::vector<Extent>& extents, double y, double y_journal, double fraction,
                 double fraction_journal, double along, double length);
  void sweep(double phi_journal, double phi_start, double dt, double speed);
  void add_cells(const SurfaceFeature& feature, double phi_journal, Eigen::VectorXd& depth, Eigen::VectorXd* slope);

  const FilmModel& model_;
  const GridGeometry& geometry_;
  std::vector<SurfaceFeature> pockets_, fed_;
  bool any_rotates_ = false;
  std::optional<Arguments> evaluated_;
  std::vector<PocketFlowTube> flow_tubes_;
  std::vector<Strip> strips_;
  std::vector<Segment> segments_;
  Eigen::VectorXd depth_, depth_start_, depth_journal_, rotating_depth_;
  std::vector<CoveredDepth> covered_;
  std::vector<CoveredNode> cells_;
};

/// Returns the volume of a journal's pocket per depth that passes the face at `phi` between two heights while the
/// journal rotates from `start` to `end` [m^2]. Divided by the step it is the flow that keeps the pocket's volume.
[[nodiscard]] double swept_area(const SurfaceFeature& pocket, double R, double phi, double low, double high,
                                double start, double end);

}  // namespace hersey::film
