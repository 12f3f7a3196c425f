// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checkpoints of tiny simulations, with walls and in a periodic box, changed by bytes and given a
// right checksum: each is refused, or makes a simulation that passes all audits, and is the same
// text when it is written, read and written again.
#include <boost/crc.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <sstream>
#include <variant>

#include "fuzz/fuzz.h"
#include "kinetri/io/checkpoint_file.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {
namespace {

using test::Fuzz_input;
using test::require;
using Plane = Linear_kinetic_traits_2;
using Periodic = Periodic_kinetic_traits_2;

// Discs in a box, three of them in motion, and two changes that are scheduled.
template <class Traits>
std::string original(const Simulation_options& options, const Traits& traits,
                     const std::optional<Periodic_box_2>& box) {
  Simulation_2<Traits> simulation(
      {{{2, 2}, {1, 0.5}, 0}, {{7, 2}, {-1, 0.25}, 0}, {{5, 7}, {0, -1}, 0}, {{1, 9}, {0, 0}, 0}},
      options, 0, traits);
  simulation.advance_to(2.5);
  simulation.schedule_motion(Algebraic_number(4.0), 3, {{1, 9}, {1, -1}, 4});
  simulation.schedule_erase(Algebraic_number(Rational(14, 3)), 1);
  std::ostringstream out;
  write_checkpoint(out, {simulation.snapshot(), "elastic", {}, box});
  return out.str();
}

std::string original(bool is_periodic) {
  Simulation_options options;
  options.radius = 1;
  options.response = collide_elastically;
  options.max_contacts_per_instant = 100;
  if (is_periodic) {
    const Periodic_box_2 box({{10, 0}, {0, 0}, 0}, {{1, 10}, {0.5, 0}, 0});
    return original(options, Periodic(box), box);
  }
  options.box = Box_2{0, 0, 10, 10};
  return original(options, Plane(), std::nullopt);
}

std::string signed_anew(const std::string& text) {
  const std::string content = text.substr(0, text.rfind("checksum "));
  boost::crc_32_type crc;
  crc.process_bytes(content.data(), content.size());
  char line[20];
  std::snprintf(line, sizeof line, "checksum %08x\n", static_cast<unsigned>(crc.checksum()));
  return content + line;
}

std::string written(const Checkpoint& checkpoint) {
  std::ostringstream out;
  write_checkpoint(out, checkpoint);
  return out.str();
}

Checkpoint read(const std::string& text) {
  std::istringstream in(text);
  return read_checkpoint(in, "input");
}

void check(const std::string& text) {
  const Checkpoint checkpoint = read(text);
  const std::string again = written(checkpoint);
  require(written(read(again)) == again, "another text when read and written again");
  const auto go_on = [&]<class Traits>(const Traits& traits) {
    const auto& snapshot = std::get<Simulation_snapshot<Traits>>(checkpoint.simulation);
    auto simulation = Simulation_2<Traits>::restore(
        snapshot, snapshot.has_response ? collide_elastically : nullptr, traits);
    const Audit_report report = simulation.audit(Audit_level::certificates);
    require(report.passed(), report.passed() ? "" : report.failures.front());
    simulation.step();
  };
  if (std::holds_alternative<Simulation_snapshot<Plane>>(checkpoint.simulation)) go_on(Plane());
  if (std::holds_alternative<Simulation_snapshot<Periodic>>(checkpoint.simulation)) {
    go_on(Periodic(checkpoint.periodic_box.value()));
  }
}

}  // namespace
}  // namespace kinetri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string originals[] = {kinetri::original(false), kinetri::original(true)};
  kinetri::test::Fuzz_input input(data, size);
  std::string text = originals[input.integer(0, 1)];
  const std::size_t first = text.find('\n') + 1;
  for (int changes = input.integer(0, 3); changes > 0; --changes) {
    const std::size_t end = text.rfind("checksum ");
    const std::size_t place = first + (256u * input.byte() + input.byte()) % (end - first);
    const int kind = input.integer(0, 2);
    if (kind == 0) {
      text.erase(place, std::min<std::size_t>(1 + input.byte() % 8u, end - place));
    } else if (kind == 1) {
      text.insert(place, 1, static_cast<char>(input.byte()));
    } else {
      constexpr char bytes[] = "0123456789-.,[]{}\"e/nt";
      text[place] = bytes[input.byte() % (sizeof bytes - 1)];
    }
  }
  try {
    kinetri::check(kinetri::signed_anew(text));
  } catch (const kinetri::Input_error&) {
  } catch (const kinetri::Snapshot_error&) {
  } catch (const kinetri::Periodic_box_error&) {             // a point far away
  } catch (const kinetri::Periodic_offset_error&) {          // or one that is fast
  } catch (const kinetri::Contact_error&) {                  // discs on top of each other
  } catch (const kinetri::Outside_box_error&) {              // to where a scheduled change leads
  } catch (const kinetri::Coincident_trajectories_error&) {  // which a contact has made equal
  }
  return 0;
}
