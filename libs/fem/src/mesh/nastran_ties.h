#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesh/nastran_card.h"
#include "mesh/nastran_systems.h"
#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// RBE1, RBE2, RBE3, RBAR, RBAR1, RROD and MPC of a bulk data file, which become equations when all grid points and
/// coordinate systems are known.
class NastranTies {
 public:
  /// True if an entry defines a tie.
  [[nodiscard]] static bool takes(const std::string& entry);

  void add(const RawMesh& raw, int file, const NastranCard& card);

  /// `MPC = number` of the case control section.
  void select(long set, FileLocation location);
  /// There is a case control section: an MPC that it does not select is not meant.
  void set_selecting() { selects_ = true; }

  /// Puts their equations into `raw`, whose grid points `systems` has resolved.
  void build(RawMesh& raw, NastranSystems& systems);

 private:
  using Components = std::string;
  struct Rigid {
    FileLocation location;
    std::vector<std::pair<long, Components>> independent, dependent;
  };
  struct Weighted {
    double weight = 1;
    Components components;
    long grid = 0;
  };
  struct Average {
    FileLocation location;
    long grid = 0;
    Components components;
    std::vector<Weighted> members;
  };
  struct Rod {
    FileLocation location;
    long a = 0, b = 0;
  };
  struct Equation {
    FileLocation location;
    struct Term {
      long grid, component;
      double factor;
    };
    std::vector<Term> terms;
  };

  void add_rbe1(const RawMesh& raw, int file, const NastranCard& card);
  void add_rbe2(const RawMesh& raw, int file, const NastranCard& card);
  void add_rbe3(const RawMesh& raw, int file, const NastranCard& card);
  void add_bar(const RawMesh& raw, int file, const NastranCard& card);
  void add_mpc(const RawMesh& raw, int file, const NastranCard& card);
  void build_rigid(RawMesh& raw, NastranSystems& systems, const Rigid& rigid) const;
  void build_average(RawMesh& raw, NastranSystems& systems, const Average& average) const;
  void build_rod(RawMesh& raw, const NastranSystems& systems, const Rod& rod) const;
  void build_equations(RawMesh& raw, NastranSystems& systems);
  [[nodiscard]] std::set<long> chosen_sets(RawMesh& raw) const;

  std::vector<Rigid> rigid_;
  std::vector<Average> averages_;
  std::vector<Rod> rods_;
  std::map<long, std::vector<Equation>> equations_;
  std::map<long, std::vector<long>> unions_;  ///< MPCADD
  std::optional<long> selected_;
  std::optional<std::pair<long, FileLocation>> also_selected_;
  bool selects_ = false;
};

}  // namespace hersey::fem
