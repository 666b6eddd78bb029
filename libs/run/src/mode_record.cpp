// What the results file keeps of small motions.
#include "recorder.h"

namespace hersey::run {

void Recorder::declare_modes() {
  // Modes are no instants: a group called fields counts its rows by itself.
  const std::string path = "/modes/fields/";
  const auto series = [&](const char* name, const char* unit, const char* description, int columns = 1,
                          std::string_view dimension = {}) {
    return writer_.series(path + name, columns, unit, description, results::Precision::float64, dimension);
  };
  const auto nv = static_cast<int>(machine_.mechanism->nv());
  const std::string coordinate = path + "coordinate", body = path + "body_component";
  modes_ = {
      .frequency = series("frequency", "Hz", "natural frequency |s|/(2 pi), one row per mode"),
      .damped_frequency = series("damped_frequency", "Hz", "frequency of the damped motion, Im s/(2 pi)"),
      .damping_ratio = series("damping_ratio", "1", "-Re s/|s|; negative: the motion grows"),
      .real = series("eigenvalue_real", "1/s", "real part of the eigenvalue s"),
      .imaginary = series("eigenvalue_imaginary", "1/s", "imaginary part of the eigenvalue s"),
      .shape_real = series("shape_real", "1", "mode shape, real part: increments of the coordinates", nv, coordinate),
      .shape_imaginary = series("shape_imaginary", "1", "mode shape, imaginary part", nv, coordinate),
      .body_real = series("body_real", "1", "mode shape, real part: small rotation and displacement of each body",
                          6 * static_cast<int>(bodies_.size()), body),
      .body_imaginary =
          series("body_imaginary", "1", "the same, imaginary part", 6 * static_cast<int>(bodies_.size()), body)};
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(nv));
  for (int k = 0; k < nv; ++k) names.push_back(machine_.mechanism->name_of_row(k));
  writer_.attribute("/modes", "coordinates", names);
  const std::vector<mbd::BodySpec>& all = machine_.mechanism->spec().bodies;
  std::vector<std::string> bodies;
  bodies.reserve(all.size());
  for (std::size_t i = 1; i < all.size(); ++i) bodies.push_back(all[i].name);
  writer_.attribute("/modes", "bodies", bodies);
  declare_flexible_modes();
  declare_beam_modes();
}

// Rotation and displacement of every body for small increments of the coordinates: what a velocity would give.
Eigen::VectorXd Recorder::body_increments(const solver::State& state, const Eigen::VectorXd& shape) const {
  solver::State moving = state;
  moving.v = shape;
  const std::vector<mbd::FrameId>& frames = machine_.mechanism->spec().body_frames;
  Eigen::VectorXd all(6 * static_cast<Eigen::Index>(bodies_.size()));
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const mbd::FrameMotion motion = machine_.mechanism->frame_motion(moving, frames[i + 1]);
    all.segment<6>(6 * static_cast<Eigen::Index>(i)) << motion.omega, motion.v;
  }
  return all;
}

void Recorder::write_modes(const solver::State& state, const solver::Modes& found) {
  for (const solver::Mode& mode : found.modes) {
    modes_.frequency.append(mode.frequency);
    modes_.damped_frequency.append(mode.damped_frequency);
    modes_.damping_ratio.append(mode.damping_ratio);
    modes_.real.append(mode.s.real());
    modes_.imaginary.append(mode.s.imag());
    modes_.shape_real.append(Eigen::VectorXd(mode.shape.real()));
    modes_.shape_imaginary.append(Eigen::VectorXd(mode.shape.imag()));
    modes_.body_real.append(body_increments(state, mode.shape.real()));
    modes_.body_imaginary.append(body_increments(state, mode.shape.imag()));
    write_flexible_mode(state, mode.shape);
    write_beam_mode(state, mode.shape);
  }
  writer_.attribute("/modes", "stable", found.stable ? 1 : 0);
}

}  // namespace hersey::run
