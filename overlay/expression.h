// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "overlay/layer.h"

namespace loft::overlay {

/// Which places belong to a result, by the layers that cover them: `(parks | woods) - lakes`.
/// A value; every operation is O(terms of its operands), `a | b` with a temporary `a` O(b).
class Expression {
 public:
  /// One step of the way from layers to the answer, operands before operations. An operation looks
  /// at how many of its operands are true.
  struct Term {
    enum class Kind : std::uint8_t {
      layer,     ///< whether that layer covers the place
      at_least,  ///< `count` of its operands or more
      exactly,   ///< `count` of its operands
      odd,       ///< an odd number of its operands
    };
    Kind kind = Kind::at_least;
    LayerId layer;               ///< of a layer
    std::uint32_t operands = 0;  ///< of an operation: how many terms before it
    std::uint32_t count = 0;

    friend bool operator==(const Term&, const Term&) = default;
  };

  /// Nowhere.
  Expression() : terms_{{.kind = Term::Kind::at_least, .layer = {}, .operands = 0, .count = 1}} {}
  /// Where a layer is.
  Expression(LayerId layer)  // NOLINT(google-explicit-constructor): a layer is an expression
      : terms_{{.kind = Term::Kind::layer, .layer = layer}} {}

  /// Of terms that were put in order by the caller. Throws std::invalid_argument unless each
  /// operation finds its operands, and one answer is left.
  [[nodiscard]] static Expression of(std::vector<Term> terms);

  friend Expression operator|(Expression a, const Expression& b);
  friend Expression operator&(Expression a, const Expression& b);
  friend Expression operator-(Expression a, const Expression& b);
  friend Expression operator^(Expression a, const Expression& b);
  friend Expression operator~(Expression a);

  /// Where `count` or more of them are; where exactly as many are.
  friend Expression at_least(std::uint32_t count, std::span<const Expression> operands);
  friend Expression exactly(std::uint32_t count, std::span<const Expression> operands);

  /// Never empty.
  [[nodiscard]] std::span<const Term> terms() const { return terms_; }

  friend bool operator==(const Expression&, const Expression&) = default;

 private:
  void apply(Term::Kind kind, std::uint32_t operands, std::uint32_t count);
  void append(const Expression& other);

  std::vector<Term> terms_;
};

Expression operator|(Expression a, const Expression& b);
Expression operator&(Expression a, const Expression& b);
/// What is in a and not in b.
Expression operator-(Expression a, const Expression& b);
/// What is in one of them.
Expression operator^(Expression a, const Expression& b);
Expression operator~(Expression a);
Expression at_least(std::uint32_t count, std::span<const Expression> operands);
Expression exactly(std::uint32_t count, std::span<const Expression> operands);
/// Where any of them is; where all are.
[[nodiscard]] Expression any_of(std::span<const LayerId> layers);
[[nodiscard]] Expression all_of(std::span<const LayerId> layers);

/// As parse_expression() reads it, with the parentheses that it needs.
[[nodiscard]] std::string to_string(const Expression& expression,
                                    const std::function<std::string(LayerId)>& name_of);

/// What an expression should be and is not: `at`, in bytes of the text, is where.
class ExpressionError : public std::invalid_argument {
 public:
  ExpressionError(const std::string& message, std::size_t at)
      : std::invalid_argument(message), at_(at) {}
  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  std::size_t at_;
};

/// Reads an expression. Names are letters, digits, `_` and `.`, or anything in double quotes, in
/// which \" and \\ stand for " and \. From weak to strong: `|` `^` (as weak, from left to right),
/// then `-`, then `&`, then `~`; besides `at_least(2, a, b, c)`, `exactly(1, a, b)` and
/// parentheses. `+` is `|`. Throws ExpressionError: what is not understood, a name that is no
/// layer, more than `deepest_nesting` parentheses.
[[nodiscard]] Expression parse_expression(
    std::string_view text, const std::function<std::optional<LayerId>(std::string_view)>& find);

inline constexpr int deepest_nesting = 500;

}  // namespace loft::overlay
