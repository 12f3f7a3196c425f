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
    for (let row = 0; row < recording.rows; ++row) ++this.count[recording.rowKind[row]];
    this.update();
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
    const rows = new Numbers(Uint32Array);
    for (let row = 0; row < this.recording.rows; ++row) if (this.shows(row)) rows.push(row);
    this.rows = rows.finish();
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
