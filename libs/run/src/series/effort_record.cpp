#include "series/effort_record.h"

#include "series/joint_record.h"

namespace hersey::run {
namespace {

template <class Coordinate>
Quantity<Effort, Coordinate> effort_line(const char* text) {
  return {"force_or_torque", "N|N.m", text, &Effort::value, {.unit = [](const Coordinate& on) -> std::string {
            return on.is_rotational ? "N.m" : "N";
          }}};
}

template <class Coordinate>
Quantity<Effort, Coordinate> power_line() {
  return {"power", "W", "power put into the machine", &Effort::power};
}

}  // namespace

const EffortRecord::Table& EffortRecord::of_drives() {
  static const Table table{effort_line<Coordinate>("effort on the driven coordinate"), power_line<Coordinate>()};
  return table;
}

const EffortRecord::Table& EffortRecord::of_couplings() {
  static const Table table{effort_line<Coordinate>("effort on the output coordinate")};
  return table;
}

const EffortRecord::Table& EffortRecord::of_forces() {
  static const Table table{effort_line<Coordinate>("effort on the joint coordinate"), power_line<Coordinate>()};
  return table;
}

EffortRecord::EffortRecord(const mbd::MechanismSpec& spec, results::Writer& writer) {
  const auto add = [&](std::vector<Rows>& rows, const Table& table, const std::string& group,
                       const mbd::CoordinateRef& on) {
    const Coordinate plan{is_rotational(spec.joints[static_cast<std::size_t>(on.joint.index)], on.value)};
    rows.emplace_back(table, group, plan, writer, rows.empty() ? nullptr : &rows.front());
  };
  drives_.reserve(spec.drives.size());
  couplings_.reserve(spec.couplings.size());
  forces_.reserve(spec.coordinate_forces.size());
  for (const mbd::DriveSpec& drive : spec.drives)
    add(drives_, of_drives(), "/drives/" + drive.name + "/", drive.coordinate);
  for (const mbd::CouplingSpec& coupling : spec.couplings)
    add(couplings_, of_couplings(), "/couplings/" + coupling.name + "/", coupling.output);
  for (const mbd::MechanismSpec::CoordinateForce& force : spec.coordinate_forces)
    add(forces_, of_forces(), "/joint_forces/" + force.name + "/", force.coordinate);
}

void EffortRecord::append(const mbd::Observation& observation) const {
  for (std::size_t i = 0; i < drives_.size(); ++i)
    drives_[i].append({observation.drive_efforts[i], observation.drive_powers[i]});
  for (std::size_t i = 0; i < couplings_.size(); ++i) couplings_[i].append({observation.coupling_efforts[i], 0});
  for (std::size_t i = 0; i < forces_.size(); ++i)
    forces_[i].append({observation.coordinate_force_efforts[i], observation.coordinate_force_powers[i]});
}

std::vector<QuantityGroup> EffortRecord::describe() {
  const auto group = [](const char* path, const char* heading, const Table& table) {
    QuantityGroup described{.path = path, .heading = heading, .quantities = {}};
    run::describe(table, "n", described);
    return described;
  };
  return {
      group("/drives/<d>/", "of a drive", of_drives()),
      group("/couplings/<c>/", "of a coupling of coordinates", of_couplings()),
      group("/joint_forces/<f>/",
            "of friction, speed control, springs with a function, pumps and rotating drillings, on their coordinate",
            of_forces())};
}

}  // namespace hersey::run
