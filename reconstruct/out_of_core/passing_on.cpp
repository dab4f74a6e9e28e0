// SPDX-License-Identifier: MIT
#include "reconstruct/out_of_core/passing_on.h"

#include <algorithm>

namespace loft {

namespace {

/// The corners of a face as an OpenMesh mesh lists them: the first one last.
std::array<HalfEdge, 3> corners(HalfEdge first) {
  const HalfEdge second = Sewing::next(first);
  return {second, Sewing::next(second), first};
}

}  // namespace

void PassingOn::pass_on() {
  for (; passed_bound_ < sewing_.final_bound(); ++passed_bound_) {
    if (passed_bound_ < first_ || passed_bound_ >= bound_) continue;
    if (passed_bound_ == first_) begin();
    pass_on_vertices_of(passed_bound_);
    pass_on_faces_of(passed_bound_);
    survey_.connect(sewing_, passed_bound_, first_, bound_);
    if (passed_bound_ + 1 == bound_) pass_on_upper_slice();
  }
  sewing_.drop_below(passed_bound_);
}

void PassingOn::finish() {
  pass_on_added();
  std::ranges::sort(cuts_, {}, &Cut::place);
  for (const Cut& cut : cuts_) survey_.add_face(cut.places);
  std::vector<SurfaceFace> faces;
  for (const Cut& cut : cuts_) faces.push_back(cut.face);
  sink_.add_faces(faces);
  sink_.end({sizes_.plain + sizes_.upper, sizes_.lower_doubled + sizes_.doubled});
}

std::vector<std::uint32_t> PassingOn::lower_places() const {
  std::vector<std::uint32_t> places;
  for (const Cut& cut : cuts_)
    if (is_in_lower_seam(cut)) places.push_back(cut.place - lower_.cuts);
  return places;
}

std::vector<std::uint32_t> PassingOn::upper_places() const {
  std::vector<std::uint32_t> places;
  for (const Cut& cut : cuts_)
    if (is_in_upper_seam(cut)) places.push_back(cut.place - upper_.cuts);
  return places;
}

/// What sewing has added to the layers that are passed on.
void PassingOn::pass_on_added() {
  const Sewing::Added all{static_cast<std::uint32_t>(sewing_.doubled().size()),
                          static_cast<std::uint32_t>(sewing_.midpoints().size()),
                          static_cast<std::uint32_t>(sewing_.cut_faces().size())};
  const bool has_upper = bound_ != Origin::none;
  if (first_ > 0) note_lower_seam();
  upper_ = has_upper ? sewing_.added_before(bound_) : all;
  const Sewing::Added above = has_upper ? sewing_.added_before(bound_ + 1) : all;
  sizes_.doubled = upper_.doubled - lower_.doubled;
  sizes_.midpoints = upper_.midpoints - lower_.midpoints;
  sizes_.upper_midpoints = above.midpoints - upper_.midpoints;
  sizes_.upper_seam = above.cuts - upper_.cuts;
  pass_on_vertices(sewing_.doubled().first(upper_.doubled).subspan(first_doubled()));
  pass_on_vertices(sewing_.midpoints().first(above.midpoints).subspan(lower_.midpoints));
  for (const Cut& cut : cuts_)
    ++(is_in_lower_seam(cut)   ? sizes_.lower_cuts
       : is_in_upper_seam(cut) ? sizes_.upper_cuts
                               : sizes_.cuts);
}

void PassingOn::note_lower_seam() {
  lower_ = sewing_.added_before(first_);
  lower_seam_end_ = sewing_.added_before(first_ + 1).cuts;
  sizes_.lower_doubled = lower_.doubled - sewing_.added_before(first_ - 1).doubled;
  sizes_.lower_seam = lower_seam_end_ - lower_.cuts;
}

/// Knows from here on how corners are numbered.
void PassingOn::begin() {
  first_vertex_ = sewing_.first_vertex(first_);
  if (first_ > 0) note_lower_seam();
}

/// What the part above begins with.
void PassingOn::pass_on_upper_slice() {
  vertices_.clear();
  add_slice(*sewing_.layer(bound_).lower);
  sizes_.upper = static_cast<std::uint32_t>(vertices_.size());
  pass_on_vertices(vertices_);
}

void PassingOn::pass_on_vertices(std::span<const SurfaceVertex> vertices) {
  survey_.add_vertices(vertices);
  sink_.add_vertices(vertices);
}

/// Those of the slice below a layer and inside it; above the last layer also those there.
void PassingOn::pass_on_vertices_of(std::uint32_t number) {
  const Layer& layer = sewing_.layer(number);
  vertices_.clear();
  add_slice(*layer.lower);
  for (const InnerVertex& inner : layer.tiles.inner)
    vertices_.push_back({inner.place, {inner.kind, layer.slice, Origin::none, Origin::none}});
  const bool is_last =
      sewing_.final_bound() == sewing_.layer_bound() && number + 1 == sewing_.layer_bound();
  if (is_last) add_slice(*layer.upper);
  sizes_.plain += static_cast<std::uint32_t>(vertices_.size());
  pass_on_vertices(vertices_);
}

void PassingOn::add_slice(const Region& region) {
  for (std::size_t i = 0; i < region.points.size(); ++i)
    vertices_.push_back({{region.points[i].x, region.points[i].y, region.z}, region.origins[i]});
}

void PassingOn::pass_on_faces_of(std::uint32_t number) {
  faces_.clear();
  for (std::uint32_t f = 0; f < sewing_.face_count(number); ++f) {
    faces_.push_back(face({number, 3 * f}));
    survey_.add_face(places({number, 3 * f}));
  }
  sink_.add_faces(faces_);
  sizes_.faces += faces_.size();
  const auto cuts = sewing_.cuts_of(number);
  for (std::uint32_t i = 0; i < cuts.size(); ++i) {
    const HalfEdge first{number, 3 * (sewing_.face_count(number) + i)};
    cuts_.push_back({cuts[i], face(first), places(first)});
  }
}

SurfaceFace PassingOn::face(HalfEdge first) const {
  const auto [a, b, c] = corners(first);
  const Layer& layer = sewing_.layer(first.layer);
  return {{passed(sewing_.vertex(a)), passed(sewing_.vertex(b)), passed(sewing_.vertex(c))},
          layer.tiles.tiles[first.face()].kind,
          layer.slab};
}

/// The number of a vertex among those that are passed on.
std::uint32_t PassingOn::passed(std::uint32_t vertex) const {
  if ((vertex & VertexNumbers::doubled_mark) == 0) return vertex - first_vertex_;
  const bool is_midpoint = (vertex & VertexNumbers::midpoint_mark) == VertexNumbers::midpoint_mark;
  return vertex - (is_midpoint ? lower_.midpoints : first_doubled());
}

std::array<Vec3, 3> PassingOn::places(HalfEdge first) const {
  const auto [a, b, c] = corners(first);
  return {sewing_.place(a), sewing_.place(b), sewing_.place(c)};
}

}  // namespace loft
