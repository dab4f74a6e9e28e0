// SPDX-License-Identifier: MIT
#include "tests/cdt/edits.h"

#include <array>
#include <charconv>
#include <span>
#include <sstream>
#include <stdexcept>

namespace loft::cdt {

namespace {

constexpr const char* verbs[] = {"insert", "remove", "move", "translate"};

std::string shortest(double x) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), x).ptr};
}

std::string as_text(std::span<const Point> points) {
  std::string text;
  for (const Point p : points) text += ' ' + shortest(p.x) + ' ' + shortest(p.y);
  return text;
}

std::string as_text(const Edit& edit) {
  std::string text = verbs[static_cast<std::size_t>(edit.kind)];
  text += ' ' + std::to_string(edit.name);
  switch (edit.kind) {
    case Edit::Kind::insert:
      text += edit.outline.ends == closed ? " closed" : " open";
      return text + as_text(edit.outline.points);
    case Edit::Kind::move:
      return text + as_text(edit.outline.points);
    case Edit::Kind::translate:
      return text + as_text(std::array{edit.by});
    case Edit::Kind::remove:
      break;
  }
  return text;
}

std::string braced(Point p) { return '{' + shortest(p.x) + ", " + shortest(p.y) + '}'; }

std::string braced(std::span<const Point> points) {
  std::string code = "std::vector<Point>{";
  for (const Point p : points) code += (code.back() == '{' ? "" : ", ") + braced(p);
  return code + '}';
}

std::string as_code(const Edit& edit) {
  const std::string name = "c" + std::to_string(edit.name);
  switch (edit.kind) {
    case Edit::Kind::insert:
      return name + " = mesh.insert(" + braced(edit.outline.points) +
             (edit.outline.ends == closed ? ", closed);" : ", open);");
    case Edit::Kind::remove:
      return "mesh.remove(" + name + ");";
    case Edit::Kind::move:
      return "mesh.move(" + name + ", " + braced(edit.outline.points) + ");";
    case Edit::Kind::translate:
      break;
  }
  return "mesh.translate(" + name + ", " + braced(edit.by) + ");";
}

/// Words of one line.
class Words {
 public:
  explicit Words(const std::string& line) : line_(line), words_(line) {}

  [[nodiscard]] std::string next() {
    std::string word;
    words_ >> word;
    return word;
  }

  template <class Number>
  [[nodiscard]] Number number() {
    const std::string word = next();
    Number result{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), result);
    if (error != std::errc() || end != word.data() + word.size()) fail();
    return result;
  }

  [[nodiscard]] Point point() {
    const auto x = number<double>();
    return {x, number<double>()};
  }

  [[nodiscard]] std::vector<Point> points() {
    std::vector<Point> points;
    while (!(words_ >> std::ws).eof()) points.push_back(point());
    if (points.empty()) fail();
    return points;
  }

  [[noreturn]] void fail() const { throw std::invalid_argument("no edit: " + line_); }

 private:
  std::string line_;
  std::istringstream words_;
};

Edit read_edit(const std::string& line) {
  Words words(line);
  const std::string verb = words.next();
  Edit edit;
  edit.name = words.number<std::size_t>();
  if (verb == "insert") {
    const std::string ends = words.next();
    if (ends != "open" && ends != "closed") words.fail();
    edit.outline.ends = ends == "closed" ? closed : open;
    edit.outline.points = words.points();
  } else if (verb == "move") {
    edit.kind = Edit::Kind::move;
    edit.outline.points = words.points();
  } else if (verb == "translate") {
    edit.kind = Edit::Kind::translate;
    edit.by = words.point();
  } else if (verb == "remove") {
    edit.kind = Edit::Kind::remove;
  } else {
    words.fail();
  }
  return edit;
}

}  // namespace

std::string as_text(const Script& script) {
  std::string text;
  for (const Edit& edit : script) text += as_text(edit) + '\n';
  return text;
}

Script read_script(std::string_view text) {
  Script script;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos) script.push_back(read_edit(line));
  return script;
}

std::string as_code(const Script& script) {
  std::map<std::size_t, bool> names;
  for (const Edit& edit : script) names[edit.name] = true;
  std::string code = "Triangulation mesh;\nConstraintId";
  for (const auto& [name, is_used] : names)
    code += (code.back() == 'd' ? " c" : ", c") + std::to_string(name);
  code += ";\n";
  for (const Edit& edit : script) code += as_code(edit) + '\n';
  return code;
}

bool applies(const Edit& edit, const Constraints& constraints) {
  return constraints.contains(edit.name) == (edit.kind != Edit::Kind::insert);
}

void carry_out(const Edit& edit, Constraints& constraints) {
  switch (edit.kind) {
    case Edit::Kind::insert:
      constraints[edit.name] = edit.outline;
      break;
    case Edit::Kind::remove:
      constraints.erase(edit.name);
      break;
    case Edit::Kind::move:
      constraints[edit.name].points = edit.outline.points;
      break;
    case Edit::Kind::translate:
      for (Point& p : constraints[edit.name].points) p = {p.x + edit.by.x, p.y + edit.by.y};
      break;
  }
}

Edit inverse(const Edit& edit, const Constraints& before) {
  if (edit.kind == Edit::Kind::insert) return {Edit::Kind::remove, edit.name, {}, {}};
  const Outline& outline = before.at(edit.name);
  if (edit.kind == Edit::Kind::remove) return {Edit::Kind::insert, edit.name, outline, {}};
  return {Edit::Kind::move, edit.name, {outline.points, open}, {}};
}

}  // namespace loft::cdt
