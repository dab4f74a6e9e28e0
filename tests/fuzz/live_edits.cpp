// SPDX-License-Identifier: MIT
// What a page of `loft live` sends, an edit a line: the door admits what it says, and small scenes
// do what they are asked to, or refuse it.
#include <memory>
#include <stdexcept>

#include "app/live/edit.h"
#include "app/live/scenes.h"
#include "cdt/triangulation.h"
#include "tests/fuzz/target.h"

namespace {

using namespace loft;

constexpr app::EditLimits limits{.most_points = 64, .most_text = 200, .most_name = 32};

void judge(const app::Edit& edit) {
  using Kind = app::Edit::Kind;
  const bool has_points = edit.kind == Kind::insert || edit.kind == Kind::reshape;
  fuzz::require(!has_points || !edit.points.empty(), "a shape without points");
  fuzz::require(edit.points.size() <= limits.most_points, "too many points");
  fuzz::require(edit.text.value_or("").size() <= limits.most_text, "too long a text");
  for (const cdt::Point& p : edit.points)
    fuzz::require(cdt::Triangulation::is_usable(p), "a point that is not usable");
  fuzz::require(!edit.at || cdt::Triangulation::is_usable(*edit.at), "a place that is not usable");
  fuzz::require(edit.kind != Kind::move || (edit.id && edit.at), "a move of nothing, or nowhere");
}

io::Map small_map() {
  const overlay::Polygon square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {1, 2}, {2, 1}}}};
  const overlay::Polygon other{{{3, 3}, {6, 3}, {5, 6}}, {}};
  return {{{.polygons = {square}},
           {.polygons = {other}},
           {.lines = {{{7, 0}, {7, 5}}}},
           {.points = {{8, 8}}}},
          ""};
}

void try_edit(app::Scene& scene, std::string_view line) {
  try {
    const app::Edit edit = app::read_edit(line, limits);
    judge(edit);
    fuzz::require(scene.apply(edit).is_object(), "a change that is none");
  } catch (const app::Refusal& refusal) {
    fuzz::require(refusal.what()[0] != '\0', "a refusal without words");
    fuzz::require(refusal.status() >= 400, "a refusal without a status");
  } catch (const std::invalid_argument& error) {
    fuzz::require(error.what()[0] != '\0', "an error without words");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const io::Map map = small_map();
  const std::string text = fuzz::text_of(bytes, size);
  for (const std::string& tab : app::tab_names()) {
    const auto scene = app::make_scene(tab, &map);
    std::string_view left = text;
    for (int lines = 0; lines < 16 && !left.empty(); ++lines) {
      const std::size_t end = std::min(left.find('\n'), left.size());
      try_edit(*scene, left.substr(0, end));
      left.remove_prefix(std::min(end + 1, left.size()));
    }
    static_cast<void>(scene->advance(0.1));
    fuzz::require(scene->state().is_object(), "a state that is none");
  }
  return 0;
}
