# SPDX-License-Identifier: GPL-3.0-or-later
"""A second checker of event logs, for few points that move along straight lines.

It shares neither code nor idea with kinetri-verify: it computes all critical times, those at which
any three points are on a line or any four on a circle, with Sturm sequences. Between two critical
times nothing can change, so it looks at one rational time there, in fractions: whether the edges
that the log implies do not cross, are as many as a triangulation has, and each have a circle
through their ends without points inside. Where four points are on one circle at all times, it is
the determinant with x y, and then that with x^2, in place of x^2 + y^2 that decides. Of points with one motion the first one has the
edges, and the others have none. The cost is that of all sets of four points, at each critical time.
"""
import itertools
from fractions import Fraction

# ---- polynomials: lists of fractions, the constant first, the last one not 0 ----


def trim(p):
    while p and p[-1] == 0:
        p.pop()
    return p


def add(p, q, factor=1):
    size = max(len(p), len(q))
    p, q = p + [0] * (size - len(p)), q + [0] * (size - len(q))
    return trim([a + factor * b for a, b in zip(p, q)])


def times(p, q):
    result = [Fraction(0)] * max(len(p) + len(q) - 1, 0)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            result[i + j] += a * b
    return trim(result)


def value(p, t):
    result = Fraction(0)
    for c in reversed(p):
        result = result * t + c
    return result


def remainder(p, q):
    p = list(p)
    while len(p) >= len(q):
        factor, shift = p[-1] / q[-1], len(p) - len(q)
        for i, c in enumerate(q):
            p[shift + i] -= factor * c
        trim(p)
    return p


def common_divisor(p, q):
    while q:
        p, q = q, remainder(p, q)
        q = [c / q[-1] for c in q]
    return p


def sturm_sequence(p):
    sequence = [p, trim([i * c for i, c in enumerate(p)][1:])]
    while sequence[-1]:
        sequence.append([-c for c in remainder(sequence[-2], sequence[-1])])
    return sequence[:-1]


def sign_changes(sequence, t):
    signs = [v > 0 for v in (value(p, t) for p in sequence) if v != 0]
    return sum(a != b for a, b in zip(signs, signs[1:]))


class Root:
    """The only root of p in (low, high]; it may be multiple."""

    def __init__(self, p, sequence, low, high):
        self.p, self.sequence, self.low, self.high = p, sequence, low, high

    def refine(self):
        middle = (self.low + self.high) / 2
        if sign_changes(self.sequence, self.low) > sign_changes(self.sequence, middle):
            self.high = middle
        else:
            self.low = middle

    def equals(self, other):
        """Whether they are one number, for roots in intervals that overlap."""
        low, high = max(self.low, other.low), min(self.high, other.high)
        if low >= high:
            return False
        sequence = sturm_sequence(common_divisor(self.p, other.p))
        return sign_changes(sequence, low) > sign_changes(sequence, high)


def roots(p, low, high):
    """The roots in (low, high]. Multiple roots do not matter to Sturm's theorem if neither end is one;
    where an end is one, the common factor of the sequence is divided out first."""
    if len(p) < 2:
        return []
    divisor = common_divisor(p, trim([i * c for i, c in enumerate(p)][1:]))
    quotient, rest = [Fraction(0)] * (len(p) - len(divisor) + 1), list(p)
    for i in reversed(range(len(quotient))):
        quotient[i] = rest[i + len(divisor) - 1] / divisor[-1]
        for j, c in enumerate(divisor):
            rest[i + j] -= quotient[i] * c
    sequence, found = sturm_sequence(quotient), []
    waiting = [(low, high)]
    while waiting:
        a, b = waiting.pop()
        count = sign_changes(sequence, a) - sign_changes(sequence, b)
        if count == 1:
            found.append(Root(quotient, sequence, a, b))
        elif count > 1:
            waiting += [(a, (a + b) / 2), ((a + b) / 2, b)]
    return found


# ---- points ----


def orientation(a, b, c):
    u, v = ([add(q[i], a[i], -1) for i in (0, 1)] for q in (b, c))
    return add(times(u[0], v[1]), times(u[1], v[0]), -1)


def in_circle(a, b, c, d):
    rows = []
    for q in (a, b, c):
        x, y = (add(q[i], d[i], -1) for i in (0, 1))
        rows.append((x, y, (add(times(x, x), times(y, y)), times(x, y), times(x, x))))
    result = []
    for column in range(3):
        for u, v, w in itertools.permutations(range(3)):
            sign = 1 if (u, v, w) in ((0, 1, 2), (1, 2, 0), (2, 0, 1)) else -1
            result = add(result, times(rows[u][0], times(rows[v][1], rows[w][2][column])), sign)
        if result:
            break
    return result


def is_inside(a, b, c, d):
    """Whether the place d is inside the circle of a, b, c, which turn left."""
    rows = [(p[0] - d[0], p[1] - d[1]) for p in (a, b, c)]
    crosses = [rows[i][0] * rows[j][1] - rows[i][1] * rows[j][0] for i, j in ((1, 2), (2, 0), (0, 1))]
    for column in ([x * x + y * y for x, y in rows], [x * y for x, y in rows], [x * x for x, y in rows]):
        determinant = sum(c * cross for c, cross in zip(column, crosses))
        if determinant:
            return determinant > 0
    return False


def is_delaunay(places, edges):
    """Whether the edges are a Delaunay triangulation of the places, all of which differ."""

    def turn(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    n = len(places)
    pairs = list(itertools.combinations(range(n), 2))
    on_hull = set()  # pairs with all points on one side, or between them on their line
    for a, b in pairs:
        turns = [turn(places[a], places[b], p) for p in places]
        if min(turns) == 0 or max(turns) == 0:
            on_line = sorted((places[i], i) for i in range(n) if turns[i] == 0)
            on_hull |= {
                tuple(sorted((on_line[i][1], on_line[i + 1][1]))) for i in range(len(on_line) - 1)
            }
    is_flat = all(turn(places[0], places[1], p) == 0 for p in places) if n > 1 else True
    expected = n - 1 if is_flat else 3 * n - 3 - len(on_hull)
    if len(edges) != expected or not on_hull <= edges:
        return False
    for a, b in edges:
        # Some circle through both has no point inside if that of no point at the left has one at the right.
        (ax, ay), (bx, by) = places[a], places[b]
        left, right = [], []
        for x, y in (places[i] for i in range(n) if i not in (a, b)):
            side = turn(places[a], places[b], (x, y))
            if side == 0 and (x - ax) * (x - bx) + (y - ay) * (y - by) < 0:
                return False  # between the two
            if side != 0:
                (left if side > 0 else right).append((x, y))
        if any(is_inside(places[a], places[b], c, d) for c in left for d in right):
            return False
    for (a, b), (c, d) in itertools.combinations(edges, 2):
        if len({a, b, c, d}) == 4:
            p, q, r, s = (places[i] for i in (a, b, c, d))
            if turn(p, q, r) * turn(p, q, s) < 0 and turn(r, s, p) * turn(r, s, q) < 0:
                return False
    return True


# ---- the log ----


def critical_times(points, ids, start, until):
    """Lists of roots that are one time, each with its set of points, in order."""
    polynomials = {}
    for a, b in itertools.combinations(ids, 2):
        polynomials[a, b] = common_divisor(*(add(points[a][i], points[b][i], -1) for i in (0, 1)))
    for three in itertools.combinations(ids, 3):
        polynomials[three] = orientation(*(points[i] for i in three))
    for four in itertools.combinations(ids, 4):
        polynomials[four] = in_circle(*(points[i] for i in four))
    critical = []
    for which, p in polynomials.items():
        for root in roots(p, start, until):
            place = 0
            while place < len(critical):
                other = critical[place][0][0]
                if root.equals(other):
                    break
                while root.low < other.high and other.low < root.high:
                    root.refine()
                    other.refine()
                if root.high <= other.low:
                    critical.insert(place, [])
                    break
                place += 1
            else:
                critical.append([])
            critical[place].append((root, set(which)))
    return critical


def is_in(root, low, high):
    """Whether low <= root <= high."""
    for end in (low, high):
        while root.low < end < root.high and value(root.p, end) != 0:
            root.refine()
    if low == high or root.low < high < root.high or root.low < low < root.high:
        return any(root.low < t <= root.high and value(root.p, t) == 0 for t in (low, high))
    return low <= root.low and root.high <= high


def happens(row, sets):
    """Whether the row can tell of a time at which these sets of points are on a line or circle."""
    kind, _, _, removed, added = row
    edges = set(removed or ()) | set(added or ())
    if kind == "flip":
        return edges in sets
    return any(edges & which if kind == "rebuild" else edges <= which for which in sets)


def check(motions, rows, initial, final, start, until):
    """None if the log is true, and otherwise the number of the row at fault: -1 is the start, and the
    number of rows is the end. Rows have kind, low, high, the edge removed and the edge added."""
    start, until = Fraction(start), Fraction(until)
    points = [tuple(trim([Fraction(m[i]), Fraction(m[i + 2])]) for i in (0, 1)) for m in motions]
    shown = [i for i, point in enumerate(points) if points.index(point) == i]
    critical = critical_times(points, shown, start, until + 1)
    edges, done = set(initial), 0
    for index in range(-1, len(critical)):
        first = done
        if index >= 0:
            root = critical[index][0][0]
            if not is_in(root, start, until):
                break
            sets = [which for _, which in critical[index]]
            while done < len(rows) and is_in(root, *rows[done][1:3]) and happens(rows[done], sets):
                removed, added = rows[done][3:]
                if (removed and removed not in edges) or (added and added in edges):
                    return done
                edges = (edges - {removed}) | ({added} if added else set())
                done += 1
        # One time between this critical time and the next one.
        low = critical[index][0][0] if index >= 0 else Root(None, None, start, start)
        high = Root(None, None, until + 1, until + 1)
        if index + 1 < len(critical):
            high = critical[index + 1][0][0]
            while low.high >= high.low:
                (low if low.low < low.high and low.p else high).refine()
                high.refine()
        t = (low.high + high.low) / 2
        are_shown = all(end in shown for edge in edges for end in edge)
        numbered = {tuple(map(shown.index, edge)) for edge in edges} if are_shown else set()
        places = [tuple(value(c, t) for c in points[i]) for i in shown]
        if not are_shown or not is_delaunay(places, numbered):
            return done if done == first and index >= 0 else done - 1
    if done < len(rows):
        return done
    return None if edges == set(final) else len(rows)
