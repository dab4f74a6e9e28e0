// SPDX-License-Identifier: MIT
#include "reconstruct/registration/affine.h"

#include <cmath>

namespace loft {

using cdt::Point;

Stretch Affine::moved(Stretch stretch) const {
  const Point by = way(stretch.middle);
  stretch.middle = {stretch.middle.x + by.x, stretch.middle.y + by.y};
  const Point along{-stretch.normal.y, stretch.normal.x};
  const Point turned{along.x * (1 + along_x.x) + along.y * along_y.x,
                     along.x * along_x.y + along.y * (1 + along_y.y)};
  const double length = std::hypot(turned.x, turned.y);
  if (length > 0) stretch.normal = {turned.y / length, -turned.x / length};
  return stretch;
}

Affine fit_affine(std::span<const Pull> pulls) {
  Affine fitted;
  double sum = 0;
  for (const Pull& pull : pulls) {
    const Point p = pull.stretch.middle;
    sum += pull.weight;
    fitted.centre = {fitted.centre.x + pull.weight * p.x, fitted.centre.y + pull.weight * p.y};
    fitted.shift = {fitted.shift.x + pull.weight * pull.way.x,
                    fitted.shift.y + pull.weight * pull.way.y};
  }
  fitted.centre = {fitted.centre.x / sum, fitted.centre.y / sum};
  fitted.shift = {fitted.shift.x / sum, fitted.shift.y / sum};
  double xx = 0, xy = 0, yy = 0;
  Point x_way, y_way;
  for (const Pull& pull : pulls) {
    const double x = pull.stretch.middle.x - fitted.centre.x;
    const double y = pull.stretch.middle.y - fitted.centre.y;
    xx += pull.weight * x * x;
    xy += pull.weight * x * y;
    yy += pull.weight * y * y;
    x_way = {x_way.x + pull.weight * x * pull.way.x, x_way.y + pull.weight * x * pull.way.y};
    y_way = {y_way.x + pull.weight * y * pull.way.x, y_way.y + pull.weight * y * pull.way.y};
  }
  constexpr double least = 1e-6;  // of a square of extents
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > least * (xx + yy) * (xx + yy))) return fitted;
  fitted.along_x = {(yy * x_way.x - xy * y_way.x) / determinant,
                    (yy * x_way.y - xy * y_way.y) / determinant};
  fitted.along_y = {(xx * y_way.x - xy * x_way.x) / determinant,
                    (xx * y_way.y - xy * x_way.y) / determinant};
  return fitted;
}

double turn(std::span<const Pull> pulls, double times) {
  const Affine fitted = fit_affine(pulls);
  double sine = 0;
  double cosine = 0;
  for (const Pull& pull : pulls) {
    const double x = pull.stretch.middle.x - fitted.centre.x;
    const double y = pull.stretch.middle.y - fitted.centre.y;
    const double u = x + times * (pull.way.x - fitted.shift.x);
    const double v = y + times * (pull.way.y - fitted.shift.y);
    sine += pull.weight * (x * v - y * u);
    cosine += pull.weight * (x * u + y * v);
  }
  return std::atan2(sine, cosine);
}

}  // namespace loft
