// SPDX-License-Identifier: MIT
#include "tests/cdt/judge.h"

#include <algorithm>
#include <exception>
#include <ostream>
#include <utility>
#include <vector>

#include "cdt/check.h"
#include "tests/cdt/courses.h"
#include "tests/cdt/picture.h"
#include "tests/cdt/player.h"

namespace loft::cdt {

namespace {

std::size_t segment_count(const std::vector<Outline>& outlines) {
  std::size_t count = 0;
  for (const Outline& outline : outlines) count += outline.points.size();
  return count;
}

/// Everything but the triangulation itself.
std::string wrong_books(const Player& player, const std::vector<Outline>& outlines) {
  const Triangulation& mesh = player.mesh();
  const std::vector<ConstraintId> ids = player.ids();
  if (mesh.constraint_count() != ids.size()) return "constraint_count() is wrong";
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (!mesh.is_constraint(ids[i])) return "a constraint is gone";
    if (mesh.ends(ids[i]) != outlines[i].ends) return "ends() is wrong";
    if (mesh.points(ids[i]) != outlines[i].points) return "points() is wrong";
  }
  return "";
}

/// Compares one state of a player.
class Judge {
 public:
  Judge(const Player& player, Judging judging, Tally& tally)
      : player_(player), outlines_(player.outlines()), judging_(judging), tally_(tally) {}

  [[nodiscard]] std::string wrong() {
    const auto findings = check(player_.mesh());
    if (!findings.empty()) return "check: " + findings.front().message;
    if (std::string words = wrong_books(player_, outlines_); !words.empty()) return words;
    if (std::string words = wrong_course(player_.mesh()); !words.empty()) return words;
    const Picture picture = picture_of(player_.mesh(), player_.ids());
    if (picture.vertices.size() != player_.mesh().vertex_count()) return "vertex_count() is wrong";
    if (std::string words = not_fresh(picture); !words.empty()) return words;
    return not_reference(picture);
  }

 private:
  [[nodiscard]] std::string not_fresh(const Picture& picture) {
    Triangulation fresh;
    std::vector<ConstraintId> ids;
    for (const auto& [points, ends] : outlines_) ids.push_back(fresh.insert(points, ends));
    is_snapped_ = !player_.mesh().snaps().empty() || !fresh.snaps().empty();
    std::string words = difference(picture, picture_of(fresh, ids));
    if (words.empty()) {
      ++tally_.same_as_fresh;
    } else if (is_snapped_) {
      ++tally_.not_as_fresh;
    } else {
      return "not as a fresh one: " + words;
    }
    return "";
  }

  [[nodiscard]] std::string not_reference(const Picture& picture) {
    if (segment_count(outlines_) > judging_.reference_segments) {
      if (is_snapped_) ++tally_.unexplained;
      return "";
    }
    const Reference reference(outlines_);
    if (!reference.is_embeddable()) {
      ++tally_.not_embeddable;
      return "";
    }
    if (std::string words = difference(picture, reference.picture()); !words.empty())
      return "not as the reference: " + words;
    ++tally_.same_as_reference;
    if (is_snapped_) ++tally_.snapped_in_vain;
    return "";
  }

  const Player& player_;
  std::vector<Outline> outlines_;
  Judging judging_;
  Tally& tally_;
  bool is_snapped_ = false;
};

bool is_wrong(const Script& script, Judging judging) {
  Tally tally;
  return !first_wrong(script, judging, tally).empty();
}

/// Leaves out what can be left out: halves first, then smaller runs, then single items.
template <class Item, class IsWrong>
void drop(std::vector<Item>& items, IsWrong is_still_wrong) {
  for (std::size_t size = items.size(); size > 0; size /= 2) {
    for (std::size_t first = 0; first < items.size();) {
      const std::vector<Item> before = items;
      const auto start = items.begin() + static_cast<std::ptrdiff_t>(first);
      items.erase(start, start + static_cast<std::ptrdiff_t>(std::min(size, items.size() - first)));
      if (is_still_wrong()) continue;
      items = before;
      first += size;
    }
  }
}

}  // namespace

Tally& Tally::operator+=(const Tally& other) {
  edits += other.edits;
  same_as_fresh += other.same_as_fresh;
  same_as_reference += other.same_as_reference;
  not_embeddable += other.not_embeddable;
  not_as_fresh += other.not_as_fresh;
  snapped_in_vain += other.snapped_in_vain;
  unexplained += other.unexplained;
  return *this;
}

std::ostream& operator<<(std::ostream& out, const Tally& tally) {
  return out << tally.edits << " edits; as a fresh triangulation " << tally.same_as_fresh
             << ", snapped and not so " << tally.not_as_fresh << ", as the reference "
             << tally.same_as_reference << " (" << tally.snapped_in_vain
             << " of them snapped); excused: not embeddable " << tally.not_embeddable
             << ", snapped and not explained " << tally.unexplained;
}

std::string first_wrong(const Script& script, Judging judging, Tally& tally) {
  Player player;
  for (std::size_t i = 0; i < script.size(); ++i) {
    try {
      player.play(script[i]);
    } catch (const std::exception& error) {
      return std::string("an edit throws: ") + error.what();
    }
    ++tally.edits;
    if ((i + 1) % judging.every != 0 && i + 1 != script.size()) continue;
    if (std::string words = Judge(player, judging, tally).wrong(); !words.empty()) return words;
  }
  return "";
}

Script shrunk(Script script, Judging judging) {
  Tally until;
  if (first_wrong(script, judging, until).empty()) return script;
  script.resize(until.edits);
  judging.every = script.size();  // what was wrong is wrong at the end now
  const auto is_still_wrong = [&] { return is_wrong(script, judging); };
  drop(script, is_still_wrong);
  for (Edit& edit : script)
    drop(edit.outline.points, [&] { return !edit.outline.points.empty() && is_still_wrong(); });
  drop(script, is_still_wrong);
  return script;
}

std::string verdict(const Script& script, Judging judging, Tally& tally) {
  const std::string words = first_wrong(script, judging, tally);
  if (words.empty()) return "";
  const Script least = shrunk(script, judging);
  Tally ignored;
  return words + "\nshrunk to " + std::to_string(least.size()) +
         " edits: " + first_wrong(least, {1, judging.reference_segments}, ignored) + "\n" +
         as_text(least) + as_code(least);
}

}  // namespace loft::cdt
