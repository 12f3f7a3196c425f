// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pairs within range at the time shown, and the components that they form, from the encounters of the
// recording.
'use strict';

/** The encounters of the recording, {range, inAll, count, a, b, x, y, begin, end}, or null if it has none. In a
 * periodic box (x, y) are the offsets of the second points; else x and y are null. */
function readEncounters(recording, json, ids) {
  if (json === undefined) return null;
  const {points} = recording;
  demand(json !== null && Number.isFinite(json.range) && Number.isInteger(json.in_all),
         'the encounters have no range or no number');
  const {count} = json;
  const id = decodeNumbers(json.ids, ids, 'the list of points of encounters');
  const begin = decodeNumbers(json.begin, 'Float64', 'the list of begins of encounters');
  const end = decodeNumbers(json.end, 'Float64', 'the list of ends of encounters');
  demand(id.length === 2 * count && begin.length === count && end.length === count,
         `it has ${count} encounters, but ${id.length} points, ${begin.length} begins and ${end.length} ends of them`);
  const offsets = readOffsets(recording, json.offsets, 'encounters', count);
  const a = new Uint32Array(count), b = new Uint32Array(count);
  const x = offsets?.filter((_, i) => i % 2 === 0) ?? null, y = offsets?.filter((_, i) => i % 2 === 1) ?? null;
  for (let i = 0; i < count; ++i) {
    a[i] = id[2 * i];
    b[i] = id[2 * i + 1];
    demand(isForward(a[i], b[i], x?.[i] ?? 0, y?.[i] ?? 0) && b[i] < points,
           `encounter ${i} is of the points ${a[i]} and ${b[i]}`);
    demand(Number.isFinite(begin[i]) && Number.isFinite(end[i]), `encounter ${i} has no begin or no end`);
    demand(i === 0 || begin[i - 1] <= begin[i], `encounter ${i} begins before encounter ${i - 1}`);
  }
  return {range: json.range, inAll: json.in_all, count, a, b, x, y, begin, end};
}

/** Whether the page can show pairs within range. */
function hasEncounters({encounters}) {
  return encounters !== null && encounters.count === encounters.inAll;
}

/**
 * Who is within range at a time. `live` holds the `liveCount` encounters that go on then, in no order;
 * `component[point]` is the least id in the component of the point, and `size[point]` the number of points
 * in it. `update` makes them those of a time.
 */
class Encounters {
  constructor(recording) {
    this.recording = recording;
    const {count, begin, end} = recording.encounters;
    // Those that go on at no binary64 number would begin after they have ended.
    this.order = Uint32Array.from({length: count}, (_, i) => i).filter((i) => begin[i] <= end[i]);
    this.byEnd = this.order.slice().sort((i, k) => end[i] - end[k]);
    this.begun = this.ended = 0;  // how many have begun by the time, and ended before it
    this.live = new Uint32Array(count);
    this.where = new Int32Array(count).fill(-1);
    this.liveCount = 0;
    this.changes = 0;             // grows when those that go on change
    this.connected = -1;          // the number of changes when components were found
    this.component = new Uint32Array(recording.points);
    this.size = new Uint32Array(recording.points);
  }

  update(time) {
    const {order, byEnd} = this;
    const {begin, end} = this.recording.encounters;
    while (this.ended > 0 && end[byEnd[this.ended - 1]] >= time) this.add(byEnd[--this.ended]);
    while (this.begun < order.length && begin[order[this.begun]] <= time) this.add(order[this.begun++]);
    while (this.begun > 0 && begin[order[this.begun - 1]] > time) this.remove(order[--this.begun]);
    while (this.ended < byEnd.length && end[byEnd[this.ended]] < time) this.remove(byEnd[this.ended++]);
  }

  add(encounter) {
    this.where[encounter] = this.liveCount;
    this.live[this.liveCount++] = encounter;
    ++this.changes;
  }

  remove(encounter) {
    const last = this.live[--this.liveCount];
    this.live[this.where[encounter]] = last;
    this.where[last] = this.where[encounter];
    this.where[encounter] = -1;
    ++this.changes;
  }

  /** Finds the components, with a forest in which a root is the least id of its tree. */
  connect() {
    if (this.connected === this.changes) return;
    this.connected = this.changes;
    const {component: parent, size, live, liveCount} = this;
    const {a, b} = this.recording.encounters;
    for (let point = 0; point < parent.length; ++point) parent[point] = point;
    const root = (point) => {
      while (parent[point] !== point) point = parent[point] = parent[parent[point]];
      return point;
    };
    for (let i = 0; i < liveCount; ++i) {
      const p = root(a[live[i]]), q = root(b[live[i]]);
      parent[Math.max(p, q)] = Math.min(p, q);
    }
    size.fill(0);
    for (let point = 0; point < parent.length; ++point) ++size[parent[point] = root(point)];
    for (let point = parent.length - 1; point >= 0; --point) size[point] = size[parent[point]];
  }

  /** The points within range of a point, ascending; in a periodic box each once for each image in range, and the
   * point itself too. */
  partners(point) {
    const {a, b} = this.recording.encounters;
    const result = [];
    for (let i = 0; i < this.liveCount; ++i) {
      const encounter = this.live[i];
      if (a[encounter] === point) result.push(b[encounter]);
      if (b[encounter] === point) result.push(a[encounter]);
    }
    return result.sort((p, q) => p - q);
  }
}
