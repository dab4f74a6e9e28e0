// SPDX-License-Identifier: MIT
#include "io/rounding/mender.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace loft::io {

namespace {

constexpr int most_rounds = 16;
/// Places that vertices are tried at: some seconds at most.
constexpr std::size_t most_tries = 200'000;
/// Around a vertex: tests of pairs are bounded.
constexpr std::size_t most_faces = 256;
/// So far vertices may go, in units in the last place of what is around them.
constexpr std::array reaches{1, 2, 4, 8};

struct Way {
  std::array<int, 3> step;
};

/// To the 26 neighbours in a grid: those in the plane of a slice first, along an axis first.
std::vector<Way> make_ways() {
  std::vector<Way> ways;
  for (const int z : {0, 1, -1})
    for (const int y : {0, 1, -1})
      for (const int x : {0, 1, -1})
        if (x != 0 || y != 0 || z != 0) ways.push_back({{x, y, z}});
  const auto order = [](const Way& way) {
    const auto [x, y, z] = way.step;
    return std::pair(z != 0, std::abs(x) + std::abs(y));
  };
  std::ranges::stable_sort(ways, {}, order);
  return ways;
}

/// A unit in the last place of a number as `float`.
double unit_in_last_place(double value) {
  const auto size = static_cast<float>(std::abs(value));
  return static_cast<double>(std::nextafter(size, std::numeric_limits<float>::infinity()) - size);
}

}  // namespace

Mender::Mender(Surface& surface, const Mesh& mesh, const FloatFrame& frame, PlaceCounts& counts)
    : surface_(surface),
      frame_(frame),
      counts_(counts),
      places_(mesh.points),
      is_apart_(mesh.faces.size()) {
  std::vector<Corners> triangles;
  triangles.reserve(mesh.faces.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& [a, b, c] = triangles.emplace_back(corners(mesh, f));
    is_flat_.push_back(collinear(a, b, c));
  }
  tree_ = TriangleTree(triangles);
}

void Mender::mend(std::span<const std::uint32_t> vertices) {
  const auto try_all = [&](auto step) {
    bool is_changed = false;
    for (const std::uint32_t v : vertices)
      if (step(VertexHandle(static_cast<int>(v)))) is_changed = true;
    return is_changed;
  };
  for (int round = 0; round < most_rounds; ++round) {
    if (try_all([this](VertexHandle v) { return move(v); })) continue;
    if (!try_all([this](VertexHandle v) { return collapse(v); })) break;
  }
}

Mesh Mender::unmoved() const {
  Surface result = surface_;
  for (const auto& [v, home] : homes_) result.set_point(VertexHandle(v), home);
  result.garbage_collection();
  return to_mesh(result);
}

bool Mender::move(VertexHandle v) {
  if (!is_mendable(v)) return false;
  std::size_t fewest = faults_at(v, place(v), all);
  if (fewest == 0) return false;
  static const std::vector<Way> ways = make_ways();
  const Vec3 unit = unit_around(v);
  const auto moved = homes_.find(v.idx());
  const Surface::Point home = moved == homes_.end() ? surface_.point(v) : moved->second;
  std::optional<Surface::Point> best;
  for (const int reach : reaches) {
    for (const auto& [step] : ways) {
      Surface::Point point = home;
      for (unsigned axis = 0; axis < 3; ++axis) point[axis] += reach * step[axis] * unit[axis];
      const std::size_t count = faults_at(v, rounded(point), fewest);
      if (count >= fewest) continue;
      fewest = count;
      best = point;
      if (fewest == 0) break;
    }
    if (best) break;  // no farther than needed
  }
  if (best) put(v, *best);
  return best.has_value();
}

bool Mender::is_mendable(VertexHandle v) const {
  return tries_ < most_tries && !surface_.status(v).deleted() && surface_.valence(v) <= most_faces;
}

Vec3 Mender::unit_around(VertexHandle v) const {
  if (frame_.grid) {
    const double step = frame_.grid->step() / frame_.factor;
    return {step, step, step};
  }
  Vec3 largest{};
  const auto add = [&](const Vec3& place) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      largest[axis] = std::max(largest[axis], std::abs(place[axis]));
  };
  add(place(v));
  for (const VertexHandle neighbour : surface_.vv_range(v)) add(place(neighbour));
  // Where all is next to 0 along an axis its floats are too close to one another to help.
  const double size = std::ranges::max(largest) / 256;
  Vec3 unit{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    unit[axis] = unit_in_last_place(std::max(largest[axis], size)) / frame_.factor;
  return unit;
}

void Mender::put(VertexHandle v, const Surface::Point& point) {
  counts_.remove(place(v));
  homes_.try_emplace(v.idx(), surface_.point(v));
  surface_.set_point(v, point);
  places_[static_cast<std::size_t>(v.idx())] = rounded(point);
  counts_.add(place(v));
  for (const FaceHandle f : surface_.vf_range(v)) refresh(f);
}

void Mender::refresh(FaceHandle f) {
  Corners now{};
  std::size_t i = 0;
  for (const VertexHandle v : surface_.fv_range(f)) now[i++] = place(v);
  const auto number = static_cast<std::uint32_t>(f.idx());
  is_flat_[number] = collinear(now[0], now[1], now[2]);
  tree_.update(number, now);
}

std::size_t Mender::faults_at(VertexHandle v, const Vec3& at, std::size_t enough) {
  const std::size_t itself = at == place(v) ? 1 : 0;
  const std::size_t others = counts_.at(at) - itself;
  if (others >= enough) return others;
  star_.clear();
  for (const FaceHandle f : surface_.vf_range(v)) add_to_star(f, v, at);
  return others + faults_of_star(enough - others);
}

void Mender::add_to_star(FaceHandle f, VertexHandle moved, const Vec3& to) {
  StarFace face{static_cast<std::uint32_t>(f.idx()), {}, false};
  std::size_t i = 0;
  for (const VertexHandle v : surface_.fv_range(f)) face.places[i++] = v == moved ? to : place(v);
  face.is_flat = collinear(face.places[0], face.places[1], face.places[2]);
  star_.push_back(face);
}

std::size_t Mender::faults_of_star(std::size_t enough) {
  ++tries_;
  std::size_t count = 0;
  for (const StarFace& face : star_) count += face.is_flat ? 1U : 0U;
  for (std::size_t i = 0; i < star_.size() && count < enough; ++i) {
    if (star_[i].is_flat) continue;
    for (std::size_t j = i + 1; j < star_.size(); ++j)
      if (!star_[j].is_flat && triangles_meet(star_[i].places, star_[j].places)) ++count;
  }
  for (const StarFace& face : star_) is_apart_[face.face] = true;
  for (std::size_t i = 0; i < star_.size() && count < enough; ++i)
    count += others_that_meet(star_[i]);
  for (const StarFace& face : star_) is_apart_[face.face] = false;
  return count;
}

std::size_t Mender::others_that_meet(const StarFace& face) const {
  if (face.is_flat) return 0;
  std::size_t count = 0;
  const auto look = [&](std::uint32_t other, const Corners& places) {
    if (!is_apart_[other] && !is_flat_[other] && triangles_meet(face.places, places)) ++count;
    return true;
  };
  static_cast<void>(tree_.all_of_meeting(face.places, look));
  return count;
}

bool Mender::collapse(VertexHandle v) {
  if (!is_mendable(v)) return false;
  const std::size_t count = faults_at(v, place(v), all);
  if (count == 0) return false;
  for (const HalfedgeHandle h : surface_.voh_range(v)) {
    const VertexHandle to = surface_.to_vertex_handle(h);
    if (!is_near(v, to) || !is_mendable(to) || !surface_.is_collapse_ok(h)) continue;
    if (faults_without(v, to, count) >= count) continue;
    collapse(h);
    return true;
  }
  return false;
}

bool Mender::is_near(VertexHandle v, VertexHandle other) const {
  const Vec3 unit = unit_around(v);
  const Surface::Point way = surface_.point(v) - surface_.point(other);
  for (unsigned axis = 0; axis < 3; ++axis)
    if (std::abs(way[axis]) > reaches.back() * unit[axis]) return false;
  return true;
}

bool Mender::has(FaceHandle f, VertexHandle v) const {
  return std::ranges::any_of(surface_.fv_range(f), [&](VertexHandle w) { return w == v; });
}

std::size_t Mender::faults_without(VertexHandle v, VertexHandle to, std::size_t enough) {
  star_.clear();
  std::vector<std::uint32_t> gone;
  for (const FaceHandle f : surface_.vf_range(v)) {
    if (has(f, to))
      gone.push_back(static_cast<std::uint32_t>(f.idx()));
    else
      add_to_star(f, v, place(to));
  }
  for (const FaceHandle f : surface_.vf_range(to))
    if (!has(f, v)) add_to_star(f, to, place(to));
  const std::size_t themselves = place(v) == place(to) ? 2 : 1;
  const std::size_t others = counts_.at(place(to)) - themselves;
  for (const std::uint32_t f : gone) is_apart_[f] = true;
  const std::size_t count = others + (others < enough ? faults_of_star(enough - others) : 0);
  for (const std::uint32_t f : gone) is_apart_[f] = false;
  return count;
}

void Mender::collapse(HalfedgeHandle h) {
  const VertexHandle v = surface_.from_vertex_handle(h);
  std::vector<FaceHandle> around;
  for (const FaceHandle f : surface_.vf_range(v)) around.push_back(f);
  counts_.remove(place(v));
  surface_.collapse(h);
  for (const FaceHandle f : around) {
    if (surface_.status(f).deleted())
      tree_.remove(static_cast<std::uint32_t>(f.idx()));
    else
      refresh(f);
  }
  ++collapsed_;
}

}  // namespace loft::io
