#include "mesh/nastran_sets.h"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/mesh_text.h"

namespace hersey::fem {
namespace {

/// A range that others may cut pieces out of.
class OpenRange {
 public:
  explicit OpenRange(LabelRange range) : range_(range) {}

  [[nodiscard]] bool holds(long label) const { return label >= range_.first && label <= range_.last; }
  void leave_out(long first, long last) { out_.emplace_back(first, last); }

  void write(std::vector<LabelRange>& labels) {
    std::sort(out_.begin(), out_.end());
    long next = range_.first;
    for (const auto& [first, last] : out_) {
      if (first > next) labels.push_back({next, first - 1, 1});
      if (last >= range_.last) return;
      next = std::max(next, last + 1);
    }
    labels.push_back({next, range_.last, 1});
  }

 private:
  LabelRange range_;
  std::vector<std::pair<long, long>> out_;
};

class Words {
 public:
  explicit Words(const std::vector<std::string_view>& words) : words_(words) {}

  NastranSetWords read() {
    while (at_ < words_.size() && result_.fault.empty() && !result_.other) {
      LabelRange range;
      if (take_range(range)) take_members(range);
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is(std::size_t index, const char* word) const {
    return index < words_.size() && equal_ignoring_case(words_[index], word);
  }

  // "4" or "4 THRU 9".
  bool take_range(LabelRange& range) {
    if (!parse_integer(words_[at_], range.first)) {
      result_.other = std::string(words_[at_].substr(0, 20));
      return false;
    }
    range.last = range.first;
    if (is(at_ + 1, "THRU") && at_ + 2 < words_.size()) {
      if (!parse_integer(words_[at_ + 2], range.last)) {
        result_.other = std::string(words_[at_ + 2].substr(0, 20));
        return false;
      }
      at_ += 2;
    }
    ++at_;
    if (range.first >= 0 && range.last >= range.first) return true;
    result_.fault = fmt::format("the range {} THRU {}", range.first, range.last);
    return false;
  }

  void take_members(const LabelRange& range) {
    OpenRange open(range);
    if (is(at_, "EXCEPT")) {
      ++at_;
      LabelRange out;
      while (at_ < words_.size()) {
        const std::size_t before = at_;
        if (!take_range(out)) return;
        if (!open.holds(out.first)) {
          at_ = before;  // behind the range, numbers are members again
          break;
        }
        open.leave_out(out.first, out.last);
      }
    }
    open.write(result_.labels);
  }

  const std::vector<std::string_view>& words_;
  std::size_t at_ = 0;
  NastranSetWords result_;
};

}  // namespace

NastranSetWords read_set_words(const std::vector<std::string_view>& words) { return Words(words).read(); }

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find_first_of(", \t"), line.size());
    if (end > 0) words.push_back(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return words;
}

bool is_begin_bulk(std::string_view line) {
  const std::string word = upper(trimmed(trimmed(line.substr(0, line.find('$'))).substr(0, 20)));
  const bool is_of_another = word.find("SUPER") != std::string::npos || word.find("AUXM") != std::string::npos;
  if (!word.starts_with("BEGIN") || is_of_another) return false;
  const std::string_view what = trimmed(std::string_view(word).substr(5));
  return what.starts_with("BULK") || std::string_view("BULK").starts_with(what);
}

}  // namespace hersey::fem
