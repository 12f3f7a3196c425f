// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/triangulation/edge_changes.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace kinetri::detail {
namespace {

// Sorts elements, which are few most of the time, by `key(element)`.
template <class Element, class Key>
void sort_few(std::span<Element> elements, const Key& key) {
  constexpr std::size_t few = 16;
  if (elements.size() > few) {
    std::ranges::sort(elements, {}, key);
    return;
  }
  for (std::size_t i = 1; i < elements.size(); ++i) {
    const Element element = elements[i];
    const auto its_key = key(element);
    std::size_t k = i;
    for (; k > 0 && its_key < key(elements[k - 1]); --k) elements[k] = elements[k - 1];
    elements[k] = element;
  }
}

// Sorts elements by the names of their edges `edge_of(element)`.
template <class Element, class Edge_of>
void sort_by_edge(std::vector<Element>& elements, const Edge_of& edge_of) {
  const auto key = [&](const Element& element) { return edge_key(edge_of(element)); };
  constexpr std::size_t ids_for_each_element = 8;
  std::size_t ids = 0;
  for (const Element& element : elements) {
    ids = std::max(ids, std::size_t{ids_of(edge_of(element))[0]} + 1);
  }
  if (ids > ids_for_each_element * elements.size()) {
    std::ranges::sort(elements, {}, key);
    return;
  }
  // By the smaller id by counting, then by the greater one.
  std::vector<std::uint32_t> ends(ids + 1);
  for (const Element& element : elements) ++ends[ids_of(edge_of(element))[0] + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Element> sorted(elements.size());
  for (const Element& element : elements) sorted[ends[ids_of(edge_of(element))[0]]++] = element;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : ends) {
    sort_few(std::span(sorted).subspan(begin, end - begin), key);
    begin = end;
  }
  elements = std::move(sorted);
}

}  // namespace

template <class Edge_name>
void sort_edges(std::vector<Edge_name>& edges) {
  sort_by_edge(edges, std::identity());
}

template <class Edge_name>
auto Edge_changes<Edge_name>::take() -> std::vector<Change> {
  sort_by_edge(notes_, [](const Change& change) -> const Edge_name& { return change.edge; });
  std::vector<Change> result;
  result.reserve(notes_.size());
  for (const Change& note : notes_) {
    if (result.empty() || edge_key(result.back().edge) != edge_key(note.edge)) {
      result.push_back(note);
    } else {
      result.back().net += note.net;
    }
  }
  notes_.clear();
  return result;
}

template void sort_edges(std::vector<Edge_ids>&);
template void sort_edges(std::vector<Periodic_edge>&);
template class Edge_changes<Edge_ids>;
template class Edge_changes<Periodic_edge>;

}  // namespace kinetri::detail
