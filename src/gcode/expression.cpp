#include "gcode/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "base/error.hpp"
#include "model/options.hpp"

namespace cleancolor {
namespace {

std::optional<double> as_number(std::string_view text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(text.data(), end, number);
  if (fault != std::errc() || stop != end || text.empty() || !std::isfinite(number)) return std::nullopt;
  return number;
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Recursive descent, one function per level of precedence, the loosest first.
class Parser {
 public:
  Parser(std::string_view text, const ValueOfName& value) : text_(text), value_(value) {}

  ExpressionValue all() {
    ExpressionValue v = choice();
    skip_blanks();
    if (at_ < text_.size()) fail(fmt::format("'{}' is not understood", text_.substr(at_)));
    return v;
  }

 private:
  using Value = ExpressionValue;

  [[noreturn]] static void fail(const std::string& reason) { throw Error(reason); }

  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n')) ++at_;
  }

  bool take(std::string_view token) {
    skip_blanks();
    if (!text_.substr(at_).starts_with(token)) return false;
    const std::size_t after = at_ + token.size();
    const bool word = is_letter(token.back());
    if (word && after < text_.size() && (is_letter(text_[after]) || is_digit(text_[after]))) return false;
    at_ = after;
    return true;
  }

  void expect(std::string_view token) {
    if (!take(token)) fail(fmt::format("'{}' expected", token));
  }

  Value choice() {
    Nesting deeper(*this);
    Value v = disjunction();
    if (!take("?")) return v;
    Value yes = choice();
    expect(":");
    Value no = choice();
    return v.truth() ? yes : no;
  }

  Value disjunction() {
    Value v = conjunction();
    while (take("or") || take("||")) {
      const bool right = conjunction().truth();
      v = Value(double(v.truth() || right));
    }
    return v;
  }

  Value conjunction() {
    Value v = comparison();
    while (take("and") || take("&&")) {
      const bool right = comparison().truth();
      v = Value(double(v.truth() && right));
    }
    return v;
  }

  Value comparison() {
    const Value a = sum();
    static constexpr std::string_view signs[] = {"==", "!=", "<>", "<=", ">=", "<", ">"};
    for (const std::string_view sign : signs) {
      if (!take(sign)) continue;
      const Value b = sum();
      const bool numbers = a.is_number() && b.is_number();
      const int order =
          numbers ? int(a.number() > b.number()) - int(a.number() < b.number()) : a.text().compare(b.text());
      return Value(double(sign == "=="   ? order == 0
                          : sign == "<=" ? order <= 0
                          : sign == ">=" ? order >= 0
                          : sign == "<"  ? order < 0
                          : sign == ">"  ? order > 0
                                         : order != 0));
    }
    return a;
  }

  Value sum() {
    Value v = product();
    for (;;) {
      if (take("+")) {
        const Value b = product();
        v = v.is_number() && b.is_number() ? Value(v.number() + b.number()) : Value::quoted(v.text() + b.text());
      } else if (take("-")) {
        v = Value(v.number() - product().number());
      } else {
        return v;
      }
    }
  }

  Value product() {
    Value v = factor();
    for (;;) {
      if (take("*")) {
        v = Value(v.number() * factor().number());
      } else if (take("/")) {
        v = Value(v.number() / divisor());
      } else if (take("%")) {
        v = Value(std::fmod(v.number(), divisor()));
      } else {
        return v;
      }
    }
  }

  double divisor() {
    const double d = factor().number();
    if (d == 0) fail("division by zero");
    return d;
  }

  Value factor() {
    Nesting deeper(*this);
    if (take("-")) return Value(-factor().number());
    if (take("!") || take("not")) return Value(double(!factor().truth()));
    if (take("(")) {
      Value v = choice();
      expect(")");
      return v;
    }
    if (at_ < text_.size() && text_[at_] == '"') return quoted();
    if (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) return number();
    return named();
  }

  Value quoted() {
    const std::size_t end = text_.find('"', at_ + 1);
    if (end == text_.npos) fail("a text has no closing quote");
    const std::string inside(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return Value::quoted(inside);
  }

  Value number() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) ++at_;
    const auto n = as_number(text_.substr(begin, at_ - begin));
    if (!n) fail(fmt::format("'{}' is not a number", text_.substr(begin, at_ - begin)));
    return Value(*n);
  }

  Value named() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string_view name = text_.substr(begin, at_ - begin);
    if (name.empty()) fail("a value is missing");
    if (name == "true" || name == "false") return Value(double(name == "true"));
    if (take("(")) return function(name);
    std::optional<int> index;
    if (take("[")) {
      const double asked = choice().number();
      index = int(std::clamp(asked, -1.0, 1e6));
      expect("]");
    }
    if (auto text = value_(name, index)) return Value(std::move(*text));
    fail(fmt::format("unknown placeholder '{}'{}", name, did_you_mean(name)));
  }

  Value function(std::string_view name) {
    std::vector<double> arguments;
    do {
      arguments.push_back(choice().number());
    } while (take(","));
    expect(")");
    if (name == "min" && arguments.size() == 2) return Value(std::min(arguments[0], arguments[1]));
    if (name == "max" && arguments.size() == 2) return Value(std::max(arguments[0], arguments[1]));
    if (name == "round" && arguments.size() == 1) return Value(std::round(arguments[0]));
    if (name == "int" && arguments.size() == 1) return Value(std::trunc(arguments[0]));
    fail(fmt::format("there is no function {} with {} arguments; known: min, max, round, int", name, arguments.size()));
  }

  /// Keeps a hostile template from exhausting the stack.
  struct Nesting {
    explicit Nesting(Parser& p) : parser(p) {
      if (++parser.depth_ > 200) fail("too deeply nested");
    }
    ~Nesting() { --parser.depth_; }
    Parser& parser;
  };

  std::string_view text_;
  const ValueOfName& value_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

ExpressionValue::ExpressionValue(double number) : text_(number_text(number)), number_(number) {}
ExpressionValue::ExpressionValue(std::string text) : text_(std::move(text)), number_(as_number(text_)) {}

ExpressionValue ExpressionValue::quoted(std::string text) {
  ExpressionValue v;
  v.text_ = std::move(text);
  return v;
}

double ExpressionValue::number() const {
  if (!number_) throw Error(fmt::format("\"{}\" is not a number", text_));
  return *number_;
}

bool ExpressionValue::truth() const {
  return number_ ? *number_ != 0 : !text_.empty();
}

ExpressionValue evaluated(std::string_view expression, const ValueOfName& value) {
  return Parser(expression, value).all();
}

std::string number_text(double number) {
  // What sums of decimals lose in binary (0.1 + 0.2) is not shown.
  std::string text = fmt::format("{:.6f}", number);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace cleancolor
