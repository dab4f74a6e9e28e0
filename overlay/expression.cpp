// SPDX-License-Identifier: MIT
#include "overlay/expression.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace loft::overlay {

using Term = Expression::Term;
using Kind = Expression::Term::Kind;

namespace {

/// Whether a term is that operation of several operands, so that one more can join them.
bool is_any(const Term& term) {
  return term.kind == Kind::at_least && term.count == 1 && term.operands > 1;
}

bool is_all(const Term& term) {
  return term.kind == Kind::at_least && term.count == term.operands && term.operands > 1;
}

bool is_odd(const Term& term) { return term.kind == Kind::odd; }

bool is_none(const Term& term) { return term.kind == Kind::exactly && term.count == 0; }

}  // namespace

Expression Expression::of(std::vector<Term> terms) {
  std::size_t height = 0;  // of the stack of answers
  for (const Term& term : terms) {
    const std::size_t taken = term.kind == Kind::layer ? 0 : term.operands;
    if (taken > height) throw std::invalid_argument("expression: operands are missing");
    height = height - taken + 1;
  }
  if (height != 1) throw std::invalid_argument("expression: there is not one answer");
  Expression result;
  result.terms_ = std::move(terms);
  return result;
}

void Expression::apply(Kind kind, std::uint32_t operands, std::uint32_t count) {
  terms_.push_back({.kind = kind, .layer = {}, .operands = operands, .count = count});
}

void Expression::append(const Expression& other) {
  terms_.insert(terms_.end(), other.terms_.begin(), other.terms_.end());
}

Expression operator|(Expression a, const Expression& b) {
  const Term last = a.terms_.back();
  if (is_any(last)) a.terms_.pop_back();
  a.append(b);
  a.apply(Kind::at_least, is_any(last) ? last.operands + 1 : 2, 1);
  return a;
}

Expression operator&(Expression a, const Expression& b) {
  const Term last = a.terms_.back();
  const bool joins = is_all(last);
  if (joins) a.terms_.pop_back();
  a.append(b);
  const std::uint32_t operands = joins ? last.operands + 1 : 2;
  a.apply(Kind::at_least, operands, operands);
  return a;
}

Expression operator^(Expression a, const Expression& b) {
  const Term last = a.terms_.back();
  if (is_odd(last)) a.terms_.pop_back();
  a.append(b);
  a.apply(Kind::odd, is_odd(last) ? last.operands + 1 : 2, 0);
  return a;
}

Expression operator~(Expression a) {
  a.apply(Kind::exactly, 1, 0);
  return a;
}

Expression operator-(Expression a, const Expression& b) { return std::move(a) & ~b; }

Expression at_least(std::uint32_t count, std::span<const Expression> operands) {
  Expression result;
  result.terms_.clear();
  for (const Expression& operand : operands) result.append(operand);
  result.apply(Kind::at_least, static_cast<std::uint32_t>(operands.size()), count);
  return result;
}

Expression exactly(std::uint32_t count, std::span<const Expression> operands) {
  Expression result = at_least(count, operands);
  result.terms_.back().kind = Kind::exactly;
  return result;
}

Expression any_of(std::span<const LayerId> layers) {
  const std::vector<Expression> operands(layers.begin(), layers.end());
  return at_least(1, operands);
}

Expression all_of(std::span<const LayerId> layers) {
  const std::vector<Expression> operands(layers.begin(), layers.end());
  return at_least(static_cast<std::uint32_t>(layers.size()), operands);
}

namespace {

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '.' || (static_cast<unsigned char>(c) & 0x80) != 0;
}

std::string written_name(const std::string& name) {
  const bool is_plain = !name.empty() && std::all_of(name.begin(), name.end(), is_word) &&
                        name != "at_least" && name != "exactly";
  if (is_plain) return name;
  std::string result = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

/// An operand as text, and how strongly its outermost operation binds.
struct Written {
  std::string text;
  enum Strength { weak, minus, strong, whole } strength = whole;

  [[nodiscard]] std::string bound_by(Strength other) const {
    return strength >= other ? text : '(' + text + ')';
  }
};

std::string joined(std::span<const Written> operands, std::string_view sign,
                   Written::Strength strength) {
  std::string result;
  for (const Written& operand : operands) {
    if (!result.empty()) result += sign;
    result += operand.bound_by(strength);
  }
  return result;
}

Written written_call(const Term& term, std::span<const Written> operands) {
  const std::string name = term.kind == Kind::exactly ? "exactly(" : "at_least(";
  std::string text = name + std::to_string(term.count);
  for (const Written& operand : operands) text += ", " + operand.text;
  return {text + ')'};
}

Written written(const Term& term, std::span<const Written> operands) {
  // Equally weak signs are read from the left, so an operand that has one takes parentheses.
  if (is_any(term)) return {joined(operands, " | ", Written::minus), Written::weak};
  if (is_odd(term) && operands.size() > 1)
    return {joined(operands, " ^ ", Written::minus), Written::weak};
  if (is_all(term)) return {joined(operands, " & ", Written::whole), Written::strong};
  if (is_none(term) && operands.size() == 1)
    return {'~' + operands[0].bound_by(Written::whole), Written::whole};
  return written_call(term, operands);
}

}  // namespace

std::string to_string(const Expression& expression,
                      const std::function<std::string(LayerId)>& name_of) {
  std::vector<Written> stack;
  for (const Term& term : expression.terms()) {
    if (term.kind == Kind::layer) {
      stack.push_back({written_name(name_of(term.layer))});
      continue;
    }
    const std::size_t first = stack.size() - term.operands;
    Written whole = written(term, std::span(stack).subspan(first));
    stack.resize(first);
    stack.push_back(std::move(whole));
  }
  return stack.back().text;
}

namespace {

class ExpressionReader {
 public:
  ExpressionReader(std::string_view text,
                   const std::function<std::optional<LayerId>(std::string_view)>& find)
      : text_(text), find_(&find) {}

  Expression read() {
    Expression result = read_weak();
    if (at_ < text_.size()) fail("an operator, or the end, is expected here");
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw ExpressionError("expression, byte " + std::to_string(at_ + 1) + ": " + what, at_);
  }

  void skip_blanks() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != text_.npos) ++at_;
  }

  bool take(char c) {
    skip_blanks();
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    skip_blanks();
    return true;
  }

  Expression read_weak() {
    if (++depth_ > deepest_nesting) fail("nested too deeply");
    Expression result = read_difference();
    while (true) {
      if (take('|') || take('+'))
        result = std::move(result) | read_difference();
      else if (take('^'))
        result = std::move(result) ^ read_difference();
      else
        break;
    }
    --depth_;
    return result;
  }

  Expression read_difference() {
    Expression result = read_strong();
    while (take('-')) result = std::move(result) - read_strong();
    return result;
  }

  Expression read_strong() {
    Expression result = read_operand();
    while (take('&')) result = std::move(result) & read_operand();
    return result;
  }

  Expression read_operand() {
    std::size_t turns = 0;
    while (take('~')) ++turns;
    Expression result = read_whole();
    return turns % 2 == 0 ? result : ~std::move(result);
  }

  Expression read_whole() {
    if (take('(')) {
      Expression result = read_weak();
      if (!take(')')) fail("')' is missing here");
      return result;
    }
    skip_blanks();
    const std::size_t start = at_;
    const bool is_quoted = at_ < text_.size() && text_[at_] == '"';
    const std::string name = is_quoted ? read_quoted() : read_word();
    if (!is_quoted && (name == "at_least" || name == "exactly") && take('('))
      return read_call(name);
    const auto layer = (*find_)(name);
    if (!layer) {
      at_ = start;
      fail("there is no layer '" + name + "'");
    }
    skip_blanks();
    return *layer;
  }

  std::string read_word() {
    const std::size_t start = at_;
    while (at_ < text_.size() && is_word(text_[at_])) ++at_;
    if (at_ == start) fail("a name is expected here");
    return std::string(text_.substr(start, at_ - start));
  }

  std::string read_quoted() {
    std::string name;
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
      name += text_[at_];
    }
    if (at_ == text_.size()) fail("the closing '\"' is missing");
    ++at_;
    return name;
  }

  Expression read_call(const std::string& name) {
    std::uint32_t count = 0;
    const auto [end, error] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), count);
    if (error != std::errc()) fail("a number is expected here");
    at_ = static_cast<std::size_t>(end - text_.data());
    std::vector<Expression> operands;
    while (take(',')) operands.push_back(read_weak());
    if (!take(')')) fail("')' is missing here");
    return name == "exactly" ? exactly(count, operands) : at_least(count, operands);
  }

  std::string_view text_;
  const std::function<std::optional<LayerId>(std::string_view)>* find_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

Expression parse_expression(std::string_view text,
                            const std::function<std::optional<LayerId>(std::string_view)>& find) {
  return ExpressionReader(text, find).read();
}

}  // namespace loft::overlay
