// SPDX-License-Identifier: GPL-3.0-or-later
//
// The scrub bar, and above it a histogram of the times of the events.
'use strict';

class Timeline {
  constructor(viewer) {
    this.viewer = viewer;
    this.scrub = element('scrub');
    this.histogram = element('histogram');
    this.scrub.disabled = viewer.recording.from === viewer.recording.until;
    this.scrub.addEventListener('input', () => viewer.goTo(this.timeAt(Number(this.scrub.value))));
  }

  timeAt(share) {
    const {from, until} = this.viewer.recording;
    return share >= 1 ? until : from + share * (until - from);
  }

  update() {
    const {recording, playback} = this.viewer;
    const {from, until} = recording;
    const share = until > from ? (playback.time - from) / (until - from) : 0;
    this.scrub.value = share;
    this.scrub.style.setProperty('--done', `${100 * share}%`);
    this.scrub.setAttribute('aria-valuetext', `time ${shortNumber(playback.time)}, event ` +
      `${playback.event} of ${recording.rows}`);
  }

  /** Columns of the events that the filter shows, by kind. The height of a column is the square root of
   * its number of events: one event is visible. */
  draw() {
    const {viewer, histogram} = this;
    const {recording, filter} = viewer;
    const width = histogram.clientWidth, height = histogram.clientHeight;
    const context = sizedContext(histogram, width, height);
    context.clearRect(0, 0, width, height);
    const span = recording.until - recording.from;
    const thumb = 18, columns = Math.floor((width - thumb) / 3);
    if (!(span > 0) || columns < 1) return;
    const {kinds} = filter;
    const counts = new Uint32Array(columns * kinds.length), total = new Uint32Array(columns);
    const place = new Int32Array(recording.kinds.length);
    kinds.forEach((kind, i) => { place[kind] = i; });
    let most = 1;
    for (const row of filter.rows) {
      const share = (recording.rowTime[row] - recording.from) / span;
      const column = Math.min(Math.max(Math.floor(share * columns), 0), columns - 1);
      ++counts[column * kinds.length + place[recording.rowKind[row]]];
      most = Math.max(most, ++total[column]);
    }
    for (let column = 0; column < columns; ++column) {
      if (total[column] === 0) continue;
      const size = Math.max(1.5, height * Math.sqrt(total[column] / most));
      const x = thumb / 2 + (width - thumb) * column / columns;
      let y = height;
      kinds.forEach((kind, i) => {
        const part = size * counts[column * kinds.length + i] / total[column];
        context.fillStyle = recording.kindColors[kind];
        context.fillRect(x, y - part, 2, part);
        y -= part;
      });
    }
  }
}
