// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles, as the recording has them, and their centers.
'use strict';

/**
 * The triangles at some moment, by their sides. Of an edge ab with a < b, `left[edge]` is the third
 * corner of the triangle to the left of ab, and `right[edge]` that of the triangle to its right; -1
 * if there is no triangle.
 */
class Triangles {
  constructor(edges) {
    this.left = new Int32Array(edges).fill(-1);
    this.right = new Int32Array(edges).fill(-1);
  }

  clone() {
    const copy = new Triangles(0);
    copy.left = this.left.slice();
    copy.right = this.right.slice();
    return copy;
  }

  /** Adds or removes the i-th triangle of the recording. */
  set({triangleCorners, triangleSides, edgeA}, i, isThere) {
    for (let k = 3 * i; k < 3 * i + 3; ++k) {
      const edge = triangleSides[k];
      const side = triangleCorners[k] === edgeA[edge] ? this.left : this.right;
      side[edge] = isThere ? triangleCorners[k === 3 * i ? k + 2 : k - 1] : -1;
    }
  }

  /** How many edges of the i-th triangle of the recording have this triangle beside them now: 0 to
   * 3; -1 if one of them has another triangle there. */
  sidesInUse({triangleCorners, triangleSides, edgeA}, i) {
    let count = 0;
    for (let k = 3 * i; k < 3 * i + 3; ++k) {
      const edge = triangleSides[k];
      const side = triangleCorners[k] === edgeA[edge] ? this.left : this.right;
      if (side[edge] < 0) continue;
      if (side[edge] !== triangleCorners[k === 3 * i ? k + 2 : k - 1]) return -1;
      ++count;
    }
    return count;
  }
}

/** The list of the triangles of a playback, three corners each, counterclockwise. `update` makes
 * them those of the time shown. */
class TriangleList {
  constructor(playback) {
    this.playback = playback;
    this.event = -1;  // of the playback when the list was made
    this.corners = new Uint32Array(0);
    this.triangles = 0;
  }

  update() {
    const {playback} = this;
    if (this.event === playback.event) return;
    this.event = playback.event;
    const {edgeA, edgeB} = playback.recording;
    const {left} = playback.triangles;
    // An edge has two triangles at most, a triangle three edges.
    if (this.corners.length < 2 * playback.liveCount) {
      this.corners = new Uint32Array(2 * playback.liveCount + 64);
    }
    this.triangles = 0;
    for (let i = 0; i < playback.liveCount; ++i) {
      const edge = playback.live[i], a = edgeA[edge];
      // Each triangle once: at the side that leads away from its least corner.
      if (left[edge] < a) continue;
      const at = 3 * this.triangles++;
      this.corners[at] = a;
      this.corners[at + 1] = edgeB[edge];
      this.corners[at + 2] = left[edge];
    }
  }
}

/** The place of equal power to three weighted points a, b and c, in `center.x` and `center.y`; not
 * finite where the points are collinear. Of points without weights it is the center of the circle
 * through them. */
function powerCenter(center, ax, ay, aw, bx, by, bw, cx, cy, cw) {
  const ux = bx - ax, uy = by - ay, vx = cx - ax, vy = cy - ay;
  const u = ux * ux + uy * uy - (bw - aw), v = vx * vx + vy * vy - (cw - aw);
  const d = 2 * (ux * vy - uy * vx);
  center.x = ax + (vy * u - uy * v) / d;
  center.y = ay + (ux * v - vx * u) / d;
}

/** The edges of a playback with a triangle on one side only, or none. `update` makes them those of the time
 * shown. */
class HullEdges {
  constructor(playback) {
    this.playback = playback;
    // Flips keep these edges: the number of other rows before each row tells whether they are the same.
    this.changes = new Uint32Array(playback.recording.rows + 1);
    this.count(0);
    this.shown = -1;  // how many changes there were when the list was made
    this.edges = [];
  }

  /** Counts from the row on, to which the recording may have grown. */
  count(first) {
    const {rows, rowKind, kinds} = this.playback.recording;
    const changes = this.changes = withRoom(this.changes, rows + 1);
    for (let row = first; row < rows; ++row) {
      changes[row + 1] = changes[row] + (kinds[rowKind[row]] === 'flip' ? 0 : 1);
    }
  }

  update() {
    const {playback, changes} = this;
    const {live, liveCount} = playback, {left, right} = playback.triangles;
    if (this.shown === changes[playback.event]) return;
    this.shown = changes[playback.event];
    this.edges.length = 0;
    for (let i = 0; i < liveCount; ++i) {
      const edge = live[i];
      if (left[edge] < 0 || right[edge] < 0) this.edges.push(edge);
    }
  }
}
