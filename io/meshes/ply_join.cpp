// SPDX-License-Identifier: MIT
#include "io/meshes/ply_join.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/bytes/atomic_file.h"
#include "io/bytes/checksum.h"
#include "io/bytes/file.h"
#include "io/bytes/little_endian.h"
#include "io/bytes/problems.h"
#include "io/meshes/ply_part.h"
#include "io/meshes/ply_records.h"
#include "reconstruct/defect.h"
#include "reconstruct/reconstruct.h"

namespace loft::io {

namespace {

constexpr std::size_t join_block = std::size_t{1} << 20U;

/// A stretch of a file.
struct Stretch {
  std::uint64_t begin = 0;
  std::uint64_t size = 0;
};

/// A part's file: where everything is in it.
class PartFile {
 public:
  explicit PartFile(const std::filesystem::path& path)
      : path_(path), header_(read_ply_part_header(path)) {
    const bool is_labelled = header_.is_labelled();
    vertex_size_ = ply_vertex_size(is_labelled);
    face_size_ = ply_face_size(is_labelled);
    header_size_ = header_.text().size();
    first_vertices_.push_back(0);
    first_faces_.push_back(0);
    first_seam_faces_.push_back(0);
    for (const PartSizes& sizes : header_.note.surfaces) {
      first_vertices_.push_back(first_vertices_.back() + vertex_count(sizes));
      first_faces_.push_back(first_faces_.back() + face_count(sizes));
      first_seam_faces_.push_back(first_seam_faces_.back() + seam_face_count(sizes));
    }
  }

  [[nodiscard]] std::string name() const { return path_.string(); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const PlyPartNote& note() const { return header_.note; }
  [[nodiscard]] const PlyPartHeader& header() const { return header_; }
  [[nodiscard]] const PartSizes& sizes(std::size_t label) const {
    return header_.note.surfaces[label];
  }
  [[nodiscard]] std::size_t vertex_size() const { return vertex_size_; }
  [[nodiscard]] std::size_t face_size() const { return face_size_; }

  /// What faces call the first vertex of a label.
  [[nodiscard]] std::uint64_t first_vertex(std::size_t label) const {
    return first_vertices_[label];
  }
  /// Vertices of a label, from one on.
  [[nodiscard]] Stretch vertices(std::size_t label, std::uint64_t first,
                                 std::uint64_t count) const {
    return {header_size_ + (first_vertices_[label] + first) * vertex_size_, count * vertex_size_};
  }
  [[nodiscard]] Stretch faces(std::size_t label, std::uint64_t first, std::uint64_t count) const {
    return {faces_begin() + (first_faces_[label] + first) * face_size_, count * face_size_};
  }
  [[nodiscard]] Stretch seam_faces(std::size_t label, std::uint64_t first,
                                   std::uint64_t count) const {
    return {seams_begin() + (first_seam_faces_[label] + first) * ply_seam_face_size,
            count * ply_seam_face_size};
  }
  /// All but the checksum.
  [[nodiscard]] Stretch checked() const {
    return {0, seams_begin() + first_seam_faces_.back() * ply_seam_face_size};
  }

  /// Opens the file at a place.
  [[nodiscard]] std::ifstream open(std::uint64_t place) const {
    std::ifstream file(path_, std::ios::binary);
    if (file) file.seekg(static_cast<std::streamoff>(place));
    if (!file) throw FileError(Access::read, path_, last_cause());
    return file;
  }

  /// Calls take(bytes) for all of a stretch, in blocks of whole records.
  template <class Take>
  void read(Stretch stretch, std::size_t record_size, Take take) const {
    if (stretch.size == 0) return;
    std::ifstream file = open(stretch.begin);
    const std::uint64_t block = (join_block / record_size + 1) * record_size;
    std::string bytes(static_cast<std::size_t>(std::min(block, stretch.size)), '\0');
    for (std::uint64_t left = stretch.size; left > 0;) {
      bytes.resize(static_cast<std::size_t>(std::min(block, left)));
      read(file, bytes);
      left -= bytes.size();
      take(bytes);
    }
  }

  /// Fills the bytes with those that come.
  void read(std::ifstream& file, std::string& bytes) const {
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file) throw FileError(Access::read, path_, "it changed while it was being read");
  }

 private:
  [[nodiscard]] std::uint64_t faces_begin() const {
    return header_size_ + first_vertices_.back() * vertex_size_;
  }
  [[nodiscard]] std::uint64_t seams_begin() const {
    return faces_begin() + first_faces_.back() * face_size_;
  }

  std::filesystem::path path_;
  PlyPartHeader header_;
  std::size_t vertex_size_ = 0;
  std::size_t face_size_ = 0;
  std::uint64_t header_size_ = 0;
  std::vector<std::uint64_t> first_vertices_;  // of each label, and behind the last
  std::vector<std::uint64_t> first_faces_;
  std::vector<std::uint64_t> first_seam_faces_;
};

std::string range_text(SlabRange range) {
  return std::to_string(range.first) + ".." + std::to_string(range.bound);
}

/// Gathers what is wrong.
class JoinProblems {
 public:
  template <class Do>
  void attempt(Do doing) {
    try {
      doing();
    } catch (const InputError& error) {
      problems_.add(error.what());
    } catch (const FileError& error) {
      problems_.add(error.what());
    }
  }
  void add(const std::string& problem) { problems_.add(problem); }
  void raise() const { problems_.raise("join"); }

 private:
  Problems problems_;
};

std::string value_or_none(const std::map<std::string, std::string>& origin,
                          const std::string& what) {
  const auto found = origin.find(what);
  return found == origin.end() ? "none" : found->second;
}

/// In what two parts differ that must not; empty if in nothing.
std::string differences(const PartFile& part, const PartFile& other) {
  const auto& said = part.note().origin;
  const auto& there = other.note().origin;
  if (value_or_none(said, "stack") != value_or_none(there, "stack") ||
      part.note().slab_count != other.note().slab_count)
    return "is of another stack than " + other.name();
  std::map<std::string, std::string> all = said;
  all.insert(there.begin(), there.end());
  std::string text;
  for (const auto& [what, value] : all) {
    const std::string here = value_or_none(said, what);
    const std::string beyond = value_or_none(there, what);
    if (here != beyond) text += (text.empty() ? "" : "; ") + what + ' ' + here + ", not " + beyond;
  }
  if (!text.empty()) return "was made with other options than " + other.name() + ": " + text;
  if (part.header().labels != other.header().labels) return "has other labels than " + other.name();
  return text;
}

void compare_origins(const std::vector<PartFile>& parts, JoinProblems& problems) {
  for (std::size_t i = 1; i < parts.size(); ++i)
    if (const std::string text = differences(parts[i], parts[0]); !text.empty())
      problems.add(parts[i].name() + ' ' + text);
}

void compare_ranges(const std::vector<PartFile>& sorted, JoinProblems& problems) {
  const auto miss = [&](std::size_t first, std::size_t bound) {
    problems.add("no part has the slabs " + range_text({first, bound}));
  };
  std::size_t bound = 0;
  const PartFile* highest = nullptr;  // of those so far
  for (const PartFile& part : sorted) {
    const SlabRange range = part.note().range;
    if (range.first > bound) miss(bound, range.first);
    if (range.first < bound)
      problems.add(highest->name() + " and " + part.name() + " both have the slabs " +
                   range_text({range.first, std::min(bound, range.bound)}));
    if (range.bound <= bound) continue;
    bound = range.bound;
    highest = &part;
  }
  if (bound < sorted.front().note().slab_count) miss(bound, sorted.front().note().slab_count);
}

/// Reads a part through: its checksum, and that faces name vertices that are there.
class PartCheck {
 public:
  PartCheck(const PartFile& part, const std::function<void(std::uint64_t)>& follow)
      : part_(part), follow_(follow) {}

  void run() {
    compare_checksum();
    for (std::size_t label = 0; label < part_.note().surfaces.size(); ++label) check_faces(label);
  }

 private:
  void compare_checksum() {
    std::uint64_t sum = no_checksum;
    const Stretch all = part_.checked();
    part_.read(all, 1, [&](const std::string& bytes) {
      sum = checksum(bytes, sum);
      follow_(bytes.size());
    });
    std::uint64_t said = 0;
    part_.read({all.size, ply_checksum_size}, ply_checksum_size,
               [&](const std::string& bytes) { said = get<std::uint64_t>(bytes.data()); });
    if (sum != said) fail();
  }

  void check_faces(std::size_t label) const {
    const PartSizes& sizes = part_.sizes(label);
    const std::uint64_t count = vertex_count(sizes);
    part_.read(part_.faces(label, 0, face_count(sizes)), part_.face_size(),
               [&](const std::string& bytes) {
                 for (std::size_t at = 0; at < bytes.size(); at += part_.face_size())
                   check_face(bytes.data() + at, part_.first_vertex(label), count);
               });
  }

  void check_face(const char* face, std::uint64_t first, std::uint64_t count) const {
    if (face[0] != 3) fail();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t corner = get<std::uint32_t>(face + ply_face_corners + 4 * i);
      if (corner < first || corner - first >= count) fail();
    }
  }

  [[noreturn]] void fail() const {
    throw InputError(part_.name() + ": is damaged: its content is not what was written");
  }

  const PartFile& part_;
  const std::function<void(std::uint64_t)>& follow_;
};

/// Where the vertices of a part's surface stand among those of the whole, by kind.
struct Offsets {
  std::uint64_t plain = 0;
  std::uint64_t doubled = 0;
  std::uint64_t midpoints = 0;
};

/// One label's surface in all parts that have something of it, from low to high.
class JoinedLabel {
 public:
  JoinedLabel(const std::vector<PartFile>& sorted, std::size_t label) : label_(label) {
    for (const PartFile& part : sorted) {
      const PartSizes& sizes = part.sizes(label);
      if (vertex_count(sizes) == 0 && face_count(sizes) == 0) continue;
      parts_.push_back(&part);
      offsets_.push_back(end_);
      end_.plain += sizes.plain;
      end_.doubled += sizes.doubled;
      end_.midpoints += sizes.midpoints;
      faces_ += face_count(sizes);
    }
  }

  [[nodiscard]] std::uint64_t vertex_count_of_all() const {
    return end_.plain + end_.doubled + end_.midpoints;
  }
  [[nodiscard]] std::uint64_t face_count_of_all() const { return faces_; }

  /// Whether neighbours have in common what they must; notes where they have not.
  void compare_seams(JoinProblems& problems) const {
    if (parts_.empty()) return;
    const PartSizes& lowest = parts_.front()->sizes(label_);
    const PartSizes& highest = parts_.back()->sizes(label_);
    if (lowest.lower_doubled != 0 || lowest.lower_cuts != 0 || lowest.lower_seam != 0)
      problems.add(parts_.front()->name() + ": is sewn on something below that no part has");
    if (highest.upper != 0 || highest.upper_midpoints != 0 || highest.upper_cuts != 0 ||
        highest.upper_seam != 0)
      problems.add(parts_.back()->name() + ": is sewn on something above that no part has");
    for (std::size_t i = 0; i + 1 < parts_.size(); ++i)
      if (!do_fit(i))
        problems.add(parts_[i]->name() + " and " + parts_[i + 1]->name() +
                     " do not fit where they meet; make both anew");
  }

  /// Those of slices and slabs, then doubled ones, then midpoints.
  template <class Write>
  void write_vertices(const Write& write) const {
    const auto copy = [&](auto first, auto count) {
      for (const PartFile* part : parts_) {
        const PartSizes& sizes = part->sizes(label_);
        part->read(part->vertices(label_, first(sizes), count(sizes)), part->vertex_size(), write);
      }
    };
    copy([](const PartSizes&) { return std::uint64_t{0}; },
         [](const PartSizes& s) { return s.plain; });
    copy(first_doubled, [](const PartSizes& s) { return s.doubled; });
    copy(first_midpoint, [](const PartSizes& s) { return s.midpoints; });
  }

  /// `first`: the number of the label's first vertex in the whole.
  template <class Write>
  void write_faces(std::uint64_t first, const Write& write) const {
    for (std::size_t i = 0; i < parts_.size(); ++i)
      copy_faces(i, 0, parts_[i]->sizes(label_).faces, first, write);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const PartSizes& sizes = parts_[i]->sizes(label_);
      copy_faces(i, sizes.faces + sizes.lower_cuts, sizes.cuts, first, write);
      if (i + 1 < parts_.size()) write_seam(i, first, write);
    }
  }

 private:
  static std::uint64_t first_lower_doubled(const PartSizes& s) {
    return std::uint64_t{s.plain} + s.upper;
  }
  static std::uint64_t first_doubled(const PartSizes& s) {
    return first_lower_doubled(s) + s.lower_doubled;
  }
  static std::uint64_t first_midpoint(const PartSizes& s) { return first_doubled(s) + s.doubled; }

  /// Whether a part and the next one have in common what they must.
  [[nodiscard]] bool do_fit(std::size_t i) const {
    const PartSizes& low = parts_[i]->sizes(label_);
    const PartSizes& high = parts_[i + 1]->sizes(label_);
    if (low.upper > high.plain || high.lower_doubled > low.doubled ||
        low.upper_midpoints > high.midpoints || low.upper_seam != high.lower_seam ||
        std::uint64_t{low.upper_cuts} + high.lower_cuts != low.upper_seam)
      return false;
    return are_same(i, low.plain, 0, low.upper) &&
           are_same(i, first_midpoint(low) - high.lower_doubled, first_lower_doubled(high),
                    high.lower_doubled) &&
           are_same(i, first_midpoint(low) + low.midpoints, first_midpoint(high),
                    low.upper_midpoints);
  }

  /// Whether so many vertices of a part and the next one are the same.
  [[nodiscard]] bool are_same(std::size_t i, std::uint64_t first, std::uint64_t first_above,
                              std::uint64_t count) const {
    const PartFile& low = *parts_[i];
    const PartFile& high = *parts_[i + 1];
    std::uint64_t place = high.vertices(label_, first_above, 0).begin;
    bool is_same = true;
    low.read(low.vertices(label_, first, count), low.vertex_size(), [&](const std::string& bytes) {
      high.read({place, bytes.size()}, bytes.size(),
                [&](const std::string& others) { is_same = is_same && bytes == others; });
      place += bytes.size();
    });
    return is_same;
  }

  template <class Write>
  void copy_faces(std::size_t i, std::uint64_t first, std::uint64_t count,
                  std::uint64_t first_vertex, const Write& write) const {
    const PartFile& part = *parts_[i];
    part.read(part.faces(label_, first, count), part.face_size(), [&](std::string& bytes) {
      for (std::size_t at = 0; at < bytes.size(); at += part.face_size())
        renumber_face(i, bytes.data() + at, first_vertex);
      write(bytes);
    });
  }

  void renumber_face(std::size_t i, char* face, std::uint64_t first_vertex) const {
    for (std::size_t k = 0; k < 3; ++k) {
      char* const corner = face + ply_face_corners + 4 * k;
      const std::uint64_t local = get<std::uint32_t>(corner) - parts_[i]->first_vertex(label_);
      put(corner, static_cast<std::uint32_t>(first_vertex + number(i, local)));
    }
  }

  /// Of a part's vertex, among the label's.
  [[nodiscard]] std::uint64_t number(std::size_t i, std::uint64_t local) const {
    const PartSizes& sizes = parts_[i]->sizes(label_);
    const Offsets& offsets = offsets_[i];
    // The slice above is the first of the next part.
    if (local < first_lower_doubled(sizes)) return offsets.plain + local;
    if (local < first_midpoint(sizes))
      return end_.plain + offsets.doubled + local - first_doubled(sizes);
    return end_.plain + end_.doubled + offsets.midpoints + local - first_midpoint(sizes);
  }

  /// Faces at a seam, in order: each of them has a place in it.
  class SeamFaces {
   public:
    SeamFaces(const PartFile& part, std::size_t label, std::uint64_t first_face,
              std::uint64_t first_place, std::uint32_t count)
        : part_(part),
          faces_(part.open(part.faces(label, first_face, 0).begin)),
          places_(part.open(part.seam_faces(label, first_place, 0).begin)),
          left_(count) {
      next();
    }

    [[nodiscard]] bool is_at(std::uint32_t place) const { return has_ && place_ == place; }
    [[nodiscard]] std::string& face() { return face_; }
    void next() {
      has_ = left_ > 0;
      if (!has_) return;
      --left_;
      face_.resize(part_.face_size());
      part_.read(faces_, face_);
      std::string place(ply_seam_face_size, '\0');
      part_.read(places_, place);
      place_ = get<std::uint32_t>(place.data());
    }

   private:
    const PartFile& part_;
    std::ifstream faces_;
    std::ifstream places_;
    std::uint32_t left_;
    bool has_ = false;
    std::uint32_t place_ = 0;
    std::string face_;
  };

  /// The faces that were cut off where a part and the next one meet.
  template <class Write>
  void write_seam(std::size_t i, std::uint64_t first_vertex, const Write& write) const {
    const PartSizes& low = parts_[i]->sizes(label_);
    const PartSizes& high = parts_[i + 1]->sizes(label_);
    if (low.upper_seam == 0) return;
    SeamFaces below(*parts_[i], label_, low.faces + low.lower_cuts + low.cuts, low.lower_cuts,
                    low.upper_cuts);
    SeamFaces above(*parts_[i + 1], label_, high.faces, 0, high.lower_cuts);
    for (std::uint32_t place = 0; place < low.upper_seam; ++place) {
      const bool is_below = below.is_at(place);
      if (!is_below && !above.is_at(place))
        throw InputError(parts_[i]->name() + " and " + parts_[i + 1]->name() +
                         " do not fit where they meet; make both anew");
      SeamFaces& faces = is_below ? below : above;
      renumber_face(is_below ? i : i + 1, faces.face().data(), first_vertex);
      write(faces.face());
      faces.next();
    }
  }

  std::size_t label_;
  std::vector<const PartFile*> parts_;
  std::vector<Offsets> offsets_;  // of each part
  Offsets end_;                   // behind the last part
  std::uint64_t faces_ = 0;
};

std::vector<PartFile> open_parts(std::span<const std::filesystem::path> paths,
                                 JoinProblems& problems) {
  std::vector<PartFile> parts;
  for (const std::filesystem::path& path : paths)
    problems.attempt([&] { parts.emplace_back(path); });
  return parts;
}

/// Tells which share of some bytes has come by.
class JoinProgress {
 public:
  JoinProgress(const std::function<bool(double)>& follow, std::uint64_t total)
      : follow_(follow), total_(total) {}

  void add(std::uint64_t bytes) {
    done_ += bytes;
    if (follow_ && !follow_(static_cast<double>(done_) / static_cast<double>(total_)))
      throw Cancelled();
  }

 private:
  const std::function<bool(double)>& follow_;
  std::uint64_t total_;
  std::uint64_t done_ = 0;
};

void check_parts(const std::vector<PartFile>& parts, JoinProgress& progress,
                 JoinProblems& problems) {
  const auto follow = [&](std::uint64_t bytes) { progress.add(bytes); };
  for (const PartFile& part : parts) problems.attempt([&] { PartCheck(part, follow).run(); });
}

}  // namespace

JoinedPly join_ply_parts(std::span<const std::filesystem::path> paths,
                         const std::filesystem::path& output,
                         const std::function<bool(double share)>& follow) {
  JoinProblems problems;
  std::vector<PartFile> parts = open_parts(paths, problems);
  std::uint64_t total = 1;
  for (const PartFile& part : parts) total += 2 * part.checked().size;
  JoinProgress progress(follow, total);
  check_parts(parts, progress, problems);
  compare_origins(parts, problems);
  problems.raise();
  std::ranges::stable_sort(parts, {}, [](const PartFile& part) { return part.note().range.first; });
  compare_ranges(parts, problems);
  problems.raise();

  const PlyPartHeader& header = parts.front().header();
  JoinedPly joined{header.labels.size(), 0, 0};
  std::vector<JoinedLabel> labels;
  for (std::size_t i = 0; i < header.labels.size(); ++i) {
    const JoinedLabel& label = labels.emplace_back(parts, i);
    problems.attempt([&] { label.compare_seams(problems); });
    joined.vertices += label.vertex_count_of_all();
    joined.faces += label.face_count_of_all();
  }
  problems.raise();

  AtomicFile file(output);
  const auto write = [&](std::string_view bytes) {
    file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file.stream()) throw FileError(Access::write, output, last_cause());
    progress.add(bytes.size());
  };
  write(ply_header(
      header.labels, header.is_labelled(),
      {static_cast<std::size_t>(joined.vertices), static_cast<std::size_t>(joined.faces)}));
  for (const JoinedLabel& label : labels) label.write_vertices(write);
  std::uint64_t first = 0;
  for (const JoinedLabel& label : labels) {
    label.write_faces(first, write);
    first += label.vertex_count_of_all();
  }
  file.commit();
  return joined;
}

}  // namespace loft::io
