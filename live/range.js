// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who is near whom at the time that is shown, measured on its positions, which are rounded: the pairs within range, in
// the shape of those of a recording (viewer/encounters.js); and the nearest neighbors.

const MOST_PAIRS = 200000;

/** What a recording without encounters gets, so that the viewer can show those that are measured. */
function noPairs() {
  return {
    range: 0, inAll: 0, count: 0, a: new Uint32Array(0), b: new Uint32Array(0), x: null, y: null, begin: [], end: [],
  };
}

/** The pairs of points whose distance, or the gap between whose discs, is at most the range; if that is 0, none. */
class PairsInRange extends Encounters {
  constructor(viewer) {
    super(viewer.recording);
    this.viewer = viewer;
    this.order = Array.from(viewer.x.keys());  // the points by x: from frame to frame it changes little
    this.isTooMany = false;  // then there are none
  }

  get range() {
    return this.recording.encounters.range;
  }

  set range(range) {
    this.recording.encounters.range = range;
  }

  update() {
    const {encounters} = this.recording, before = this.liveCount;
    this.measure(encounters);
    if (this.live.length < this.liveCount) this.live = Uint32Array.from(encounters.a.keys());
    if (this.hasChanged || this.liveCount !== before) ++this.changes;
  }

  /** Finds the pairs, along x. */
  measure(encounters) {
    const {viewer: {x, y, r}, order} = this, {range} = encounters;
    this.liveCount = 0;
    this.hasChanged = this.isTooMany = false;
    if (!(range > 0)) return;
    // NaN, of points that are not there, comes last.
    order.sort((p, q) => x[p] - x[q] || Number.isNaN(x[p]) - Number.isNaN(x[q]));
    const discs = hasDiscs(this.recording);
    let largest = 0;
    if (discs) for (const radius of r) if (radius > largest) largest = radius;
    for (let i = 0; i < order.length && !Number.isNaN(x[order[i]]); ++i) {
      const p = order[i], reach = range + (discs ? r[p] : 0);
      for (let k = i + 1; k < order.length && x[order[k]] - x[p] <= reach + largest; ++k) {
        const q = order[k], most = reach + (discs ? r[q] : 0), dx = x[q] - x[p], dy = y[q] - y[p];
        if (dx * dx + dy * dy <= most * most) this.write(encounters, p, q);
      }
      if (this.liveCount > MOST_PAIRS) {
        this.isTooMany = true;
        this.liveCount = 0;
        return;
      }
    }
  }

  write(encounters, p, q) {
    const i = this.liveCount++, a = Math.min(p, q), b = Math.max(p, q);
    encounters.a = withRoom(encounters.a, i + 1);
    encounters.b = withRoom(encounters.b, i + 1);
    if (encounters.a[i] !== a || encounters.b[i] !== b) this.hasChanged = true;
    encounters.a[i] = a;
    encounters.b[i] = b;
  }

  /** "3 components of points within range, the largest of 17", or why there are none. */
  text() {
    if (!(this.range > 0)) return '';
    if (this.isTooMany) return `more than ${MOST_PAIRS.toLocaleString('en')} pairs are within range: choose a smaller range`;
    this.connect();
    const {component, size, viewer: {x}} = this;
    let components = 0, largest = 0;
    for (let point = 0; point < size.length; ++point) {
      if (component[point] !== point || size[point] < 2 || Number.isNaN(x[point])) continue;
      ++components;
      largest = Math.max(largest, size[point]);
    }
    return `${counted(this.liveCount, 'pair')} within range, ${counted(components, 'component')}` +
      (components === 0 ? '' : `, the largest of ${largest.toLocaleString('en')}`);
  }
}

/**
 * The nearest neighbor of each point by id, -1 for none: one of the ends of its edges, since the triangulation is
 * Delaunay; the lesser id of two that are as near. Not for points that coincide for a while.
 */
function nearestNeighbors({recording: {points, edgeA, edgeB}, playback: {live, liveCount}, x, y}) {
  const nearest = new Int32Array(points).fill(-1), least = new Float64Array(points).fill(Infinity);
  const offer = (point, other, distance) => {
    if (distance > least[point] || distance === least[point] && other > nearest[point]) return;
    least[point] = distance;
    nearest[point] = other;
  };
  for (let i = 0; i < liveCount; ++i) {
    const a = edgeA[live[i]], b = edgeB[live[i]], distance = (x[a] - x[b]) ** 2 + (y[a] - y[b]) ** 2;
    offer(a, b, distance);
    offer(b, a, distance);
  }
  return nearest;
}
