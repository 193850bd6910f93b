// gcode/expression.hpp
//
// Expressions in braces in G-code templates: {max(temperature[0], 200) + 5}.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace cleancolor {

/// Text of a named value; index where the expression gives one. nullopt: no such name.
using ValueOfName = std::function<std::optional<std::string>(std::string_view name, std::optional<int> index)>;

/// A number or a text; a number that came from a text keeps its spelling.
class ExpressionValue {
 public:
  explicit ExpressionValue(double number);
  explicit ExpressionValue(std::string text);  // a number where all of it reads as one
  static ExpressionValue quoted(std::string text);

  const std::string& text() const { return text_; }
  bool is_number() const { return number_.has_value(); }
  double number() const;  // throws Error where it is a text
  bool truth() const;     // not 0; of texts: not empty

 private:
  ExpressionValue() = default;
  std::string text_;
  std::optional<double> number_;
};

/// Throws Error with the reason: unknown name, what was expected where, a text where a number is needed, division by 0.
ExpressionValue evaluated(std::string_view expression, const ValueOfName& value);

/// Shortest text of a number: "215", "0.35".
std::string number_text(double number);

}  // namespace cleancolor
