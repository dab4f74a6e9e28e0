// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>

#include "cdt/triangulation.h"

namespace loft::cdt {

/// How a triangulation is written.
enum class Form {
  text,    ///< lines to read, to compare and to mend by hand
  binary,  ///< about half the size, somewhat faster, and with a checksum
};

/// Writes the whole state of a triangulation, so that load() gives one that cannot be told from it:
/// the same ids, the same answers, and after the same edits still the same ids and answers. The
/// same bytes for the same state, on every machine. Open `out` as binary on systems where that
/// matters. Cost: linear. Failure: as always, `out` tells whether it took everything.
///
/// Both forms have the same fields in the same order. First single ones: epsilon, whether changes
/// are recorded, where the last edit was, an edge from the infinite vertex, and below which segment
/// blocks are as long as they were asked. Then tables, each with its number of rows:
///
///     vertices     x, y, an edge from it, how many points of constraints and insertions it holds
///     triangles    three corners, the three twins of its edges
///     constraints  first vertex, first segment, number of segments, whether it is closed, the next
///                  constraint without length at that vertex
///     segments     from, to, constraint
///     passages     an edge, then the segments along it; the twin's are the same
///     free_...     ids to be used again, the last one first; blocks of segments by their class
///     snaps        segment, x, y
///     cells        of the grid that remembers a vertex for each cell: a row of cells a row
///
/// Text: `loft-cdt 1 text`, where 1 is the version of the format; a field or a table a line,
/// `vertices 3`, then a line for each row, which in the first four tables begins with its id,
/// `v2 0.5 1 e7 1` or `v2 free`; `end`. Numbers are the shortest that read back bit for bit; ids
/// have the letters that they print with, `-` is none; `s3+` is segment 3 towards the larger end of
/// the edge, `s3-` against that.
///
/// Binary: eight bytes of magic, the version as four; then the fields, little-endian: numbers as
/// IEEE 754 of eight bytes, ids and counts as four, none as ffffffff, truths as one byte; in the
/// first four tables, rows begin with a byte that says whether there is something, and have zeros
/// and none if not; last the 64-bit FNV-1a hash of everything before it.
void save(const Triangulation& mesh, std::ostream& out, Form form);

/// Reads what save() wrote; which form it is the first byte says. What follows in the stream stays
/// there. changes() of the result is empty.
///
/// Everything is examined, by check() too: what is returned is a valid triangulation, though not
/// necessarily one that edits would lead to. Throws std::invalid_argument if anything does not fit,
/// with a message that says what, and in which line (text) or at which byte (binary) it is.
/// Memory: in proportion to what there is to read, whatever it says about itself.
/// Cost: linear, as check().
[[nodiscard]] Triangulation load(std::istream& in);

}  // namespace loft::cdt
