// SPDX-License-Identifier: MIT
#include "overlay/expression_difference.h"

#include <algorithm>
#include <cstdint>
#include <span>

#include "cdt/each_once.h"
#include "overlay/formula.h"

namespace loft::overlay {

namespace {

using Terms = std::span<const Expression::Term>;

/// By term: where what it is made of begins.
std::vector<std::size_t> begins_of(Terms terms) {
  std::vector<std::size_t> begins(terms.size());
  std::vector<std::size_t> stack;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    begins[i] = i;
    if (terms[i].kind != Expression::Term::Kind::layer) {
      const std::size_t first = stack.size() - terms[i].operands;
      if (first < stack.size()) begins[i] = stack[first];
      stack.resize(first);
    }
    stack.push_back(begins[i]);
  }
  return begins;
}

void append_layers(Terms terms, std::vector<LayerId>& layers) {
  for (const Expression::Term& term : terms)
    if (term.kind == Expression::Term::Kind::layer) layers.push_back(term.layer);
}

bool is_true_outside(Terms terms) {
  return Formula(Expression::of({terms.begin(), terms.end()})).is_true_outside();
}

}  // namespace

/// Terms before and behind are the same; what is between grows until it is one operand in both.
std::optional<std::vector<LayerId>> layers_of_difference(const Expression& a, const Expression& b) {
  const Terms of_a = a.terms();
  const Terms of_b = b.terms();
  const auto before =
      static_cast<std::size_t>(std::ranges::mismatch(of_a, of_b).in1 - of_a.begin());
  if (before == of_a.size() && before == of_b.size()) return std::vector<LayerId>();
  std::size_t behind = 0;
  while (behind < std::min(of_a.size(), of_b.size()) - before &&
         of_a[of_a.size() - 1 - behind] == of_b[of_b.size() - 1 - behind])
    ++behind;
  const std::vector<std::size_t> begins_a = begins_of(of_a);
  const std::vector<std::size_t> begins_b = begins_of(of_b);
  for (;; --behind) {
    const std::size_t end_a = of_a.size() - behind;
    const std::size_t end_b = of_b.size() - behind;
    if (end_a == 0 || end_b == 0) continue;
    const std::size_t begin = begins_a[end_a - 1];
    if (begin > before || begin != begins_b[end_b - 1]) continue;
    const Terms part_a = of_a.subspan(begin, end_a - begin);
    const Terms part_b = of_b.subspan(begin, end_b - begin);
    if (is_true_outside(part_a) != is_true_outside(part_b)) return std::nullopt;
    std::vector<LayerId> layers;
    append_layers(part_a, layers);
    append_layers(part_b, layers);
    cdt::keep_each_once(layers);
    return layers;
  }
}

}  // namespace loft::overlay
