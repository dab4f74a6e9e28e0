// SPDX-License-Identifier: MIT
// Lays a surface through values, and uses nothing that this does not stand on.
#include <fields/field.h>

int main() {
  using namespace loft::fields;
  Field field;
  field.insert(Sample{{0, 0}, 0});
  field.insert(Sample{{4, 0}, 4});
  field.insert(Sample{{0, 4}, 8});
  return field.value({1, 1}) == 3.0 ? 0 : 1;
}
