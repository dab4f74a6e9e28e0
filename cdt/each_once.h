// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

namespace loft::cdt {

/// Sorts by a key and keeps one of those with the same.
template <class Value, class Key = std::identity>
void keep_each_once(std::vector<Value>& values, Key key = {}) {
  std::sort(values.begin(), values.end(),
            [&](const Value& a, const Value& b) { return key(a) < key(b); });
  values.erase(std::unique(values.begin(), values.end(),
                           [&](const Value& a, const Value& b) { return key(a) == key(b); }),
               values.end());
}

}  // namespace loft::cdt
