#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "answers/examples.h"
#include "answers/kept.h"
#include "answers/request.h"
#include "answers/scene.h"
#include "folder/folder.h"
#include "hersey/run/picture.h"
#include "hersey/session/starting_models.h"
#include "hersey/workbench/answers.h"

namespace hersey::workbench {
namespace {

using Path = std::filesystem::path;

struct FileCopy {
  std::string to;  ///< relative to the folder
  std::string content;
  bool is_there = false;
};

std::string bytes_of(const Path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  if (!stream) throw Refused(404, "The example's file '" + file.filename().string() + "' cannot be read.");
  return content.str();
}

/// The file of an example. @throws Refused where there is none of that name
Path file_of_example(const std::string& name) {
  const Path folder = examples_folder_of_program();
  for (const Example& example : examples_in(folder))
    if (example.name == name) return (folder / name).lexically_normal();
  throw Refused(404, "There is no example '" + name + "'.", "Choose one of the list.");
}

/// Copies an example's model to `path`, and the files that it reads to the same places beside it.
std::vector<std::string> copy_example(const std::string& name, const std::string& path, const Kept& kept) {
  const Path model = file_of_example(name), root = kept.folder();
  const session::Session read(model.string());
  std::vector<FileCopy> copies;
  for (const Path& file : read.files()) {
    const Path beside = std::filesystem::absolute(file).lexically_normal().lexically_relative(model.parent_path());
    const bool is_model = std::filesystem::equivalent(file, model);
    const std::string to = is_model ? path : (Path(path).parent_path() / beside).lexically_normal().generic_string();
    if (to.starts_with(".."))
      throw Refused(422, "The example reads '" + beside.generic_string() + "', which would lie outside the folder.",
                    "Give a name in a folder of its own: " + Path(name).generic_string() + ".");
    FileCopy copy{to, bytes_of(file)};
    const Path there = kept.file(to);
    copy.is_there = std::filesystem::exists(there) || std::filesystem::is_symlink(there);
    // A pipe would be waited for.
    const bool is_file = std::filesystem::is_regular_file(there);
    if (copy.is_there && (is_model || !is_file || bytes_of(there) != copy.content))
      throw Refused(409, "There is a file '" + to + "' already.", "Choose another name, in another folder.");
    copies.push_back(std::move(copy));
  }
  Folder folder(root);
  std::vector<std::string> written;
  try {
    for (const FileCopy& copy : copies) {
      if (copy.is_there) continue;
      std::filesystem::create_directories((root / copy.to).parent_path());
      (void)folder.create(copy.to, copy.content);
      written.push_back(copy.to);
    }
  } catch (const ChangedFile&) {
    throw Refused(409, "One of the example's files has come into being meanwhile.", "Try again.");
  } catch (const std::filesystem::filesystem_error& error) {
    throw Refused(507, error.code().message(), "The folder may be read-only, or the disk full.");
  }
  return written;
}

/// Of a bearing of several films by itself, which has nothing to draw, the machine that it stands for.
const model::Model& drawn_of(const model::Model& model) {
  const bool is_empty = model.bodies.empty() && model.bearings.empty() && !model.composites.empty();
  return is_empty && model.composites.front().alone ? *model.composites.front().alone : model;
}

std::string with_ending(const std::string& path) {
  const Path file(path);
  return file.extension() == ".yaml" || file.extension() == ".yml" ? path : path + ".yaml";
}

}  // namespace

std::string Answers::templates() const {
  Json list = Json::array();
  for (const session::StartingModel& model : session::starting_models())
    list.push_back({{"name", model.name}, {"title", session::title_of(model)}, {"text", model.text}});
  return dumped(list);
}

std::string Answers::examples() const {
  Json list = Json::array();
  for (const Example& example : examples_in(examples_folder_of_program()))
    list.push_back({{"name", example.name}, {"title", example.title}, {"text", example.text}});
  return dumped(list);
}

std::string Answers::template_scene(std::string_view request) const {
  const Json given = request_object(request);
  const std::string example = text_in(given, "example", "");
  try {
    const model::ModelFile file =
        example.empty() ? model::ModelFile(std::string(session::starting_model(text_in(given, "template")).text),
                                           (Path(kept_->folder()) / "template.yaml").string())
                        : model::ModelFile(file_of_example(example).string());
    const std::optional<model::TextMap> map = file.map();
    const model::Model model = session::Session(file, {}).model();
    if (!map) throw Refused(422, "The text is not YAML.");
    const model::Model& drawn = drawn_of(model);
    return "{\"scene\":" + scene_json(drawn, run::Picture(drawn), *map, TextColumns(file.text())) + "}";
  } catch (const InputError& error) {
    refuse(error);
  }
}

std::string Answers::new_model(std::string_view request) const {
  const Json given = request_object(request);
  const std::string example = text_in(given, "example", ""), path = with_ending(text_in(given, "path"));
  const std::filesystem::path file = kept_->file(path);
  try {
    if (!example.empty()) {
      const std::vector<std::string> files = copy_example(example, path, *kept_);
      return dumped({{"path", path}, {"files", files}});
    }
    const std::filesystem::path written = session::write_starting_model(text_in(given, "template"), file);
    return dumped({{"path", written.lexically_relative(kept_->folder()).generic_string()}});
  } catch (const session::FileExists&) {
    throw Refused(409, "There is a file '" + path + "' already.", "Choose another name.");
  } catch (const InputError& error) {
    refuse(error);
  } catch (const Refused&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw Refused(507, error.what(), "The folder may be read-only, or the disk full.");
  }
}

}  // namespace hersey::workbench
