// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who is next to whom: the neighbors of each point in counterclockwise order, and from these the
// triangles. The recording has edges only.
'use strict';

/** The neighbors and triangles of a playback's present edges. `update` makes them the present. */
class Topology {
  constructor(playback) {
    const {recording} = playback;
    this.playback = playback;
    this.event = -1;  // that it is up to date with
    this.x = new Float64Array(recording.points);  // at the playback's settled time
    this.y = new Float64Array(recording.points);
    this.start = new Uint32Array(recording.points + 1);
    this.capacity = 0;
    this.triangles = 0;
    this.outerEdges = 0;  // with no triangle to their left: twice the edge if on neither side
  }

  update() {
    const {playback} = this;
    if (this.event === playback.event) return;
    this.event = playback.event;
    placePoints(playback, playback.settledTime(), this.x, this.y);
    if (2 * playback.liveCount > this.capacity) {
      this.capacity = 2 * playback.liveCount + 64;
      this.neighbors = new Uint32Array(this.capacity);
      this.angles = new Float64Array(this.capacity);
      this.corners = new Uint32Array(this.capacity);    // three a triangle
      this.outer = new Uint32Array(2 * this.capacity);  // two an edge
    }
    this.findNeighbors();
    this.findTriangles();
  }

  findNeighbors() {
    const {start, neighbors, playback} = this;
    const {edgeA, edgeB, points} = playback.recording;
    start.fill(0);
    for (let i = 0; i < playback.liveCount; ++i) {
      const edge = playback.live[i];
      ++start[edgeA[edge]];
      ++start[edgeB[edge]];
    }
    let sum = 0;
    for (let point = 0; point < points; ++point) start[point] = sum += start[point];
    start[points] = sum;
    for (let i = 0; i < playback.liveCount; ++i) {
      const edge = playback.live[i], a = edgeA[edge], b = edgeB[edge];
      neighbors[--start[a]] = b;
      neighbors[--start[b]] = a;
    }
    for (let point = 0; point < points; ++point) this.sortNeighbors(point);
  }

  /** By angle, counterclockwise. Insertion: a point has six neighbors on average. */
  sortNeighbors(point) {
    const {start, neighbors, angles, x, y} = this;
    const begin = start[point];
    for (let i = begin; i < start[point + 1]; ++i) {
      const neighbor = neighbors[i];
      const angle = Math.atan2(y[neighbor] - y[point], x[neighbor] - x[point]);
      let j = i;
      for (; j > begin && angles[j - 1] > angle; --j) {
        angles[j] = angles[j - 1];
        neighbors[j] = neighbors[j - 1];
      }
      angles[j] = angle;
      neighbors[j] = neighbor;
    }
  }

  /** Each triangle once, from its least corner; and the edges with nothing to their left. */
  findTriangles() {
    const {start, neighbors, corners, outer} = this;
    const points = this.playback.recording.points;
    this.triangles = this.outerEdges = 0;
    for (let a = 0; a < points; ++a) {
      for (let i = start[a]; i < start[a + 1]; ++i) {
        const b = neighbors[i], c = this.next(a, i, 1);
        if (!this.isTriangle(a, b, c)) {
          outer[2 * this.outerEdges] = a;
          outer[2 * this.outerEdges++ + 1] = b;
        } else if (a < b && a < c) {
          const at = 3 * this.triangles++;
          corners[at] = a;
          corners[at + 1] = b;
          corners[at + 2] = c;
        }
      }
    }
  }

  /** The neighbor of `a` after (direction 1) or before (-1) its i-th in the list. */
  next(a, i, direction) {
    const begin = this.start[a], count = this.start[a + 1] - begin;
    return this.neighbors[begin + (i - begin + direction + count) % count];
  }

  isEdge(a, b) {
    for (let i = this.start[a]; i < this.start[a + 1]; ++i) {
      if (this.neighbors[i] === b) return true;
    }
    return false;
  }

  /** Whether b and c, one after the other around a, make a triangle with it. */
  isTriangle(a, b, c) {
    if (b === c) return false;
    const {x, y} = this;
    const area = (x[b] - x[a]) * (y[c] - y[a]) - (y[b] - y[a]) * (x[c] - x[a]);
    return area > 0 && this.isEdge(b, c);
  }
}

/** The centre of the circle through three points, in `center.x` and `center.y`; not finite where
 * the points are collinear. */
function circumcenter(center, ax, ay, bx, by, cx, cy) {
  const ux = bx - ax, uy = by - ay, vx = cx - ax, vy = cy - ay;
  const u = ux * ux + uy * uy, v = vx * vx + vy * vy;
  const d = 2 * (ux * vy - uy * vx);
  center.x = ax + (vy * u - uy * v) / d;
  center.y = ay + (ux * v - vx * u) / d;
}
