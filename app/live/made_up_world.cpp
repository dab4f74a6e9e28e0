// SPDX-License-Identifier: MIT
#include "app/live/made_up_world.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "app/live/dice.h"

namespace loft::app {

namespace {

using cdt::Point;
using overlay::Ring;

constexpr int columns = 6;
constexpr int rows = 4;
constexpr double side = 24;  // of a country, about

constexpr std::array country_names{"Aldor",  "Brenna", "Corvia", "Dunmark", "Elvas",  "Fenland",
                                   "Gorun",  "Hesper", "Ivaria", "Jorland", "Kestra", "Lumen",
                                   "Maroun", "Nordal", "Ostia",  "Pellas",  "Quorra", "Rhune",
                                   "Sarov",  "Tessen", "Ulmark", "Varna",   "Wessel", "Yrien"};

/// Corners of a grid, each moved a little, and rugged ways between them, each made once.
class Borders {
 public:
  Borders() {
    for (int j = 0; j <= rows; ++j)
      for (int i = 0; i <= columns; ++i)
        corners_.push_back(
            {side * (i + dice_.between(-0.27, 0.27)), side * (j + dice_.between(-0.27, 0.27))});
  }

  /// Appends the way from one corner to another, without its end.
  void append(Ring& ring, int from, int to) {
    const Ring& way = way_between(std::min(from, to), std::max(from, to));
    if (from < to)
      ring.insert(ring.end(), way.begin(), way.end() - 1);
    else
      ring.insert(ring.end(), way.rbegin(), way.rend() - 1);
  }

 private:
  const Ring& way_between(int from, int to) {
    const auto [known, is_new] = ways_.try_emplace({from, to});
    if (is_new) {
      known->second.push_back(corner(from));
      bend(known->second, corner(to), 5);
    }
    return known->second;
  }

  /// From the last point to another one: a middle aside, then both halves.
  void bend(Ring& way, Point to, int depth) {
    const Point from = way.back();
    if (depth == 0) return way.push_back(to);
    const double aside = dice_.between(-0.17, 0.17);
    const Point middle{(from.x + to.x) / 2 - aside * (to.y - from.y),
                       (from.y + to.y) / 2 + aside * (to.x - from.x)};
    bend(way, middle, depth - 1);
    bend(way, to, depth - 1);
  }

  [[nodiscard]] Point corner(int number) const {
    return corners_[static_cast<std::size_t>(number)];
  }

  Dice dice_{20};
  std::vector<Point> corners_;
  std::map<std::pair<int, int>, Ring> ways_;
};

Ring island(Dice& dice, Point middle, double size) {
  const double first = dice.between(0, 6);
  const double second = dice.between(0, 6);
  Ring ring;
  for (int i = 0; i < 48; ++i) {
    const double angle = 2 * std::numbers::pi * i / 48;
    const double radius = size * (1 + 0.22 * std::sin(2 * angle + first) +
                                  0.12 * std::sin(5 * angle + second) + dice.between(-0.05, 0.05));
    ring.push_back({middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)});
  }
  return ring;
}

}  // namespace

std::vector<MadeUpCountry> made_up_world() {
  Borders borders;
  std::vector<MadeUpCountry> countries;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int corner = j * (columns + 1) + i;
      const std::array around{corner, corner + 1, corner + columns + 2, corner + columns + 1};
      Ring ring;
      for (std::size_t k = 0; k < 4; ++k) borders.append(ring, around[k], around[(k + 1) % 4]);
      countries.push_back(MadeUpCountry{country_names[countries.size()], {std::move(ring)}});
    }
  }
  Dice dice(3);
  countries[3].parts.push_back(island(dice, {85, -18}, 6));
  countries[6].parts.push_back(island(dice, {-17, 38}, 7));
  countries[17].parts.push_back(island(dice, {162, 60}, 7.5));
  countries[17].parts.push_back(island(dice, {166, 81}, 4));
  countries[20].parts.push_back(island(dice, {52, 114}, 6));
  countries.push_back({"Zelos", {island(dice, {108, 117}, 7)}});
  return countries;
}

}  // namespace loft::app
