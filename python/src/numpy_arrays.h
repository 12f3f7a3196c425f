// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vectors of numbers as NumPy arrays that own them, without a copy.
#ifndef KINETRI_PYTHON_NUMPY_ARRAYS_H
#define KINETRI_PYTHON_NUMPY_ARRAYS_H

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace kinetri::python {

namespace py = pybind11;

/// A contiguous array, whose shape the package's Python code has checked.
template <class T>
using Array = py::array_t<T, py::array::c_style>;

template <class T>
std::span<const T> span_of(const Array<T>& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

/// An array of numbers of the type T that owns the vector, whose elements are rows of `columns`
/// numbers; flat if that is 0.
template <class T, class Row>
py::array_t<T> array_of(std::vector<Row> rows, std::size_t columns = 0) {
  static_assert(sizeof(Row) % sizeof(T) == 0);
  auto owned = std::make_unique<std::vector<Row>>(std::move(rows));
  const auto numbers = static_cast<py::ssize_t>(owned->size() * (sizeof(Row) / sizeof(T)));
  const auto* const data = reinterpret_cast<const T*>(owned->data());
  const py::capsule owner(owned.get(),
                          [](void* vector) { delete static_cast<std::vector<Row>*>(vector); });
  owned.release();
  if (columns == 0) return py::array_t<T>(numbers, data, owner);
  const auto width = static_cast<py::ssize_t>(columns);
  return py::array_t<T>({numbers / width, width}, data, owner);
}

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_NUMPY_ARRAYS_H
