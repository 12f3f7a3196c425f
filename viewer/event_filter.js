// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which events the list, the timeline and the heat show: those of the kinds that are switched on, and
// of one point if asked for.
'use strict';

class EventFilter {
  constructor(recording) {
    this.recording = recording;
    this.hiddenKinds = new Set();  // indices in `kinds`
    this.point = -1;               // -1: of all points
    this.count = new Uint32Array(recording.kinds.length);
    this.counted = 0;  // rows
    this.update();
  }

  /** The rows that are shown. */
  get rows() {
    return this.shown.values.subarray(0, this.shown.length);
  }

  /** The kinds that the run has. */
  get kinds() {
    return Array.from(this.count.keys()).filter((kind) => this.count[kind] > 0);
  }

  isEverything() {
    return this.hiddenKinds.size === 0 && this.point < 0;
  }

  shows(row) {
    return !this.hiddenKinds.has(this.recording.rowKind[row]) &&
      (this.point < 0 || concerns(this.recording, row, this.point));
  }

  /** Makes `rows` the list of the rows that are shown, and `before(row)` their number before a row. */
  update() {
    this.shown = new Numbers(Uint32Array);
    this.add(0);
  }

  /** Adds the rows from the first one on, to which the recording may have grown. */
  add(first) {
    const {recording, shown} = this;
    for (let row = first; row < recording.rows; ++row) if (this.shows(row)) shown.push(row);
    for (; this.counted < recording.rows; ++this.counted) ++this.count[recording.rowKind[this.counted]];
  }

  before(row) {
    const {rows} = this;
    let low = 0, high = rows.length;
    while (low < high) {
      const middle = (low + high) >>> 1;
      if (rows[middle] < row) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}

/** Whether the point is an end of a removed or added edge, or is named by the event. */
function concerns({rowRemoved, rowAdded, rowA, rowB, edgeA, edgeB}, row, point) {
  if (rowA[row] === point || rowB[row] === point) return true;
  const removed = rowRemoved[row], added = rowAdded[row];
  return removed >= 0 && (edgeA[removed] === point || edgeB[removed] === point) ||
    added >= 0 && (edgeA[added] === point || edgeB[added] === point);
}
