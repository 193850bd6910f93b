#include "gcode/placeholder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <vector>

#include "base/error.hpp"
#include "gcode/expression.hpp"
#include "model/options.hpp"

namespace cleancolor {
namespace {

/// Which of {if}...{elsif}...{else}...{endif} is written.
struct Branch {
  bool outside;  // the text around it is written
  bool taken;    // one of its conditions was true
  bool active;   // its text is written
};

/// Walks through a template once.
class Filler {
 public:
  Filler(std::string_view text, std::string_view option_name, const ValueOfName& value)
      : text_(text), option_name_(option_name), value_(value) {}

  std::string filled_in() {
    std::string result;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      const bool written = branches_.empty() || branches_.back().active;
      if (c == '{') {
        const std::string_view inside = taken_until('}');
        const std::string text = statement(inside, written);
        if (written) result += text;
      } else if (c == '[') {
        const std::string_view name = taken_until(']');
        if (written) result += legacy(name);
      } else {
        if (written) result += c;
        ++at_;
      }
    }
    if (!branches_.empty()) fail("an {if ...} has no {endif}");
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + std::ptrdiff_t(std::min(at_, text_.size())), '\n');
    throw Error(fmt::format("{}: line {}: {}", option_name_, line, reason));
  }

  /// What stands between the bracket here and the closing one; texts in quotes may hold brackets.
  std::string_view taken_until(char closing) {
    bool quoted = false;
    for (std::size_t i = at_ + 1; i < text_.size(); ++i) {
      if (text_[i] == '"' && closing == '}') quoted = !quoted;
      if (quoted || text_[i] != closing) continue;
      const std::string_view inside = text_.substr(at_ + 1, i - at_ - 1);
      at_ = i + 1;
      return inside;
    }
    fail(fmt::format("'{}' is never closed by '{}'", text_[at_], closing));
  }

  std::string evaluated_text(std::string_view expression) const {
    try {
      return evaluated(expression, value_).text();
    } catch (const Error& e) {
      fail(fmt::format("{{{}}}: {}", expression, e.what()));
    }
  }

  bool evaluated_truth(std::string_view expression) const {
    try {
      return evaluated(expression, value_).truth();
    } catch (const Error& e) {
      fail(fmt::format("{{if {}}}: {}", expression, e.what()));
    }
  }

  std::string statement(std::string_view inside, bool written) {
    const auto keyword = [&](std::string_view word) {
      return inside.starts_with(word) && (inside.size() == word.size() || inside[word.size()] == ' ' ||
                                          inside[word.size()] == '(' || inside[word.size()] == '\n');
    };
    if (keyword("if")) {
      const bool holds = written && evaluated_truth(inside.substr(2));
      branches_.push_back({written, holds, holds});
      return {};
    }
    const bool middle = keyword("elsif") || keyword("else") || keyword("endif");
    if (!middle) return written ? evaluated_text(inside) : std::string();
    if (branches_.empty()) fail(fmt::format("{{{}}} without an {{if ...}} before it", inside));
    Branch& branch = branches_.back();
    if (keyword("endif")) {
      branches_.pop_back();
    } else if (branch.taken || !branch.outside) {
      branch.active = false;
    } else {
      branch.active = keyword("else") || evaluated_truth(inside.substr(5));
      branch.taken = branch.active;
    }
    return {};
  }

  /// [name], or [name_2]: of extruder 2.
  std::string legacy(std::string_view name) const {
    if (const auto text = value_(name, std::nullopt)) return *text;
    const std::size_t underscore = name.rfind('_');
    int index = 0;
    if (underscore != name.npos) {
      const char* end = name.data() + name.size();
      const auto [stop, fault] = std::from_chars(name.data() + underscore + 1, end, index);
      if (fault == std::errc() && stop == end)
        if (const auto text = value_(name.substr(0, underscore), index)) return *text;
    }
    fail(fmt::format("unknown placeholder [{}]{}", name, did_you_mean(name)));
  }

  std::string_view text_;
  std::string_view option_name_;
  const ValueOfName& value_;
  std::size_t at_ = 0;
  std::vector<Branch> branches_;
};

}  // namespace

void Placeholders::set(const std::string& name, double value) {
  texts_[name] = number_text(value);
}

void Placeholders::set(const std::string& name, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) texts_[fmt::format("{}[{}]", name, i)] = number_text(values[i]);
}

std::optional<std::string> Placeholders::value(std::string_view name, std::optional<int> index) const {
  if (const auto found = texts_.find(name); found != texts_.end()) return found->second;
  const std::string of_list = fmt::format("{}[{}]", name, index.value_or(current_extruder_));
  if (const auto found = texts_.find(of_list); found != texts_.end()) return found->second;
  const Option* option = find_option(name);
  if (option == nullptr) return std::nullopt;
  const int asked = index.value_or(current_extruder_);
  const bool there = asked >= 0 && std::size_t(asked) < config_->extruders.size();
  const std::size_t extruder = option->per_extruder() && there ? std::size_t(asked) : 0;
  return value_text(*option, option_value(*config_, *option, extruder));
}

std::string Placeholders::filled_in(std::string_view text, std::string_view option_name) const {
  const ValueOfName lookup = [this](std::string_view name, std::optional<int> index) { return value(name, index); };
  return Filler(text, option_name, lookup).filled_in();
}

}  // namespace cleancolor
