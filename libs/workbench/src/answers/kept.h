#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/recently_used.h"
#include "hersey/session/session.h"
#include "hersey/study/bearing_study.h"
#include "hersey/workbench/refused.h"

namespace hersey::workbench {

/// What is kept from one answer to the next.
class Kept {
 public:
  /// @param root  where paths start
  explicit Kept(const std::filesystem::path& root) : root_(std::filesystem::absolute(root).lexically_normal()) {
    if (!root_.has_filename()) root_ = root_.parent_path();  // "folder/"
  }

  [[nodiscard]] std::string folder() const { return root_.string(); }
  /// The file that a request names. @throws Refused with the status 403 for one outside the folder
  [[nodiscard]] std::string file(const std::string& path) const;

  /// The model of a text, read anew only where a table or mesh that it names has changed. @throws InputError
  [[nodiscard]] std::shared_ptr<const session::Session> session(const std::string& text, const std::string& file);

  /// As `session`; null where the text has not been read yet, or a table or mesh has changed since.
  [[nodiscard]] std::shared_ptr<const session::Session> known_session(const std::string& text, const std::string& file);
  /// Reads the model of a text that has been opened, and keeps it. @throws InputError
  std::shared_ptr<const session::Session> read_session(const model::ModelFile& source);

  /// Keeps a solution. @returns its name
  std::string keep(study::BearingSolution solution);
  /// A kept solution; null if it is no longer known.
  [[nodiscard]] std::shared_ptr<const study::BearingSolution> solution(const std::string& id);

  study::BearingSolver solver;  ///< knows compliances of bodies

 private:
  static constexpr std::size_t kMostSessions = 4;
  static constexpr std::size_t kMostSolutions = 32;

  /// By what a change of a file is noticed; neither where it cannot be asked.
  struct Stamp {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;

    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  struct KeptSession {
    std::shared_ptr<const session::Session> session;
    std::vector<Stamp> stamps;
  };

  static std::vector<Stamp> stamps_of(const session::Session& session);

  std::filesystem::path root_;
  std::mutex mutex_;
  RecentlyUsed<KeptSession> sessions_{kMostSessions};
  RecentlyUsed<study::BearingSolution> solutions_{kMostSolutions};
  std::size_t next_ = 1;
};

}  // namespace hersey::workbench
