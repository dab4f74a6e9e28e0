// SPDX-License-Identifier: MIT
#include "io/contours/nuages.h"

#include <utility>

#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/text_reader.h"
#include "io/contours/coordinate.h"
#include "io/contours/stack_builder.h"

namespace loft::io {

namespace {

class NuagesReader {
 public:
  NuagesReader(std::string_view text, std::string_view name)
      : text_(without_mark(text), name), name_(name), builder_(name) {
    text_.set_comments();
  }

  Stack read() {
    try {
      expect('s');
      const std::int64_t sections = count("a count of sections");
      for (std::int64_t i = 0; i < sections; ++i) read_section(i);
      if (text_.next_line()) text_.fail("expected the end of the file after the last section");
    } catch (const InputError& error) {
      problems_.add(error.what());
    }
    problems_.raise(name_);
    Stack stack;
    stack.fill = Fill::even_odd;
    builder_.finish(stack, "a contour has three points or more");
    return stack;
  }

 private:
  /// A letter, capital or not.
  void expect(char letter) {
    const std::string wanted = std::string("the letter ") + letter;
    const std::string_view word = text_.any_word(wanted);
    const char capital = static_cast<char>(letter - 'a' + 'A');
    if (word != std::string_view(&letter, 1) && word != std::string_view(&capital, 1))
      text_.fail("expected " + wanted + ", found " + in_quotes(word));
  }

  std::int64_t count(std::string_view what) {
    const std::string_view word = text_.any_word(what);
    const std::int64_t number = text_.to_integer(word, what);
    if (number < 0) text_.fail("expected " + std::string(what) + ", found " + in_quotes(word));
    return number;
  }

  double coordinate(std::string_view word, std::string_view what) {
    return coordinate_in(text_, word, what, problems_);
  }

  void read_section(std::int64_t section) {
    expect('v');
    const std::int64_t vertices = count("a count of vertices");
    expect('z');
    const double z = coordinate(text_.any_word("a height"), "a height");
    builder_.add_height(z);
    std::int64_t found = 0;
    for (std::int64_t i = 1; found < vertices; ++i) {
      Contour contour{read_contour(), "",
                      "section " + std::to_string(section + 1) + " contour " + std::to_string(i)};
      found += static_cast<std::int64_t>(contour.points.size());
      builder_.add(std::move(contour), z);
    }
    if (found != vertices)
      text_.fail("section " + std::to_string(section + 1) + " has " + std::to_string(found) +
                 " vertices instead of " + std::to_string(vertices));
  }

  std::vector<cdt::Point> read_contour() {
    const std::string_view brace = text_.any_word("a brace {");
    if (brace != "{") text_.fail("expected a brace {, found " + in_quotes(brace));
    std::vector<cdt::Point> points;
    while (true) {
      const std::string_view word = text_.any_word("a point x y, or a brace }");
      if (word == "}") return points;
      const double x = coordinate(word, "x");
      points.push_back({x, coordinate(text_.any_word("y"), "y")});
    }
  }

  TextReader text_;
  std::string_view name_;
  Problems problems_;
  StackBuilder builder_;
};

}  // namespace

Stack read_nuages(const StackInput& input, const ReadOptions&) {
  return NuagesReader(input.bytes, input.name).read();
}

}  // namespace loft::io
