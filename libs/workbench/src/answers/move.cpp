#include "answers/kept.h"
#include "answers/request.h"
#include "answers/scene.h"
#include "hersey/run/picture.h"
#include "hersey/workbench/answers.h"

namespace hersey::workbench {

std::string Answers::move(std::string_view request) const {
  const Json given = request_object(request);
  const std::string text = text_in(given, "text"), file = kept_->file(text_in(given, "path"));
  const std::string joint = text_in(given, "joint"), coordinate = text_in(given, "coordinate", "");
  const double value = number_in(given, "value");
  const std::vector<std::string> set = texts_in(given, "set");
  try {
    std::shared_ptr<const session::Session> session = kept_->session(text, file);
    if (!set.empty()) session = std::make_shared<const session::Session>(session->with(set));
    run::Picture picture(session->model());
    const Outcome moved = picture.move(joint, coordinate, value);
    if (!moved.solved())
      throw Refused(422, moved.message,
                    "The mechanism does not reach this position: choose a value nearer to its start.");
    Json answer{{"bodies", poses_json(picture)}};
    answer["joints"] = joints_json(session->model(), picture);
    answer["residual"] = picture.residual();
    return dumped(answer);
  } catch (const InputError& error) {
    refuse(error);
  }
}

}  // namespace hersey::workbench
