// SPDX-License-Identifier: MIT
#include "cdt/persist.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cdt/check.h"
#include "tests/cdt/constraints.h"
#include "tests/cdt/edits.h"
#include "tests/cdt/player.h"
#include "tests/cdt/random_edits.h"

namespace loft::cdt {
namespace {

constexpr Form all_forms[] = {Form::text, Form::binary};

std::string saved(const Triangulation& mesh, Form form) {
  std::ostringstream out;
  save(mesh, out, form);
  return out.str();
}

Triangulation loaded(const std::string& bytes) {
  std::istringstream in(bytes);
  return load(in);
}

/// Why load() refuses, in its words; empty if it does not.
std::string refusal(const std::string& bytes) {
  try {
    const Triangulation mesh = loaded(bytes);
    const std::string fault = first_fault(mesh);
    return fault.empty() ? "" : "loaded what is wrong: " + fault;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(error.what(), std::string());
    return error.what();
  }
}

void expect_same_vertices(const Triangulation& a, const Triangulation& b) {
  ASSERT_EQ(a.vertex_bound(), b.vertex_bound());
  EXPECT_EQ(a.vertex_count(), b.vertex_count());
  EXPECT_EQ(a.edge(Triangulation::infinite), b.edge(Triangulation::infinite));
  for (std::uint32_t i = 1; i < a.vertex_bound(); ++i) {
    const VertexId v(i);
    ASSERT_EQ(a.is_vertex(v), b.is_vertex(v)) << v;
    ASSERT_EQ(a.point(v), b.point(v)) << v;
    ASSERT_EQ(a.edge(v), b.edge(v)) << v;
    if (a.is_vertex(v)) {
      ASSERT_EQ(a.constraints(v), b.constraints(v)) << v;
    }
  }
}

void expect_same_triangles(const Triangulation& a, const Triangulation& b) {
  ASSERT_EQ(a.triangle_bound(), b.triangle_bound());
  EXPECT_EQ(a.triangle_count(), b.triangle_count());
  for (std::uint32_t i = 0; i < a.edge_bound(); ++i) {
    const EdgeId e(i);
    ASSERT_EQ(a.from(e), b.from(e)) << e;
    if (!a.is_triangle(Triangulation::triangle(e))) continue;
    ASSERT_EQ(a.twin(e), b.twin(e)) << e;
    ASSERT_TRUE(std::ranges::equal(a.passages(e), b.passages(e))) << e;
  }
}

void expect_same_constraints(const Triangulation& a, const Triangulation& b) {
  ASSERT_EQ(a.constraint_bound(), b.constraint_bound());
  EXPECT_EQ(a.constraint_count(), b.constraint_count());
  for (std::uint32_t i = 0; i < a.constraint_bound(); ++i) {
    const ConstraintId c(i);
    ASSERT_EQ(a.is_constraint(c), b.is_constraint(c)) << c;
    if (!a.is_constraint(c)) continue;
    ASSERT_EQ(a.first_vertex(c), b.first_vertex(c)) << c;
    ASSERT_EQ(a.first_segment(c), b.first_segment(c)) << c;
    ASSERT_EQ(a.segments(c).size(), b.segments(c).size()) << c;
    ASSERT_EQ(a.ends(c), b.ends(c)) << c;
    ASSERT_EQ(a.points(c), b.points(c)) << c;
    ASSERT_EQ(a.pieces(c), b.pieces(c)) << c;
  }
  ASSERT_EQ(a.segment_bound(), b.segment_bound());
  for (std::uint32_t i = 0; i < a.segment_bound(); ++i) {
    const SegmentId s(i);
    ASSERT_EQ(a.is_segment(s), b.is_segment(s)) << s;
    if (!a.is_segment(s)) continue;
    ASSERT_EQ(a.segment(s).from, b.segment(s).from) << s;
    ASSERT_EQ(a.segment(s).to, b.segment(s).to) << s;
    ASSERT_EQ(a.segment(s).constraint, b.segment(s).constraint) << s;
  }
  ASSERT_EQ(a.snaps().size(), b.snaps().size());
  for (std::size_t i = 0; i < a.snaps().size(); ++i) {
    ASSERT_EQ(a.snaps()[i].segment, b.snaps()[i].segment);
    ASSERT_EQ(a.snaps()[i].place, b.snaps()[i].place);
  }
}

/// By what anyone can ask, and by what is saved of them.
void expect_same(const Triangulation& a, const Triangulation& b) {
  EXPECT_EQ(a.epsilon(), b.epsilon());
  expect_same_vertices(a, b);
  expect_same_triangles(a, b);
  expect_same_constraints(a, b);
  ASSERT_EQ(saved(a, Form::text), saved(b, Form::text));
  ASSERT_EQ(saved(a, Form::binary), saved(b, Form::binary));
}

/// A little of everything: crossings, overlaps, free slots of each kind, vertices of their own.
Triangulation small_example() {
  Triangulation mesh;
  mesh.insert(std::vector<Point>{{0, 0}, {4, 0}, {4, 3}}, closed);
  const auto gone = mesh.insert(std::vector<Point>{{1, -1}, {1.5, 2}, {-1, 2}, {0.25, 0.25}}, open);
  mesh.insert(std::vector<Point>{{4, 0}, {0, 0}}, open);
  mesh.insert(std::vector<Point>{{2, 1}}, open);
  mesh.insert(std::vector<Point>{{2, 1}, {2, 1}}, closed);
  mesh.insert(std::vector<Point>{{1, -1}, {3, 4}}, open);
  mesh.insert(Point{3, 0.5});
  mesh.remove(gone);
  return mesh;
}

// --- What is saved comes back ---

TEST(Persist, KeepsEverythingThroughRandomEdits) {
  for (const Ground ground : all_grounds) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      SCOPED_TRACE(std::string(name_of(ground)) + ", seed " + std::to_string(seed));
      const Script script = random_script(seed, ground, 80, 12);
      const Form form = all_forms[seed % 2];
      Player original(seed % 4 == 3 ? 1e-3 : 0);
      for (std::size_t i = 0; i < 40; ++i) original.play(script[i]);
      Player again(loaded(saved(original.mesh(), form)), original);
      expect_same(original.mesh(), again.mesh());
      for (std::size_t i = 40; i < script.size(); ++i) {
        original.play(script[i]);
        again.play(script[i]);
      }
      expect_same(original.mesh(), again.mesh());
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Persist, KeepsWhereALargeTriangulationIsSearched) {
  std::mt19937_64 random(1);
  const auto below = [&](std::size_t n) { return static_cast<double>(random() % n) / 10; };
  const auto triangle = [&] {
    const double x = below(300);
    const Point p{x, below(300)};
    return Outline{{p, {p.x + below(20), p.y}, {p.x, p.y + below(20)}}, closed};
  };
  Player original;
  for (std::size_t name = 0; name < 400; ++name)
    original.play({Edit::Kind::insert, name, triangle(), {}});
  ASSERT_GT(original.mesh().vertex_count(), 1000U);
  for (const Form form : all_forms) {
    Player again(loaded(saved(original.mesh(), form)), original);
    expect_same(original.mesh(), again.mesh());
    for (std::size_t i = 0; i < 60; ++i) {
      const Edit removal{Edit::Kind::remove, 3 * i + (form == Form::text ? 0 : 1), {}, {}};
      const Edit insertion{Edit::Kind::insert, 1000 + i, triangle(), {}};
      for (const Edit& edit : {removal, insertion}) {
        original.play(edit);
        again.play(edit);
      }
    }
    expect_same(original.mesh(), again.mesh());
  }
}

TEST(Persist, KeepsTriangulationsWithoutTriangles) {
  std::vector<Triangulation> meshes(6);
  meshes[1].insert(Point{0.1, -0.0});
  meshes[2].remove(meshes[2].insert(std::vector<Point>{{1, 2}}, closed));
  meshes[3].insert(std::vector<Point>{{0, 0}, {3, 3}, {1, 1}}, open);
  meshes[4].remove(meshes[4].insert(std::vector<Point>{{0, 0}, {3, 3}, {1, 1}}, open));
  const auto pair = meshes[5].insert(std::vector<Point>{{0, 0}, {3, 3}}, open);
  meshes[5].insert(std::vector<Point>{{0, 0}}, open);
  meshes[5].remove(pair);
  for (Triangulation& mesh : meshes) {
    for (const Form form : all_forms) {
      Triangulation again = loaded(saved(mesh, form));
      expect_same(mesh, again);
      Triangulation edited = mesh;
      for (Triangulation* m : {&again, &edited}) {
        m->insert(std::vector<Point>{{5, 0}, {0, 5}, {7, 7}, {2, 2}}, closed);
        m->insert(Point{-1, -1});
      }
      expect_same(edited, again);
    }
  }
}

TEST(Persist, KeepsEveryBitOfNumbers) {
  Triangulation mesh(0x1p-1074);
  const std::vector<Point> points{{-0.0, 0.1}, {1e75, -1e75}, {1e-50, 1.0 / 3}, {-1e-50, 7}};
  mesh.insert(points, open);
  for (const Form form : all_forms) {
    const Triangulation again = loaded(saved(mesh, form));
    expect_same(mesh, again);
    EXPECT_EQ(std::signbit(again.points(ConstraintId(0))[0].x), true);
  }
}

TEST(Persist, RecordsChangesAsBefore) {
  Triangulation mesh = small_example();
  mesh.record_changes(true);
  mesh.insert(Point{1, 1});
  Triangulation again = loaded(saved(mesh, Form::binary));
  EXPECT_TRUE(again.changes().made.empty());
  EXPECT_TRUE(again.changes().unmade.empty());
  for (Triangulation* m : {&mesh, &again}) m->insert(Point{1.25, 1});
  EXPECT_EQ(mesh.changes().made, again.changes().made);
  EXPECT_EQ(mesh.changes().unmade, again.changes().unmade);
}

TEST(Persist, LeavesWhatFollowsInTheStream) {
  const Triangulation mesh = small_example();
  for (const Form form : all_forms) {
    std::stringstream stream;
    save(mesh, stream, form);
    save(Triangulation(0.5), stream, form);
    stream << "and more";
    expect_same(load(stream), mesh);
    EXPECT_EQ(load(stream).epsilon(), 0.5);
    std::string rest;
    std::getline(stream, rest);
    EXPECT_EQ(rest, "and more");
  }
}

TEST(Persist, TextIsForReading) {
  Triangulation mesh;
  mesh.insert(std::vector<Point>{{0, 0}, {0.5, 0}}, open);
  mesh.insert(std::vector<Point>{{0, 0}}, open);
  EXPECT_EQ(saved(mesh, Form::text), R"(loft-cdt 1 text
epsilon 0
recording no
last e4
infinite e2
dense -
vertices 2
v1 0 0 e0 2
v2 0.5 0 e3 1
triangles 2
t0 v1 v2 v0 e3 e5 e4
t1 v2 v1 v0 e0 e2 e1
constraints 2
c0 v1 s0 1 no -
c1 v1 s0 0 no -
segments 1
s0 v1 v2 c0
passages 1
e0 s0+
free_vertices 0
free_triangles 0
free_constraints 0
free_blocks 0
snaps 0
levels 0
laid_out_for 0
low inf inf
high -inf -inf
cells 0
end
)");
}

// --- What is damaged is refused ---

TEST(Persist, RefusesEverySingleByteChangedInTheBinaryForm) {
  const std::string bytes = saved(small_example(), Form::binary);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const unsigned change : {0x01U, 0x80U, 0xffU, 0x10U}) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(static_cast<unsigned char>(damaged[i]) ^ change);
      ASSERT_NE(refusal(damaged), "") << "byte " << i;
    }
  }
}

/// With the checksum set right again, so that the examination has to find what is wrong.
TEST(Persist, RefusesOrUnderstandsEveryByteChangedBehindTheChecksum) {
  const std::string bytes = saved(small_example(), Form::binary);
  std::size_t understood = 0;
  for (std::size_t i = 0; i + 8 < bytes.size(); ++i) {
    for (const unsigned change : {0x01U, 0x02U, 0x80U, 0xffU, 0x05U}) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(static_cast<unsigned char>(damaged[i]) ^ change);
      std::uint64_t hash = 0xcbf2'9ce4'8422'2325U;
      for (std::size_t k = 0; k + 8 < damaged.size(); ++k)
        hash = (hash ^ static_cast<unsigned char>(damaged[k])) * 0x0000'0100'0000'01b3U;
      for (unsigned k = 0; k < 8; ++k)
        damaged[damaged.size() - 8 + k] = static_cast<char>(hash >> 8 * k & 0xff);
      const std::string words = refusal(damaged);
      ASSERT_EQ(words.find("loaded what is wrong"), std::string::npos) << words;
      ASSERT_EQ(words.find("checksum"), std::string::npos) << words;
      if (!words.empty()) continue;
      ++understood;  // such as another place for a vertex: all is to be editable then
      Triangulation mesh = loaded(damaged);
      mesh.insert(std::vector<Point>{{-2, -2}, {5, 5}, {2, 0}}, open);
      for (std::uint32_t c = 0; c < mesh.constraint_bound(); ++c)
        if (mesh.is_constraint(ConstraintId(c))) mesh.remove(ConstraintId(c));
      ASSERT_EQ(first_fault(mesh), "");
    }
  }
  EXPECT_GT(understood, 0U);
}

TEST(Persist, RefusesWhatEndsTooSoon) {
  for (const Form form : all_forms) {
    const std::string bytes = saved(small_example(), form);
    // A text whose last line lacks its end is whole all the same.
    const std::size_t whole = form == Form::text ? bytes.size() - 1 : bytes.size();
    for (std::size_t size = 0; size < whole; ++size)
      ASSERT_NE(refusal(bytes.substr(0, size)), "") << size;
  }
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

TEST(Persist, RefusesTextThatLacksALineOrHasOneTwice) {
  const auto lines = lines_of(saved(small_example(), Form::text));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    auto damaged = lines;
    damaged.erase(damaged.begin() + static_cast<std::ptrdiff_t>(i));
    ASSERT_NE(refusal(joined(damaged)), "") << lines[i];
    damaged = lines;
    damaged.insert(damaged.begin() + static_cast<std::ptrdiff_t>(i), lines[i]);
    if (i + 1 < lines.size()) {
      ASSERT_NE(refusal(joined(damaged)), "") << lines[i];
    }
  }
}

TEST(Persist, RefusesOrUnderstandsTextWithOtherNumbers) {
  const auto lines = lines_of(saved(small_example(), Form::text));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = 0; k < lines[i].size(); ++k) {
      for (const char other : {'0', '1', '9', '-', ' ', 'v', 'e'}) {
        auto damaged = lines;
        damaged[i][k] = other;
        const std::string words = refusal(joined(damaged));
        ASSERT_EQ(words.find("loaded what is wrong"), std::string::npos) << words;
      }
    }
  }
}

TEST(Persist, SaysWhatIsWrongAndWhere) {
  const std::string text = saved(small_example(), Form::text);
  const auto lines = lines_of(text);
  const auto with = [&](std::string_view start, const std::string& instead) {
    auto changed = lines;
    const auto line =
        std::ranges::find_if(changed, [&](const std::string& l) { return l.starts_with(start); });
    if (line == changed.end()) return "no line starts with " + std::string(start);
    const auto number = std::to_string(line - changed.begin() + 1);
    *line = instead;
    std::string words = refusal(joined(changed));
    const std::string place = "line " + number + ": ";
    return words.starts_with(place) ? words.substr(place.size()) : number + " but " + words;
  };
  EXPECT_EQ(refusal(""), "line 1: this is missing");
  EXPECT_EQ(refusal("hello\n"), "line 1: this should be \"loft-cdt\"");
  EXPECT_EQ(with("loft-cdt", "loft-cdt 2 text"), "version 2 is not known, only 1 is");
  EXPECT_EQ(with("epsilon", "epsilon -1"), "epsilon should be finite and not negative");
  EXPECT_EQ(with("recording", "recording maybe"), "maybe is neither yes nor no");
  EXPECT_EQ(with("last", "last e99"), "last is e99, which does not fit");
  EXPECT_EQ(with("v1 ", "v1 inf 0 e0 1"),
            "v1 should have coordinates that are finite and not beyond 1e75");
  EXPECT_EQ(with("v2 ", "v3 4 0 e6 3"), "this should be v2");
  EXPECT_EQ(with("v1 ", "v1 0 0 v0 1"), "v0 is no id with e");
  EXPECT_EQ(with("v1 ", "v1 0 0 e0 1 "), "there is more than expected:  ");
  EXPECT_EQ(with("t1 ", "t1 v1 v99 v0 e3 e5 e4"), "t1 has corner v99, which there is not");
  EXPECT_EQ(with("s0 ", "s0 v1 v1 c9"), "s0 is of constraint c9, which there is not");
  EXPECT_EQ(with("end", "ende"), "this should be \"end\"");
  EXPECT_EQ(refusal("\x89lftcdt\n"), "byte 8: the end is missing");
  EXPECT_EQ(refusal("\x89lftcdt\n\x07" + std::string(3, '\0')),
            "byte 8: version 7 is not known, only 1 is");
}

TEST(Persist, RefusesHugeCountsAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  const std::string small = saved(Triangulation(), Form::text);
  for (const std::string& line : lines_of(small)) {
    if (!line.ends_with(" 0") || line == "epsilon 0") continue;
    std::string huge = small;
    const std::size_t place = huge.find(line) + line.size() - 1;
    EXPECT_NE(refusal(huge.replace(place, 1, "4294967295")), "") << line;
  }
  const std::string bytes = saved(Triangulation(), Form::binary);
  for (std::size_t i = 12; i + 4 <= bytes.size(); ++i) {
    std::string huge = bytes;
    EXPECT_NE(refusal(huge.replace(i, 4, "\xff\xff\xff\x7f")), "") << i;
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

}  // namespace
}  // namespace loft::cdt
