// Replication as in the quick reference guide of MSC Nastran (2012), "Format of bulk data entries".
#include "mesh/nastran_replication.h"

#include <fmt/format.h>

#include "mesh/mesh_text.h"

namespace hersey::fem {
namespace {

constexpr std::size_t kOneLine = 8;
constexpr long kMostRepeated = 1'000'000;  // of a file; more is no mesh

/// "(3)" or "3".
std::string_view without_brackets(std::string_view text) {
  if (text.size() > 2 && text.front() == '(' && text.back() == ')') text = text.substr(1, text.size() - 2);
  return trimmed(text);
}

bool added(const std::string& written, std::string_view step, std::string& sum) {
  const std::string value = written.empty() ? "0" : written;  // as an empty field counts
  long whole = 0, whole_step = 0;
  if (parse_integer(value, whole) && parse_integer(step, whole_step)) {
    if (__builtin_add_overflow(whole, whole_step, &whole)) return false;
    sum = fmt::format("{}", whole);
    return true;
  }
  double number = 0, number_step = 0;
  if (!parse_number(value, number) || !parse_number(step, number_step)) return false;
  sum = fmt::format("{}", number + number_step);
  return true;
}

void note(NastranCard& card, const char* mistake) {
  if (!card.mistake.empty()) return;
  card.mistake = mistake;
  card.line_of_mistake = card.line;
}

}  // namespace

bool NastranReplication::is_written_so(const NastranCard& card) { return card.name.starts_with('='); }

void NastranReplication::replace(NastranCard& card, std::deque<std::string>& storage) {
  left_ = 0;
  if (fields_.empty()) {
    note(card, "a replication of no entry");
    steps_.clear();
    return;
  }
  long times = 0;
  const std::string_view count = without_brackets(std::string_view(card.name).substr(1));
  if (!count.empty() && count != "=") {
    if (!parse_integer(count, times) || times < 1 || made_ + times > kMostRepeated || steps_.empty()) {
      note(card, "a replication without its count, or of no step");
      steps_.clear();
      return;
    }
    line_ = card.line;
    left_ = times - 1;
    made_ += times;
    return step(card, storage);
  }
  if (fields_.size() > kOneLine || card.fields.size() > kOneLine)
    note(card, "a replication of an entry of several lines");
  steps_.assign(fields_.size(), "");
  bool is_rest_the_same = card.name == "==";
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const std::string_view given = card.field(k);
    is_rest_the_same = is_rest_the_same || given == "==";
    steps_[k] = is_rest_the_same ? "=" : std::string(given);
  }
  step(card, storage);
}

void NastranReplication::step(NastranCard& card, std::deque<std::string>& storage) {
  card.name = name_;
  card.fields.clear();
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    const std::string& how = steps_[k];
    std::string value = how;
    if (how == "=")
      value = fields_[k];
    else if (how.starts_with('*') && !added(fields_[k], without_brackets(std::string_view(how).substr(1)), value))
      note(card, "a replication that adds to what is no number");
    card.fields.push_back(storage.emplace_back(std::move(value)));
  }
}

bool NastranReplication::repeat(NastranCard& card, std::deque<std::string>& storage) {
  if (left_ == 0) return false;
  --left_;
  card.line = line_;
  step(card, storage);
  return true;
}

void NastranReplication::keep(const NastranCard& card, bool is_written_so) {
  if (!is_written_so) steps_.clear();  // a count behind it repeats nothing
  name_ = card.name;
  fields_.assign(card.fields.begin(), card.fields.end());
}

}  // namespace hersey::fem
