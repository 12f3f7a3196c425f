// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/vtu_file.h"

#include <array>
#include <numeric>
#include <ostream>
#include <string_view>
#include <vector>

#include "kinetri/impl/io/bytes.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

constexpr std::uint8_t triangle_cell = 5;  // VTK_TRIANGLE

// VTK's names of types.
constexpr std::string_view type_name(double) {
  return "Float64";
}
constexpr std::string_view type_name(std::uint64_t) {
  return "Int64";  // as VTK's own; values are small enough
}
constexpr std::string_view type_name(std::uint32_t) {
  return "UInt32";
}
constexpr std::string_view type_name(std::uint8_t) {
  return "UInt8";
}

// Writes an array of numbers: their length in bytes and the numbers, in base64.
template <class Number>
void write_array(std::ostream& out, std::string_view name, std::string_view attributes,
                 std::span<const Number> numbers) {
  Bytes data;
  data.add(static_cast<std::uint64_t>(sizeof(Number) * numbers.size()));
  for (const Number number : numbers) data.add(number);
  out << "        <DataArray type=\"" << type_name(Number{}) << "\" Name=\"" << name << '"'
      << attributes << " format=\"binary\">" << data.base64() << "</DataArray>\n";
}

void write_vectors(std::ostream& out, std::string_view name, std::span<const Vector_2> vectors,
                   const std::string& attributes = {}) {
  std::vector<double> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vector_2& v : vectors) numbers.insert(numbers.end(), {v.x, v.y, 0.0});
  write_array<double>(out, name, joined(" NumberOfComponents=\"3\"", attributes), numbers);
}

void write_discs(std::ostream& out, const std::vector<Frame_2::Disc>& discs) {
  std::vector<double> radii;
  std::vector<std::uint8_t> hidden;
  for (const Frame_2::Disc& disc : discs) {
    radii.push_back(disc.radius);
    hidden.push_back(disc.is_hidden ? 1 : 0);
  }
  write_array<double>(out, "radius", "", radii);
  write_array<std::uint8_t>(out, "hidden", "", hidden);
}

// A field has one tuple.
template <class Number>
void write_field(std::ostream& out, const std::string& field, Number value) {
  write_array<Number>(out, field, " NumberOfTuples=\"1\"", std::array<Number, 1>{value});
}

// The frame in the plane that has the images of a periodic box as points.
struct Unwrapped {
  Frame_2 frame;
  std::vector<std::uint8_t> are_images;
};

Unwrapped unwrapped(const Frame_2& frame) {
  Unwrapped result = {frame, std::vector<std::uint8_t>(frame.ids.size(), 0)};
  Frame_2& all = result.frame;
  const auto image = [&](std::size_t point, const Vector_2& shift) {
    if (shift == Vector_2()) return point;
    const Vector_2& place = frame.places[point];
    all.ids.push_back(frame.ids[point]);
    all.places.push_back({place.x + shift.x, place.y + shift.y});
    all.velocities.push_back(frame.velocities[point]);
    result.are_images.push_back(1);
    return all.ids.size() - 1;
  };
  for (std::size_t i = 0; i < frame.triangles.size(); ++i) {
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
      std::size_t& corner = all.triangles[i][k];
      corner = image(corner, frame.periodic->triangle_shifts[i][k - 1]);
    }
  }
  return result;
}

void write_fields(std::ostream& out, const Frame_2& frame) {
  out << "      <FieldData>\n";
  write_field(out, "TimeValue", frame.time);
  write_field(out, "events",
              std::accumulate(frame.events.begin(), frame.events.end(), std::uint64_t{0}));
  for (std::size_t kind = 0; kind < event_kinds; ++kind) {
    write_field(out, joined("events_", name(static_cast<Event_kind>(kind))), frame.events[kind]);
  }
  if (frame.periodic) {
    write_vectors(out, "box", frame.periodic->corners, " NumberOfTuples=\"4\"");
  }
  out << "      </FieldData>\n";
}

void write_cells(std::ostream& out, const Frame_2& frame) {
  std::vector<std::uint64_t> corners;
  std::vector<std::uint64_t> ends;
  for (const auto& triangle : frame.triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
    ends.push_back(corners.size());
  }
  const std::vector<std::uint8_t> types(ends.size(), triangle_cell);
  out << "      <Cells>\n";
  write_array<std::uint64_t>(out, "connectivity", "", corners);
  write_array<std::uint64_t>(out, "offsets", "", ends);
  write_array<std::uint8_t>(out, "types", "", types);
  out << "      </Cells>\n";
}

void write_file(std::ostream& out, const Frame_2& frame,
                const std::vector<std::uint8_t>* are_images) {
  out << "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n"
         "  <UnstructuredGrid>\n";
  write_fields(out, frame);
  out << joined("    <Piece NumberOfPoints=\"", frame.ids.size(), "\" NumberOfCells=\"",
                frame.triangles.size(), "\">\n");
  out << "      <PointData Scalars=\"id\" Vectors=\"velocity\">\n";
  write_array<std::uint32_t>(out, "id", "", frame.ids);
  write_vectors(out, "velocity", frame.velocities);
  if (frame.discs) write_discs(out, *frame.discs);
  if (are_images != nullptr) write_array<std::uint8_t>(out, "image", "", *are_images);
  out << "      </PointData>\n      <CellData/>\n      <Points>\n";
  write_vectors(out, "Points", frame.places);
  out << "      </Points>\n";
  write_cells(out, frame);
  out << "    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace

void write_vtu(std::ostream& out, const Frame_2& frame) {
  if (!frame.periodic) return write_file(out, frame, nullptr);
  const Unwrapped all = unwrapped(frame);
  write_file(out, all.frame, &all.are_images);
}

void write_pvd(std::ostream& out, std::span<const Vtu_frame> frames) {
  out << "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
         "  <Collection>\n";
  for (const Vtu_frame& frame : frames) {
    out << joined("    <DataSet timestep=\"", frame.time, "\" group=\"\" part=\"0\" file=\"",
                  frame.file, "\"/>\n");
  }
  out << "  </Collection>\n</VTKFile>\n";
}

}  // namespace kinetri
