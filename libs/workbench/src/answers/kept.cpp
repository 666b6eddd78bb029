#include "answers/kept.h"

#include <algorithm>

namespace hersey::workbench {

std::string Kept::file(const std::string& path) const {
  const std::filesystem::path relative(path);
  const bool leaves = relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end();
  if (path.empty() || leaves)
    throw Refused(403, "The path '" + path + "' is not one of the folder.", "Name a file relative to the folder.");
  return (root_ / relative).lexically_normal().string();
}

std::shared_ptr<const session::Session> Kept::session(const std::string& text, const std::string& file) {
  const std::string key = file + '\n' + text;
  {
    const std::lock_guard lock(mutex_);
    const auto known =
        std::find_if(sessions_.begin(), sessions_.end(), [&](const KeptSession& one) { return one.first == key; });
    if (known != sessions_.end()) {
      sessions_.splice(sessions_.begin(), sessions_, known);
      return sessions_.front().second;
    }
  }
  auto read = std::make_shared<const session::Session>(text, file, std::vector<std::string>{});
  const std::lock_guard lock(mutex_);
  sessions_.emplace_front(key, read);
  if (sessions_.size() > kMostSessions) sessions_.pop_back();
  return read;
}

std::string Kept::keep(study::BearingSolution solution) {
  const std::lock_guard lock(mutex_);
  std::string id = "solution_" + std::to_string(next_++);
  solutions_.emplace_front(id, std::make_shared<const study::BearingSolution>(std::move(solution)));
  if (solutions_.size() > kMostSolutions) solutions_.pop_back();
  return id;
}

std::shared_ptr<const study::BearingSolution> Kept::solution(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto known =
      std::find_if(solutions_.begin(), solutions_.end(), [&](const KeptSolution& one) { return one.first == id; });
  if (known == solutions_.end()) return nullptr;
  solutions_.splice(solutions_.begin(), solutions_, known);
  return solutions_.front().second;
}

}  // namespace hersey::workbench
