// SPDX-License-Identifier: MIT
#include "overlay/expression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "overlay/expression_difference.h"
#include "overlay/formula.h"

namespace loft::overlay {
namespace {

const std::vector<std::string> names{"a", "b", "c", "town hall", "d\"\\"};

std::optional<LayerId> find(std::string_view name) {
  const auto at = std::ranges::find(names, name);
  if (at == names.end()) return std::nullopt;
  return LayerId(static_cast<std::uint32_t>(at - names.begin()));
}

std::string name_of(LayerId layer) { return names[layer.index()]; }

Expression parsed(std::string_view text) { return parse_expression(text, find); }

/// What an expression says, term by term.
bool answer(const Expression& expression, unsigned cover) {
  using Kind = Expression::Term::Kind;
  std::vector<bool> stack;
  for (const Expression::Term& term : expression.terms()) {
    if (term.kind == Kind::layer) {
      stack.push_back((cover >> term.layer.index() & 1) != 0);
      continue;
    }
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < term.operands; ++i) {
      count += stack.back() ? 1U : 0U;
      stack.pop_back();
    }
    stack.push_back(term.kind == Kind::odd        ? count % 2 != 0
                    : term.kind == Kind::at_least ? count >= term.count
                                                  : count == term.count);
  }
  return stack.back();
}

std::vector<LayerId> layers_of(unsigned cover) {
  std::vector<LayerId> layers;
  for (std::uint32_t i = 0; i < 5; ++i)
    if ((cover >> i & 1) != 0) layers.emplace_back(i);
  return layers;
}

Expression random_expression(std::mt19937_64& random, int depth) {
  if (depth == 0 || random() % 5 == 0) return LayerId(static_cast<std::uint32_t>(random() % 5));
  const auto operand = [&] { return random_expression(random, depth - 1); };
  switch (random() % 7) {
    case 0:
      return operand() | operand();
    case 1:
      return operand() & operand();
    case 2:
      return operand() - operand();
    case 3:
      return operand() ^ operand();
    case 4:
      return ~operand();
    case 5:
      return at_least(static_cast<std::uint32_t>(random() % 4),
                      std::vector{operand(), operand(), operand()});
    default:
      return exactly(static_cast<std::uint32_t>(random() % 3), std::vector{operand(), operand()});
  }
}

TEST(Expression, SaysOfEachCoverWhatItsTermsSay) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Expression expression = random_expression(random, 4);
    Formula formula(expression);
    ASSERT_EQ(formula.is_true_outside(), answer(expression, 0));
    for (unsigned cover = 0; cover < 32; ++cover)
      ASSERT_EQ(formula.is_true(layers_of(cover)), answer(expression, cover)) << cover;
  }
}

TEST(Expression, ReadsWhatItWrites) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Expression expression = random_expression(random, 4);
    const std::string text = to_string(expression, name_of);
    const Expression again = parsed(text);
    for (unsigned cover = 0; cover < 32; ++cover)
      ASSERT_EQ(answer(again, cover), answer(expression, cover)) << text << ", cover " << cover;
    const std::string settled = to_string(again, name_of);
    EXPECT_EQ(to_string(parsed(settled), name_of), settled);
  }
}

TEST(Expression, BindsAsItsHeaderSays) {
  const Expression a = LayerId(0);
  const Expression b = LayerId(1);
  const Expression c = LayerId(2);
  EXPECT_EQ(parsed("(a|b) - c"), (a | b) - c);
  EXPECT_EQ(parsed("a | b - c"), a | (b - c));
  EXPECT_EQ(parsed("a - b & c"), a - (b & c));
  EXPECT_EQ(parsed("a & ~b"), a - b);
  EXPECT_EQ(parsed("~~a"), a);
  EXPECT_EQ(parsed("a - b - c"), (a - b) - c);
  EXPECT_EQ(parsed("a + b ^ c"), (a | b) ^ c);
  EXPECT_EQ(parsed(" at_least( 2 , a, b|c, \"town hall\" ) "),
            at_least(2, std::vector<Expression>{a, b | c, LayerId(3)}));
  EXPECT_EQ(to_string(parsed("\"d\\\"\\\\\" & (a | b)"), name_of), "\"d\\\"\\\\\" & (a | b)");
}

TEST(Expression, SaysWhereItIsNotUnderstood) {
  const auto expect_error = [](std::string_view text, std::size_t at, const char* what) {
    try {
      (void)parsed(text);
      FAIL() << text;
    } catch (const ExpressionError& error) {
      EXPECT_EQ(error.at(), at) << text;
      EXPECT_THAT(error.what(), ::testing::HasSubstr(what)) << text;
    }
  };
  expect_error("", 0, "a name is expected");
  expect_error("a |", 3, "a name is expected");
  expect_error("a | x", 4, "there is no layer 'x'");
  expect_error("(a", 2, "')' is missing");
  expect_error("a b", 2, "an operator, or the end");
  expect_error("\"a", 2, "closing");
  expect_error("at_least(x, a)", 9, "a number");
  expect_error("exactly(1 a)", 10, "')' is missing");
  expect_error(std::string(100000, '(') + "a", 500, "nested too deeply");
}

TEST(Expression, DiffersOnlyWhereLayersOfTheDifferenceAre) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Expression one = random_expression(random, 4);
    Expression other = random_expression(random, 2);
    // Often one term of the same is another.
    if (seed % 2 == 0) {
      std::vector<Expression::Term> terms(one.terms().begin(), one.terms().end());
      Expression::Term& term = terms[random() % terms.size()];
      if (term.kind == Expression::Term::Kind::layer)
        term.layer = LayerId(static_cast<std::uint32_t>(random() % 5));
      else
        term.count = static_cast<std::uint32_t>(random() % 3);
      other = Expression::of(std::move(terms));
    }
    const auto layers = layers_of_difference(one, other);
    if (one == other) {
      EXPECT_EQ(layers, std::vector<LayerId>());
    }
    for (unsigned cover = 0; layers && cover < 32; ++cover) {
      const bool has_any = std::ranges::any_of(
          *layers, [&](LayerId layer) { return (cover >> layer.index() & 1) != 0; });
      if (!has_any) {
        ASSERT_EQ(answer(one, cover), answer(other, cover)) << cover;
      }
    }
  }
  const Expression a = LayerId(0);
  const Expression b = LayerId(1);
  const Expression c = LayerId(2);
  EXPECT_EQ(layers_of_difference((a | b) & c, (a & b) & c),
            (std::vector<LayerId>{a.terms()[0].layer, b.terms()[0].layer, c.terms()[0].layer}));
  EXPECT_EQ(layers_of_difference((a | b) ^ c, (a & b) ^ c),
            (std::vector<LayerId>{LayerId(0), LayerId(1)}));
  EXPECT_EQ(layers_of_difference(c | (a - b), c | (a ^ b)),
            (std::vector<LayerId>{LayerId(0), LayerId(1)}));
  EXPECT_EQ(layers_of_difference(a, ~a), std::nullopt);
}

TEST(Expression, OfTermsThatFitTogether) {
  using Term = Expression::Term;
  const Term layer{.kind = Term::Kind::layer, .layer = LayerId(0)};
  const Term both{.kind = Term::Kind::at_least, .layer = {}, .operands = 2, .count = 2};
  EXPECT_EQ(Expression::of({layer, layer, both}), Expression(LayerId(0)) & LayerId(0));
  EXPECT_THROW((void)Expression::of({layer, both}), std::invalid_argument);
  EXPECT_THROW((void)Expression::of({layer, layer}), std::invalid_argument);
  EXPECT_THROW((void)Expression::of({}), std::invalid_argument);
}

TEST(Expression, OfManyLayersIsMadeInOneSweep) {
  Expression all;
  for (std::uint32_t i = 0; i < 100'000; ++i) all = std::move(all) | LayerId(i);
  Formula formula(all);
  EXPECT_TRUE(formula.is_true(std::vector{LayerId(99'999)}));
  EXPECT_FALSE(formula.is_true({}));
}

}  // namespace
}  // namespace loft::overlay
