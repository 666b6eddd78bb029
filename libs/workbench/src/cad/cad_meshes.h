#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "folder/folder.h"
#include "runs/process.h"

namespace hersey::workbench {

/// What is asked of a mesh of a CAD file, as `hersey mesh` takes it.
struct CadRequest {
  std::string path;              ///< of the CAD file, relative to the folder
  std::string output;            ///< of the mesh, likewise; empty: beside it, with the ending .msh
  std::string size;              ///< of the elements, "4 mm"
  int order = 2, around = 16;    ///< of the elements, 1 or 2; how many of them a full circle has
  std::string length_unit = {};  ///< of a BREP file
};

/// How far a mesh is.
struct CadState {
  enum class At { running, made, failed };
  At at = At::running;
  double seconds = 0;  ///< since it was started
  std::string output;  ///< relative to the folder
  std::string message = {};
};

/// Meshes of CAD files, made by `hersey mesh` in processes of their own, which call the program gmsh.
/// @verified_by cad_meshes_test.cpp
class CadMeshes {
 public:
  /// @param program  `hersey`
  CadMeshes(const Folder& folder, std::filesystem::path program);
  CadMeshes(const CadMeshes&) = delete;
  CadMeshes& operator=(const CadMeshes&) = delete;
  /// Stops those that are being made.
  ~CadMeshes();

  /// Starts one. @returns its name @throws Refused for a file that is no CAD file or not there, an unknown order of
  /// elements, or an output that exists or is being made
  std::string start(const CadRequest& request);
  /// @throws Refused 404 for an unknown name
  [[nodiscard]] CadState state(const std::string& name);
  void stop(const std::string& name);

 private:
  struct Job {
    ProcessId process;
    std::filesystem::path file, output, log;
    std::string output_name;
    std::chrono::steady_clock::time_point began, asked_to_stop;
    bool is_stopped = false;
  };
  static void ask_to_stop(Job& job);
  [[nodiscard]] Job& job(const std::string& name);

  const Folder& folder_;
  std::filesystem::path program_, logs_;
  std::mutex mutex_;
  std::map<std::string, Job> jobs_;
  int next_ = 1;
};

}  // namespace hersey::workbench
