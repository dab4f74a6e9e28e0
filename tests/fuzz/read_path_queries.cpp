// SPDX-License-Identifier: MIT
// Tables of queries; what is read of them can be asked.
#include "io/planar/path_queries.h"
#include "mesh/admitted.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  const std::string text = fuzz::text_of(bytes, size);
  fuzz::try_to([&] {
    const auto queries = io::read_path_queries_csv(text, "a.csv");
    fuzz::require(!queries.empty(), "a table without queries");
    for (const io::PathQuery& query : queries) {
      for (const double value : {query.from.x, query.from.y, query.to.x, query.to.y})
        fuzz::require(admitted::planar.admits(value),
                      "a coordinate that a triangulation does not take");
      fuzz::require(!query.radius || admitted::length.admits_length(*query.radius),
                    "a radius that no disc has");
    }
  });
  return 0;
}
