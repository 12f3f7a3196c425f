// SPDX-License-Identifier: GPL-3.0-or-later
//
// The list of events, in which only the visible rows are elements; and the texts about events.
'use strict';

const ROW_HEIGHT = 44;
const LONGEST_LIST = 8e6;  // pixels; browsers do not scroll much further
const LEFT_ALONE = 2500;   // milliseconds for which the list stays where the user has scrolled it
const WHILE_PLAYING = 100; // milliseconds between two updates of the list
const GLYPHS = {
  flip: '\u21c4', hull_insert: '\u25b2', hull_remove: '\u25bc', rebuild: '\u21bb', wall: '\u2503',
  hide: '\u25cb', reveal: '\u25c9', collision: '\u25cf', insert: '+', erase: '\u00d7',
  trajectory: '\u2197',
};

/** A number with few digits, for display. */
function shortNumber(x, digits = 6) {
  return String(Number(x.toPrecision(digits))).replace(/^-/, '\u2212');
}

function kindName(recording, row) {
  return recording.kinds[recording.rowKind[row]].replace(/_/g, ' ');
}

/** As in the event log. Rows of a thinned recording, and those that only change triangles, are not
 * in the log. */
function eventNumber(recording, row) {
  const number = recording.rowNumber[row];
  return number >= 0 ? `#${number}` : `row ${row}`;
}

function edgeName(viewer, edge) {
  const {edgeA, edgeB, edgeX, edgeY} = viewer.recording;
  return `${viewer.pointName(edgeA[edge])}\u2013${viewer.pointName(edgeB[edge])}` +
    (edgeX === null ? '' : offsetText(edgeX[edge], edgeY[edge]));
}

/** What an event does, such as "3–7 → 5–9". */
function changeText(viewer, row) {
  const {rowRemoved, rowAdded, rowA, rowB, kinds, rowKind} = viewer.recording;
  const hiding = {hide: 'is hidden by', reveal: 'is no longer hidden by'}[kinds[rowKind[row]]];
  if (hiding !== undefined && rowB[row] >= 0) {
    return `point ${viewer.pointName(rowA[row])} ${hiding} ${viewer.pointName(rowB[row])}`;
  }
  const parts = [];
  if (rowA[row] >= 0) parts.push(viewer.pointName(rowA[row]));
  if (rowB[row] >= 0) parts.push(viewer.pointName(rowB[row]));
  const points = parts.length > 0 ? `point${parts.length > 1 ? 's' : ''} ${parts.join(', ')}` : '';
  const removed = rowRemoved[row] >= 0 ? edgeName(viewer, rowRemoved[row]) : '';
  const added = rowAdded[row] >= 0 ? edgeName(viewer, rowAdded[row]) : '';
  let edges = '';
  if (removed && added) edges = `${removed} \u2192 ${added}`;
  else if (removed) edges = `\u2212 ${removed}`;
  else if (added) edges = `+ ${added}`;
  return [points, edges].filter(Boolean).join(', ') || 'triangles change, edges do not';
}

class EventList {
  constructor(viewer) {
    this.viewer = viewer;
    this.list = element('list');
    this.rows = element('rows');
    this.pool = [];
    this.shownEvent = -1;
    this.userScrolled = -Infinity;
    this.updated = -Infinity;
    this.filterChanged();
    this.list.addEventListener('scroll', () => this.draw(), {passive: true});
    for (const type of ['wheel', 'touchmove', 'pointerdown']) {
      this.list.addEventListener(type, () => { this.userScrolled = performance.now(); },
                                 {passive: true});
    }
    this.rows.addEventListener('click', (event) => {
      const row = event.target.closest('.row');
      if (row !== null) viewer.goToRow(Number(row.dataset.row));
    });
  }

  /** Makes the list that of the events that the filter shows. */
  filterChanged() {
    const {recording, filter} = this.viewer;
    const {rows, instants} = recording;
    const shown = filter.rows.length;
    element('events-count').textContent = rows === 0 ? 'none' : shown < rows ? `${shown} of ${rows}` :
      instants === rows ? `${rows}` : `${rows} at ${counted(instants, 'instant')}`;
    this.total = ROW_HEIGHT * shown;
    this.rows.style.height = `${Math.min(this.total, LONGEST_LIST)}px`;
    this.shownEvent = -1;
    for (const row of this.pool) row.row = -1;
  }

  /** How many pixels of the whole list are above the window. */
  offset() {
    const height = this.list.clientHeight;
    const scrollable = Math.min(this.total, LONGEST_LIST) - height;
    if (scrollable <= 0) return 0;
    return this.list.scrollTop * (this.total - height) / scrollable;
  }

  scrollTo(offset) {
    const height = this.list.clientHeight;
    if (this.total <= height) return;
    this.list.scrollTop =
      offset * (Math.min(this.total, LONGEST_LIST) - height) / (this.total - height);
  }

  /** Scrolls to the current event, unless the user has just scrolled. */
  update() {
    const {event} = this.viewer.playback;
    const now = performance.now();
    if (this.shownEvent === event) return;
    if (this.viewer.isPlaying() && now - this.updated < WHILE_PLAYING) return;
    this.updated = now;
    if (this.list.clientHeight === 0) return;
    this.shownEvent = event;
    if (now - this.userScrolled > LEFT_ALONE) {
      const at = ROW_HEIGHT * Math.max(this.viewer.filter.before(event) - 1, 0), offset = this.offset();
      const height = this.list.clientHeight;
      const isInSight = at >= offset && at + 2 * ROW_HEIGHT <= offset + height;
      if (!isInSight) this.scrollTo(at - height / 2 + ROW_HEIGHT);
    }
    this.draw();
  }

  draw() {
    const {recording, playback, filter} = this.viewer;
    const offset = this.offset(), height = this.list.clientHeight;
    const first = Math.max(Math.floor(offset / ROW_HEIGHT), 0);
    const count = Math.min(Math.ceil(height / ROW_HEIGHT) + 1, filter.rows.length - first);
    while (this.pool.length < count) this.pool.push(this.newRow());
    const shift = this.list.scrollTop - offset;
    const {event} = playback;
    const presentBegin = event === 0 ? 0 : recording.instantBegin[event - 1];
    let active = '';
    for (let i = 0; i < this.pool.length; ++i) {
      const row = this.pool[i];
      row.root.hidden = i >= count;
      if (i >= count) continue;
      const index = filter.rows[first + i];
      this.fill(row, index, first + i);
      row.root.style.transform = `translateY(${ROW_HEIGHT * (first + i) + shift}px)`;
      const isPresent = index >= presentBegin && index < event;
      row.root.className = isPresent ? 'row present' : index >= event ? 'row future' : 'row';
      row.root.setAttribute('aria-selected', String(isPresent));
      if (isPresent) active = row.root.id;
    }
    this.list.setAttribute('aria-activedescendant', active);
  }

  newRow() {
    const root = document.createElement('div');
    root.id = `row-${this.pool.length}`;
    root.setAttribute('role', 'option');
    root.innerHTML = '<span class="glyph" aria-hidden="true"></span>' +
      '<span class="what"><span></span><span class="change"></span></span>' +
      '<span class="when"><span></span><span class="number"></span></span>';
    this.rows.append(root);
    const [glyph, what, when] = root.children;
    return {root, glyph, row: -1, kind: what.firstChild, change: what.lastChild,
            time: when.firstChild, number: when.lastChild};
  }

  /** Makes an element that of a row, which is the `place`-th in the list. */
  fill(element, row, place) {
    if (element.row === row) return;
    element.row = row;
    const {recording, filter} = this.viewer;
    element.root.dataset.row = row;
    element.root.setAttribute('aria-posinset', place + 1);
    element.root.setAttribute('aria-setsize', filter.rows.length);
    const kind = recording.rowKind[row];
    element.glyph.textContent = GLYPHS[recording.kinds[kind]] ?? '\u2022';
    element.root.style.setProperty('--mark', recording.kindColors[kind]);
    element.kind.textContent = kindName(recording, row);
    element.change.textContent = changeText(this.viewer, row);
    element.time.textContent = shortNumber(recording.rowTime[row], 7);
    element.number.textContent = eventNumber(recording, row);
  }
}
