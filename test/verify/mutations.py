#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks Kinetri in one place at a time and prints who notices it: audits, or kinetri-verify. Not a test.

usage: mutations.py VERIFY FOLDER [JOBS [PATTERN]]
       mutations.py check

`check` builds nothing: it looks whether each text that is to be replaced is in the sources as they are.

VERIFY is the checker as it is. FOLDER gets a copy of the sources and its build. With PATTERN, a regular expression,
only mutations whose names it matches. The table has, for each mutation, the number of runs that did not end (refused,
crashed or endless), and of the others of those
- whose log or edges differ from those of the program as it is,
- that the checker refutes,
- that differ, are not refuted, and are found to be true in another way (`is_true`),
- in which an audit failed, and of those in which an audit failed though nothing differs: audits look at the queue.
Runs that differ and are not refuted are described on standard error.
"""
import concurrent.futures
import csv
import pathlib
import re
import resource
import shutil
import subprocess
import sys
from fractions import Fraction

import mutation_runs
import second_checker

ROOT = pathlib.Path(__file__).resolve().parents[2]
KINETIC, FILTER, ALGEBRA = "src/kinetic/", "src/kinetic/filter/", "src/algebra/"
TRAITS, ROOTS = KINETIC + "basic_kinetic_traits_2.cpp", ALGEBRA + "real_roots.cpp"
DETAIL = "include/kinetri/impl/triangulation/"
COLUMNS = ("no end", "differ", "refuted", "true", "audits", "nothing differs")
INFINITY = "std::numeric_limits<double>::infinity()"

# Of a certificate that Sturm counts decide, where they can; and one that is always solved for roots.
COUNTED = """[&](const auto& polynomial) { return counted_certificate(polynomial, t, state); },
      [&] { return """
NOT_COUNTED = """[&](const auto&) { return std::optional<Certificate>(); },
      [&] { return """

# Name, file, text that is there once, and what takes its place.
MUTATIONS = (
    ("side on which a certificate fails", ROOTS, "(p, t) == CGAL::NEGATIVE", "(p, t) == CGAL::POSITIVE"),
    ("a root skipped: the second is taken", ROOTS, """roots_beyond(q, from, 1);
  const int changes = counter.changes_at(from);
  if (roots.empty()) {
    KINETRI_ASSERT(changes == counter.changes_at_plus_infinity(), "there is a root");
    return std::nullopt;
  }
  certify(counter, changes, roots.front());
  return roots.front();""", "roots_beyond(q, from, 2);\n  return roots.empty() ? std::nullopt : std::optional(roots.back());"),
    ("roots of multiplicity 3 skipped", ROOTS, "return first_simple_root_after(odd_part(p), t);",
     "const auto factors = square_free_decomposition(p);\n  return factors[0].multiplicity == 1 ? first_simple_root_after(factors[0].factor, t) : std::nullopt;"),
    ("roots of even multiplicity taken for failures", ROOTS, "return first_simple_root_after(odd_part(p), t);",
     "const auto root = first_root_after(p, t);\n  return root ? std::optional(root->value) : std::nullopt;"),
    ("times compared by the midpoints of intervals", ALGEBRA + "algebraic_number.cpp",
     "  if (a.is_binary64()) return CGAL::opposite(compare(b, a.binary64_value()));",
     "  const Double_interval x = a.interval();\n  const Double_interval y = b.interval();\n"
     "  if (x.lower + x.upper != y.lower + y.upper) return x.lower + x.upper < y.lower + y.upper ? CGAL::SMALLER : CGAL::LARGER;\n"
     "  if (!a.is_binary64()) return CGAL::EQUAL;\n  return CGAL::opposite(compare(b, a.binary64_value()));"),
    ("times equal where 60 bits are", ALGEBRA + "representation.cpp", "if (are_equal(x, y)) return", "return"),
    ("signs of derivatives: those before the time", ALGEBRA + "algebraic_number.cpp",
     "t.sign_beside(p, CGAL::POSITIVE)", "t.sign_beside(p, CGAL::NEGATIVE)"),
    ("in-circle certificate: sign", TRAITS, "  const auto on_stack = [&](const auto& formula) {",
     "  if (t == t) return exact_certificate(perturbed_in_circle_polynomial(p, q, r, s), t);\n"
     "  const auto on_stack = [&](const auto& formula) {"),
    ("orientation certificate: sign", TRAITS, COUNTED + "exact_certificate(orientation_polynomial(p, q, r), t)",
     NOT_COUNTED + "exact_certificate(-orientation_polynomial(p, q, r), t)"),
    ("contact at the later root", TRAITS, """  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_result result = filter_contact(p.motion(), q.motion(), diameter, t.interval());
    if (result.kind != Filter_result::Kind::unknown) return certificate(result);
  }
  return exactly(
""", """  const Polynomial c = contact_polynomial(p, q, diameter);
  if (const std::optional<Time> first = failure_time(c, t)) return exact_certificate(failure_time(-c, *first), true);
  return exactly(
"""),
    ("points that meet ignored", KINETIC + "exact_certificates.cpp", "  return Time(root);", "  return std::nullopt;"),
    ("new epoch: one ulp later", KINETIC + "linear_motion_2.cpp", "velocity,\n          t};", f"velocity,\n          std::nextafter(t, {INFINITY})}};"),
    ("new place: one ulp to the right", KINETIC + "linear_motion_2.cpp", "{{place_rounded_correctly(position.x, old_velocity.x, epoch, t)",
     f"{{{{std::nextafter(place_rounded_correctly(position.x, old_velocity.x, epoch, t), {INFINITY})"),
    ("growth ignored in exact weights", KINETIC + "scaled_coordinates.h", "radius(disc.radius, disc.growth, epoch_of(disc))", "radius(disc.radius, 0.0, epoch_of(disc))"),
    ("every 50th row of the log left out", "src/io/event_log.cpp", "  out_ << line;", "  if (event.number % 50 != 49) out_ << line;"),
    ("wall: velocity not turned around", "src/simulation/contact_outcomes.h", "component = -component;", "component = +component;"),
    ("every 50th event left out", DETAIL + "event_loop_impl.h", "      return updates_.flip(edge, event_kind_of(failure.kind));",
     "      static int executed = 0;\n      if (++executed % 50 == 0) return Types::set_event(edge, no_event);\n"
     "      return updates_.flip(edge, event_kind_of(failure.kind));"),
    ("points that reach the hull ignored", DETAIL + "event_loop_impl.h", "  const auto decision =",
     "  if (failure.kind == Entry_kind::hull_insert) return Types::set_event(edge, no_event);\n  const auto decision ="),
    ("hidden points never revealed", DETAIL + "event_loop_impl.h", "    if (failure.is_hidden()) {",
     "    if (failure.is_hidden() && failure.index == plane_condition) return failure.hidden->set_event(no_event);\n"
     "    if (failure.is_hidden()) {"),
    ("order at one time: kinds reversed", DETAIL + "schedule_impl.h", "return a.kind < b.kind;", "return a.kind > b.kind;"),
    ("error bound 0: in-circle certificate", FILTER + "certificates.h",
     "return d.in_circle_units * unit_roundoff * d.lift_size() * (d.size() * d.total());", "return 0.0;"),
    ("error bound 0: orientation certificate", FILTER + "certificates.h",
     "return d.product_units * unit_roundoff * (d.size() * d.total());", "return 0.0;"),
    ("error bound 0: signs over an interval", FILTER + "classify.h",
     "bernstein(certificate(d));\n  const double error = certificate.error(d);", "bernstein(certificate(d));\n  const double error = 0;"),
    ("growth ignored in the filter", FILTER + "weighted_differences.h", "return {p.radius + grown, p.growth, std", "return {p.radius + grown, 0.0, std"),
    ("in-circle certificate in the filter: sign of the last coefficient", FILTER + "in_circle_coefficients.h",
     "u[2] * vs[2] - v[2] * us[2] + uv[2] * l[2]}", "v[2] * us[2] - u[2] * vs[2] - uv[2] * l[2]}"),
)


def answer_of(*command, seconds=2):
    """The exit code, negative where the system ended the program; and what it says. No true run takes one second."""
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        resource.prlimit(process.pid, resource.RLIMIT_CPU, (seconds, seconds))
        text = process.communicate()[0]
        return process.returncode, text


def outcome(kinetri, verify, run, folder):
    """The files (none if the run does not end), whether audits pass, and the answer of the checker. A file of the
    last edges that is none, as where an edge is there twice, is left out: the log is to be refuted."""
    points, both, more = run
    folder.mkdir(parents=True, exist_ok=True)
    files = [folder / name for name in ("events.csv", "initial.csv", "motions.csv", "final.csv")]
    outputs = [x for pair in zip(("--events", "--initial-edges", "--motions", "--edges"), files) for x in pair]
    command = [kinetri, "simulate", points, *both, *more, "--quiet", "--max-events", "20000"]
    if answer_of(*command, *outputs)[0] != 0:
        return None, None, None
    checked = [verify, points, files[0], *both, *outputs[2:]]
    answer = answer_of(*checked, seconds=60)
    if answer[0] == 2:
        answer = answer_of(*checked[:-2], seconds=60)
    return [file.read_bytes().decode() for file in files], answer_of(*command, "--audit", "events")[0] == 0, answer


def edges_after(files, times):
    """The edges after each of the times, which are printed intervals."""
    log, start = ([line.split(",") for line in file.splitlines()[1:]] for file in files[:2])
    edges, row = {tuple(edge) for edge in start}, 0
    for time in times:
        while row < len(log) and tuple(map(Fraction, log[row][3:5])) <= time:
            edges = edges - {tuple(log[row][5:7])} | ({tuple(log[row][7:9])} - {("", "")})
            row += 1
        yield edges


def is_true(points, files, true):
    """Whether the edges after each time of two logs are the same or, of points with straight motions, both Delaunay."""
    log = [line.split(",") for file in (files[0], true[0]) for line in file.splitlines()[1:]]
    times = sorted({(Fraction(0), Fraction(0))} | {tuple(map(Fraction, row[3:5])) for row in log})
    with open(points, encoding="utf-8") as lines:
        rows = list(csv.reader(line for line in lines if line[0] != "#"))
    for edges, before, time, after in zip(edges_after(files, times), edges_after(true, times), times, times[1:] + [None]):
        if edges == before:
            continue
        if rows[0] != ["x", "y", "vx", "vy"] or files[2] != true[2] or files[2].count("\n") != len(rows):
            return False
        t = (time[1] + after[0]) / 2 if after else time[1] + Fraction(1, 2**99)
        places = [tuple(Fraction(float(row[i])) + t * Fraction(float(row[i + 2])) for i in (0, 1)) for row in rows[1:]]
        if not second_checker.is_delaunay(places, {tuple(map(int, edge)) for edge in edges}):
            return False
    return True


def copy_sources(source):
    """Writes the files that differ, which a build notices."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for name in names.strip("\0").split("\0"):
        file = source / name
        if not file.exists() or file.read_bytes() != (ROOT / name).read_bytes():
            file.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, file)


def main():
    for name, path, text, _ in MUTATIONS:
        count = (ROOT / path).read_text(encoding="utf-8").count(text)
        assert count == 1, f"the mutation '{name}' expects this once in {path}, where it is {count} times: {text}"
    if sys.argv[1:] == ["check"]:
        return
    verify, folder, jobs, pattern = (*sys.argv[1:], *["2", ""][len(sys.argv) - 3:])
    resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
    folder = pathlib.Path(folder).resolve()
    source, binary = folder / "source", folder / "source/build/test"
    copy_sources(source)
    if not (binary / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "-S", source, "--preset", "test", "-G", "Ninja"], cwd=source, check=True)
    build = ["cmake", "--build", binary, "--target", "kinetri_program", "-j", jobs]
    subprocess.run(build, check=True, stdout=subprocess.DEVNULL)
    kinetri = shutil.copy(binary / "bin/kinetri", folder / "kinetri")
    runs = list(mutation_runs.make_runs(kinetri, folder / "points"))

    def outcomes(program):
        with concurrent.futures.ThreadPoolExecutor(int(jobs)) as pool:
            return list(pool.map(lambda i: outcome(program, verify, runs[i], folder / f"logs/{i}"), range(len(runs))))

    true = outcomes(kinetri)
    for run, (files, audited, answer) in zip(runs, true):
        assert files and audited and answer[0] == 0, f"without any mutation: {run}: {audited} {answer}"
    print(f"{len(runs)} runs\n\n| mutation |", " | ".join(COLUMNS), "|\n" + "|---" * 7 + "|", flush=True)
    for name, path, text, other in (mutation for mutation in MUTATIONS if re.search(pattern, mutation[0])):
        original = (source / path).read_text(encoding="utf-8")
        (source / path).write_text(original.replace(text, other), encoding="utf-8")
        try:
            subprocess.run(build, check=True, stdout=subprocess.DEVNULL)
            found = outcomes(binary / "bin/kinetri")
        finally:
            (source / path).write_text(original, encoding="utf-8")
        counts = dict.fromkeys(COLUMNS, 0)
        for (before, *_), (files, audited, answer), (points, *options) in zip(true, found, runs):
            counts["no end"] += files is None
            if files is None:
                continue
            counts["audits"] += not audited
            counts["nothing differs"] += not audited and files == before
            counts["differ"] += files != before
            counts["refuted"] += answer[0] == 1
            if files != before and answer[0] != 1:
                counts["true"] += is_true(points, files, before)
                print(f"{name}: {points.name} {options}: audits {audited}, {answer}, {counts}", file=sys.stderr, flush=True)
        print("|", name, "|", " | ".join(map(str, counts.values())), "|", flush=True)


if __name__ == "__main__":
    main()
