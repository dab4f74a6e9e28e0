// SPDX-License-Identifier: MIT
#include "fields/field.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "cdt/each_once.h"
#include "fields/field_parts.h"

namespace loft::fields {

using cdt::ConstraintId;

namespace {

ConstraintId constraint(SampleId sample) { return ConstraintId(sample.index()); }
ConstraintId constraint(LineId line) { return ConstraintId(line.index()); }

template <class... Words>
[[noreturn]] void refuse(const Words&... words) {
  std::ostringstream message;
  message.precision(17);
  (message << ... << words);
  throw std::invalid_argument(message.str());
}

void check_usable(const Sample& sample) {
  if (!Triangulation::is_usable(sample.place))
    refuse("sample at ", sample.place, ": its coordinates are not usable");
  if (!Field::is_usable(sample.value))
    refuse("sample at ", sample.place, ": its value is not finite, or beyond 1e150");
}

void check_values(std::span<const Point> points, std::span<const double> values,
                  const char* which) {
  if (values.size() != points.size())
    refuse("line at ", points.front(), ": ", values.size(), ' ', which, " for ", points.size(),
           " points");
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!Field::is_usable(values[i]))
      refuse("line, point ", i, ", ", points[i], ": its value is not finite, or beyond 1e150");
}

}  // namespace

Field::Field(OnConflict policy) : policy_(policy) {
  mesh_.record_changes(true);
  make_room();
}
Field::~Field() = default;
Field::Field(Field&&) noexcept = default;
Field& Field::operator=(Field&&) noexcept = default;

// What is there.

bool Field::is_sample(SampleId sample) const {
  return sample.index() < samples_.size() && !samples_[sample.index()].vertex.is_none();
}
bool Field::is_line(LineId line) const {
  return line.index() < lines_.size() && lines_[line.index()] != nullptr;
}
Sample Field::sample(SampleId sample) const {
  const Given& given = samples_[sample.index()];
  return {mesh_.point(given.vertex), given.value};
}
LineKind Field::kind(LineId line) const { return lines_[line.index()]->kind; }
std::vector<Point> Field::points(LineId line) const { return mesh_.points(constraint(line)); }

std::vector<Conflict> Field::conflicts() const {
  std::vector<Conflict> all;
  for (const auto& [v, here] : conflicts_) all.insert(all.end(), here.begin(), here.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const Conflict& a, const Conflict& b) { return a.place < b.place; });
  return all;
}

std::optional<LineKind> Field::line_of(cdt::Passage passage) const {
  const Values* line = line_along(passage);
  return line != nullptr ? std::optional(line->kind) : std::nullopt;
}

// What comes in.

void Field::check(const Line& line) const {
  if (line.points.empty()) refuse("a line without points");
  for (std::size_t i = 0; i < line.points.size(); ++i)
    if (!Triangulation::is_usable(line.points[i]))
      refuse("line, point ", i, ", ", line.points[i], ": its coordinates are not usable");
  if (std::all_of(line.points.begin(), line.points.end(),
                  [&](Point p) { return p == line.points.front(); }))
    refuse("line at ", line.points.front(), ": it has no two different points");
  if (line.kind == LineKind::feature) check_values(line.points, line.values, "values");
  if (line.kind == LineKind::wall) {
    check_values(line.points, line.left, "values on the left");
    check_values(line.points, line.right, "values on the right");
  }
}

void Field::expect(SampleId sample) const {
  if (!is_sample(sample)) refuse("there is no sample ", sample);
}
void Field::expect(LineId line) const {
  if (!is_line(line)) refuse("there is no line ", line);
}

// Edits. Each goes to the triangulation, then to the field without soft lines, then to what is kept
// beside the triangulation.

SampleId Field::insert(const Sample& sample) { return insert(std::span(&sample, 1)).front(); }

std::vector<SampleId> Field::insert(std::span<const Sample> samples) {
  for (const Sample& sample : samples) check_usable(sample);
  std::vector<cdt::Polyline> points;
  points.reserve(samples.size());
  for (const Sample& sample : samples) points.push_back({{&sample.place, 1}, cdt::open});
  const std::size_t conflicts_before = conflicts_.size();
  // As much again as there is: it costs less to look at all anew.
  const bool is_large = samples.size() > mesh_.vertex_count();
  if (is_large) mesh_.record_changes(false);
  std::vector<SampleId> ids;
  ids.reserve(samples.size());
  for (const ConstraintId c : mesh_.insert(points)) ids.push_back(SampleId(c.index()));
  make_room();
  for (std::size_t i = 0; i < ids.size(); ++i) list(ids[i], samples[i].value, order_++);
  if (firm_) {
    const std::vector<SampleId> firm = firm_->insert(samples);
    for (std::size_t i = 0; i < ids.size(); ++i) samples_[ids[i].index()].firm = firm[i];
  }
  if (is_large) {
    mesh_.record_changes(true);
    rebuild();
  } else {
    finish_edit();
  }
  undo_if_refused(conflicts_before, [&] {
    for (const SampleId id : ids) remove(id);
  });
  return ids;
}

LineId Field::insert(const Line& line) {
  check(line);
  const std::size_t conflicts_before = conflicts_.size();
  if (line.kind == LineKind::soft && soft_lines_++ == 0) make_firm();
  const LineId id(mesh_.insert(line.points, line.ends).index());
  if (id.index() >= lines_.size()) lines_.resize(id.index() + 1);
  lines_[id.index()] = std::make_unique<Values>();
  lines_[id.index()]->kind = line.kind;
  lines_[id.index()]->order = order_++;
  take_values(id, line);
  if (firm_ && line.kind != LineKind::soft) lines_[id.index()]->firm = firm_->insert(line);
  make_room();
  touch_line(id);
  finish_edit();
  undo_if_refused(conflicts_before, [&] { remove(id); });
  return id;
}

void Field::move(SampleId sample, Point place) {
  expect(sample);
  Given& given = samples_[sample.index()];
  check_usable({place, given.value});
  const Point before = mesh_.point(given.vertex);
  const std::size_t conflicts_before = conflicts_.size();
  unlist_at_vertex(sample);
  mesh_.move(constraint(sample), std::span(&place, 1));
  make_room();
  list_at_vertex(sample);
  if (firm_) firm_->move(given.firm, place);
  finish_edit();
  undo_if_refused(conflicts_before, [&] { move(sample, before); });
}

void Field::set_value(SampleId sample, double value) {
  expect(sample);
  Given& given = samples_[sample.index()];
  check_usable({mesh_.point(given.vertex), value});
  const double before = std::exchange(given.value, value);
  const std::size_t conflicts_before = conflicts_.size();
  touch(given.vertex);
  if (firm_) firm_->set_value(given.firm, value);
  finish_edit(false);
  undo_if_refused(conflicts_before, [&] { set_value(sample, before); });
}

void Field::remove(SampleId sample) {
  expect(sample);
  const SampleId firm = samples_[sample.index()].firm;
  unlist_at_vertex(sample);
  samples_[sample.index()] = {};
  mesh_.remove(constraint(sample));
  if (firm_) firm_->remove(firm);
  make_room();
  finish_edit();
}

void Field::move(LineId line, const Line& to) {
  expect(line);
  Line checked = to;
  checked.kind = kind(line);
  check(checked);
  const std::vector<Point> points_before = points(line);
  const Values values_before = *lines_[line.index()];
  const std::size_t conflicts_before = conflicts_.size();
  touch_line(line);
  mesh_.move(constraint(line), to.points);
  take_values(line, checked);
  make_room();
  touch_line(line);
  if (firm_ && checked.kind != LineKind::soft) firm_->move(lines_[line.index()]->firm, to);
  finish_edit();
  undo_if_refused(conflicts_before, [&] {
    move(line, {.points = points_before,
                .values = values_before.left,
                .left = values_before.left,
                .right = values_before.right});
  });
}

void Field::translate(LineId line, Point by) {
  expect(line);
  std::vector<Point> moved = points(line);
  for (Point& p : moved) p = {p.x + by.x, p.y + by.y};
  const Values values = *lines_[line.index()];
  move(line, {.points = moved, .values = values.left, .left = values.left, .right = values.right});
}

void Field::remove(LineId line) {
  expect(line);
  touch_line(line);
  mesh_.remove(constraint(line));
  const std::unique_ptr<Values> values = std::move(lines_[line.index()]);
  if (firm_ && !values->firm.is_none()) firm_->remove(values->firm);
  if (values->kind == LineKind::soft && --soft_lines_ == 0) firm_.reset();
  make_room();
  finish_edit();
}

void Field::take_values(LineId id, const Line& line) {
  Values& values = *lines_[id.index()];
  const std::span<const double> left = values.kind == LineKind::feature ? line.values : line.left;
  if (values.kind == LineKind::feature || values.kind == LineKind::wall)
    values.left.assign(left.begin(), left.end());
  if (values.kind == LineKind::wall) values.right.assign(line.right.begin(), line.right.end());
}

/// An edit that made a conflict is taken back. None of those before can come again by that.
void Field::undo_if_refused(std::size_t conflicts_before, const std::function<void()>& undo) {
  if (policy_ != OnConflict::refuse || conflicts_.size() <= conflicts_before) return;
  Conflict conflict;
  for (const auto& [v, here] : conflicts_) conflict = here.front();
  undo();
  refuse("at ", conflict.place, ": values ", conflict.claims.front().value, " and ",
         conflict.claims.back().value, " at one place");
}

// What is kept beside the triangulation.

void Field::make_room() {
  if (const std::size_t edges = mesh_.edge_bound(); edges > values_.size()) {
    values_.resize(edges, std::numeric_limits<double>::quiet_NaN());
    derived_.resize(edges);
    gradients_.resize(edges);
  }
  if (const std::size_t vertices = mesh_.vertex_bound(); vertices > first_sample_.size()) {
    first_sample_.resize(vertices);
    derived_state_.resize(vertices);
    rises_.resize(vertices);
  }
  if (mesh_.constraint_bound() > samples_.size()) samples_.resize(mesh_.constraint_bound());
}

void Field::list(SampleId sample, double value, std::uint64_t order) {
  samples_[sample.index()] = {.value = value, .order = order};
  list_at_vertex(sample);
}

void Field::list_at_vertex(SampleId sample) {
  Given& given = samples_[sample.index()];
  given.vertex = mesh_.first_vertex(constraint(sample));
  given.next_here = std::exchange(first_sample_[given.vertex.index()], sample);
  touch(given.vertex);
}

void Field::unlist_at_vertex(SampleId sample) {
  const Given& given = samples_[sample.index()];
  SampleId* here = &first_sample_[given.vertex.index()];
  while (*here != sample) here = &samples_[here->index()].next_here;
  *here = given.next_here;
  touch(given.vertex);
}

void Field::touch(VertexId v) { touched_.push_back(v); }

/// The vertices along a line, as it is or as it will no longer be.
void Field::touch_line(LineId line) {
  for (const EdgeId e : mesh_.pieces(constraint(line))) {
    touch(mesh_.from(e));
    touch(mesh_.to(e));
  }
}

void Field::touch_only_vertex() {
  std::uint32_t v = 1;
  while (!mesh_.is_vertex(VertexId(v))) ++v;
  touch(VertexId(v));
}

/// Gives corners their values after an edit: where it made triangles, and what it touched.
void Field::finish_edit(bool has_changed_triangles) {
  ++epoch_;
  if (has_changed_triangles)
    for (const TriangleId t : mesh_.changes().made)
      for (unsigned corner = 0; corner < 3; ++corner)
        touch(mesh_.from(Triangulation::edge(t, corner)));
  if (mesh_.vertex_count() == 1) touch_only_vertex();
  cdt::keep_each_once(touched_);
  for (const VertexId v : touched_) settle(v);
  for (const VertexId v : touched_) forget_gradients_around(v);
  touched_.clear();
}

void Field::rebuild() {
  ++epoch_;
  touched_.clear();
  conflicts_.clear();
  for (std::uint32_t v = 1; v < mesh_.vertex_bound(); ++v) settle(VertexId(v));
  std::fill(rises_.begin(), rises_.end(), Rise{});
}

/// All but the soft lines, once more.
void Field::make_firm() {
  firm_ = std::make_unique<Field>(policy_ == OnConflict::first ? policy_ : OnConflict::mean);
  std::vector<Sample> samples;
  std::vector<SampleId> ids;
  for (std::uint32_t i = 0; i < samples_.size(); ++i) {
    if (!is_sample(SampleId(i))) continue;
    ids.push_back(SampleId(i));
    samples.push_back(sample(ids.back()));
  }
  const std::vector<SampleId> firm = firm_->insert(samples);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    samples_[ids[i].index()].firm = firm[i];
    firm_->samples_[firm[i].index()].order = samples_[ids[i].index()].order;
  }
  for (std::uint32_t i = 0; i < lines_.size(); ++i) {
    if (!lines_[i] || lines_[i]->kind == LineKind::soft) continue;
    const std::vector<Point> along = points(LineId(i));
    const LineId copy = firm_->insert(Line{.points = along,
                                           .kind = lines_[i]->kind,
                                           .values = lines_[i]->left,
                                           .left = lines_[i]->left,
                                           .right = lines_[i]->right,
                                           .ends = mesh_.ends(ConstraintId(i))});
    lines_[i]->firm = copy;
    firm_->lines_[copy.index()]->order = lines_[i]->order;
  }
  firm_->order_ = order_;
  firm_->rebuild();
}

}  // namespace loft::fields
