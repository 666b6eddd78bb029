#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hersey/model/model.h"

namespace hersey::cli {

struct RunArguments {
  std::string model;
  std::vector<std::string> overrides;
  std::filesystem::path output;  ///< empty: results/<name of the model>
  bool force = false;
  bool resume = false;
  bool json = false;
  bool step_error = false;
  bool all = false;              ///< print every figure, however many
  bool timing = false;           ///< print where the computing time went
  int jobs = 0;                  ///< 0: one per thread
  int threads = 0;               ///< 0: one per processor
  std::filesystem::path events;  ///< file to append lines of JSON to while the run goes on; empty: none
};

/// `hersey run`: simulates a model, or every run of its study, writes results and report, prints the closing table.
/// @returns an ExitCode. @throws InputError, results::FileError.
[[nodiscard]] int run_command(const RunArguments& arguments);

/// Of `hersey export` with --loads.
struct LoadsArguments {
  std::string format;                 ///< calculix, nastran or vtkhdf; empty: no loads are asked for
  std::string body;                   ///< empty: the only one with a mesh and a film
  std::vector<std::string> bearings;  ///< empty: all on the body
  std::vector<std::string> instants;  ///< times or crank angles, or `all`; empty: the last cycle
  std::filesystem::path output;       ///< folder
  std::string units = "mm";           ///< or si
  std::vector<std::string> hold;      ///< as SolidArguments::hold
  std::string mesh, length_unit = "m", youngs_modulus, poisson_ratio, density;  ///< of a body that is rigid in the run
  std::string conductivity, expansion, reference_temperature;  ///< of a warm body; empty: as the model says
  std::vector<std::string> temperature, cooling;               ///< as SolidArguments have them
  std::string model_file;                                      ///< where it lies now; empty: as the results say
};

struct OpenArguments {
  std::filesystem::path path;  ///< a model or a folder; empty: the present one
  int port = 0;                ///< 0: the first free one
  bool no_browser = false;
  std::filesystem::path program;  ///< argv[0]
};

/// `hersey open`: serves the workbench of a folder on the loopback address until Ctrl-C.
/// @returns an ExitCode. @throws InputError; std::runtime_error if the port is taken
[[nodiscard]] int open_command(const OpenArguments& arguments);

struct ExportArguments {
  std::string file;  ///< a model; with --loads, --films or --netcdf results
  std::vector<std::string> overrides;
  std::filesystem::path fmu, ssp;
  int fmi = 2;                   ///< version of the standard
  LoadsArguments loads;          ///< its bearings and instants also of films
  std::filesystem::path films;   ///< .vtkhdf file of the films; empty: it is not asked for
  std::string surface;           ///< where the films lie: machine (empty), bearing or unwrapped
  std::filesystem::path netcdf;  ///< copy of results as netCDF; empty: it is not asked for
  bool force = false;
  bool json = false;
};

/// `hersey export`: becomes the program that packs a model into an FMU, or writes results of a run for other programs:
/// loads on a mesh, films over time, or all of them as netCDF. @returns an ExitCode. @throws InputError,
/// results::ReadError; std::runtime_error where a file cannot be written
[[nodiscard]] int export_command(const ExportArguments& arguments);

/// `hersey export --loads`.
[[nodiscard]] int loads_command(const ExportArguments& arguments);

/// `hersey export --films`.
[[nodiscard]] int films_command(const ExportArguments& arguments);

/// `hersey export --netcdf`.
[[nodiscard]] int netcdf_command(const ExportArguments& arguments);

struct CheckArguments {
  std::string model;
  std::vector<std::string> overrides;
  bool json = false;
  bool expanded = false;  ///< print the model with templates and parameters applied, and check nothing else
};

/// `hersey check`: finds every fault that can be found without simulating.
/// @returns an ExitCode.
[[nodiscard]] int check_command(const CheckArguments& arguments);

struct ReportArguments {
  std::vector<std::filesystem::path> results;
  std::filesystem::path output;    ///< empty: report.html in the folder of the first results file
  std::vector<std::string> names;  ///< of the runs; empty: by their files and folders
  bool json = false;
  bool all = false;  ///< print every figure, however many
};

struct FilmArguments {
  std::filesystem::path results;
  std::string bearing;
  std::filesystem::path output;
};

/// `hersey film`: the latest stored fields of a bearing's film as JSON, for programs that show a run while it goes on.
/// @returns an ExitCode
[[nodiscard]] int film_command(const FilmArguments& arguments);

/// `hersey report`: the HTML report of one results file, or of several as a study. @returns an ExitCode.
[[nodiscard]] int report_command(const ReportArguments& arguments);

struct BearingArguments {
  std::string model;
  std::vector<std::string> overrides;
  std::string bearing;                                                                       ///< empty: the only one
  std::string speed, shell_speed, load, load_angle, eccentricity_ratio, eccentricity_angle;  ///< empty: the file's
  std::string whirl_ratios;  ///< separated by commas, at which pads follow; empty: the file's
  std::vector<std::string> sweeps;
  std::filesystem::path csv, fields, vtu, report;  ///< files to write; empty: none
  std::string text;                                ///< file with a text in place of the model's; empty: none
  std::filesystem::path coefficients;              ///< likewise, a table of stiffness and damping over the speed
  std::string coefficients_for = "hersey";         ///< the program it is for: or ross, ansys
  bool json = false;
  bool no_grid_error = false;
  bool timing = false;                          ///< print where the computing time went
  bool sensitivity = false;                     ///< of every figure to the usual parameters
  std::vector<std::string> sensitivity_to;      ///< to these key paths
  std::string thermal_coefficients = "frozen";  ///< or total
  int jobs = 0;                                 ///< 0: one per thread
  int threads = 0;                              ///< 0: one per processor
};

/// `hersey bearing`: equilibrium or load of a single bearing, once or over sweeps.
/// @returns an ExitCode.
[[nodiscard]] int bearing_command(const BearingArguments& arguments);

struct RotorArguments {
  std::string model;
  std::vector<std::string> overrides;
  std::vector<std::string> sweeps;
  std::vector<std::string> stations;      ///< frames of the shaft whose motion is wanted; empty: those of its bearings
  std::string operating;                  ///< speed in service, or `low:high`; empty: none
  std::string cross_coupling;             ///< `station=Q`; empty: none
  std::string stiffness_map;              ///< `low:high`; empty: none
  std::filesystem::path results, report;  ///< files to write; empty: none
  bool json = false;
  int threads = 0;  ///< 0: one per processor
};

/// `hersey rotor`: modes, unbalance response and critical speeds of a shaft on its bearings, over its speeds.
/// @returns an ExitCode.
[[nodiscard]] int rotor_command(const RotorArguments& arguments);

struct OrbitsArguments {
  std::string model;
  std::vector<std::string> overrides;
  std::string along;    ///< `name=from:to`, a parameter or key path and its range
  std::string observe;  ///< quantities, separated by commas; empty: the usual ones
  double step = 0.05;   ///< largest, as a share of the range
  int most = 200;       ///< orbits
  double tolerance = 1e-4;
  int multipliers = 2;
  std::filesystem::path results, report;  ///< files to write; empty: none
  bool json = false;
  int threads = 0;  ///< 0: one per processor
};

/// `hersey orbits`: periodic motions of a machine over a parameter, stable or not, and where they change.
/// @returns an ExitCode.
[[nodiscard]] int orbits_command(const OrbitsArguments& arguments);

struct MeshArguments {
  std::string file;                  ///< a mesh or a CAD file
  std::string length_unit;           ///< empty: of a mesh m, of a BREP file mm
  std::string density;               ///< for the mass; empty: the file's
  std::string part;                  ///< of an Abaqus file with several
  std::string parts = "one";         ///< or apart
  std::filesystem::path vtu;         ///< file to write for ParaView; empty: none
  std::filesystem::path output;      ///< mesh to write; empty: beside a CAD file, else none
  std::string size;                  ///< of elements made of a CAD file
  int order = 2;                     ///< of these
  int around = 16;                   ///< least number of elements around a full circle
  std::string time_limit = "30min";  ///< of gmsh
  bool force = false;
  bool json = false;
};

/// `hersey mesh`: describes a mesh file, the quality of its elements, its planes and cylinders; for a CAD file it makes
/// the mesh first.
/// @returns an ExitCode; kWrongInput for a mesh that is unfit for computing.
/// @throws InputError; std::runtime_error if gmsh makes no mesh or it cannot be written.
[[nodiscard]] int mesh_command(const MeshArguments& arguments);

struct ReduceArguments {
  std::string file;
  std::string length_unit = "m";
  std::string part;                                    ///< of an Abaqus file with several
  std::string parts = "one";                           ///< or apart
  std::vector<std::string> frames;                     ///< "name=set:connection"
  std::string youngs_modulus, poisson_ratio, density;  ///< empty: the mesh file's
  std::string orthotropic;                             ///< nine constants in place of the first two
  std::filesystem::path stiffness, mass;               ///< matrices of another program; empty: ours
  int modes = 20;
  std::string highest;             ///< frequency; empty: none
  std::vector<std::string> loads;  ///< surfaces that carry load
  int harmonics = 4;               ///< of the pressures around a bore
  std::string static_error;        ///< share or percent; empty: printed only
  std::filesystem::path output;
  bool force = false;
};

/// `hersey reduce`: an elastic body in few coordinates, from a mesh, as a file. @returns an ExitCode.
/// @throws InputError; std::runtime_error where the body cannot be reduced or the file not be written.
[[nodiscard]] int reduce_command(const ReduceArguments& arguments);
/// A body of a single mesh; constants that the mesh file gives may be left empty.
struct SolidArguments {
  std::string file;
  std::string length_unit = "m";
  std::string part;           ///< of an Abaqus file with several
  std::string parts = "one";  ///< or apart
  std::string young, poisson, orthotropic, density;
  std::vector<std::string> hold;                 ///< sets that do not move: SET, or SET:xz for some directions only
  std::vector<std::string> pressure;             ///< SURFACE=20MPa
  std::string gravity;                           ///< "0,0,-9.81", in m/s^2; empty: none
  std::vector<std::string> temperature;          ///< SET=80degC, or one value for all of the body
  std::vector<std::string> cooling;              ///< SURFACE=80W/m^2/K:20degC
  std::vector<std::string> heat;                 ///< SURFACE=500W
  std::string conductivity, expansion;           ///< needed by these
  std::string reference_temperature = "20degC";  ///< at which the mesh has its shape
  int count = 10;                                ///< natural modes
  std::filesystem::path vtu;                     ///< file to write for ParaView; empty: none
  std::filesystem::path vtkhdf;                  ///< the same of stresses over a run
  std::string body;                              ///< of results: whose stresses; empty: the only flexible one
  std::vector<std::string> instants;             ///< of results: times or crank angles, or `all`; empty: the largest
  int largest = 5;                               ///< instants of largest stress
  std::string model_file;                        ///< of results: where it lies now; empty: as they say
  bool force = false;
  bool json = false;
};

/// `hersey modes`: natural frequencies and shapes, free or supported.
/// @returns an ExitCode.
/// @throws InputError.
[[nodiscard]] int modes_command(const SolidArguments& arguments);

/// `hersey stress`: displacements and stresses under pressures, gravity and temperature, or those of a flexible body
/// over a run. @returns an ExitCode. @throws InputError, results::ReadError.
[[nodiscard]] int stress_command(const SolidArguments& arguments);

/// `hersey stress` of a results file.
[[nodiscard]] int run_stress_command(const SolidArguments& arguments);

struct OilArguments {
  std::string oil;                       ///< a grade, or a model file
  std::vector<std::string> overrides;    ///< of the model
  std::string lubricant;                 ///< of several in the model
  std::vector<std::string> at;           ///< temperatures; empty: 0 to 160 degC
  std::vector<std::string> pressures;    ///< above that of cavitation; empty: 0, and 100 MPa where it matters
  std::vector<std::string> shear_rates;  ///< empty: at rest, and up to 1e7 1/s where they matter
  std::filesystem::path report;          ///< HTML file; empty: none
  bool json = false;
};

/// `hersey oil`: viscosity and density of a grade, or of a model's lubricant, over temperature, pressure and shear
/// rate.
/// @returns an ExitCode. @throws InputError, results::WriteError.
[[nodiscard]] int oil_command(const OilArguments& arguments);

/// Prints warnings about a model that can be computed but is implausible, one a line on stderr.
void warn(const std::vector<Fault>& warnings);

struct InitArguments {
  std::string model;  ///< name of the model; empty: the available ones are listed
  std::string name;   ///< of the file to write; empty: as the model
};

/// `hersey init`: writes a commented model to begin with. @returns an ExitCode. @throws InputError for a model that
/// there is not and for a file that exists; std::runtime_error where it cannot be written.
[[nodiscard]] int init_command(const InitArguments& arguments);

struct ConvertArguments {
  std::filesystem::path model;
  std::filesystem::path output;  ///< empty: standard output, unless in_place
  bool in_place = false;
};

/// `hersey convert`: converts a model file of an earlier version.
/// @returns an ExitCode.
/// @throws InputError with the faults of the written file; std::runtime_error if it cannot be written.
[[nodiscard]] int convert_command(const ConvertArguments& arguments);

/// `hersey recipes`: prints a recipe, or the list of all, as text or as JSON.
/// @param name  empty: the list
/// @returns an ExitCode. @throws InputError for an unknown name.
[[nodiscard]] int recipes_command(const std::string& name, bool as_json);

/// `hersey explain`: prints the description of a key of the model file, from the format itself.
/// @param path  empty: the sections
/// @returns an ExitCode.
/// @throws InputError.
[[nodiscard]] int explain_command(const std::string& path);

/// What `hersey schema` prints.
struct SchemaArguments {
  bool of_results = false;     ///< the format of results files in place of the model file's
  bool of_quantities = false;  ///< the reference page of a bearing's quantities
  bool markdown = false;       ///< as a page of the documentation
};

/// `hersey schema`: the model file's format, that of results files, or the quantities of a bearing.
/// @returns an ExitCode.
[[nodiscard]] int schema_command(const SchemaArguments& arguments);

}  // namespace hersey::cli
