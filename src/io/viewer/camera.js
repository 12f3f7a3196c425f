// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flat view's camera: which part of the plane is seen. Screen coordinates are CSS pixels, y
// down; those of the plane have y up.
'use strict';

const FIT_MARGIN = 36;       // pixels
const MOST_ZOOM = 1e9;       // relative to the whole
const OUTLIERS = 0.02;       // share of the places at each end that need not be in the picture
const TIMES_IN_MOTION = 8;   // at which an accelerated motion is looked at

class Camera {
  constructor(extent) {
    this.extent = extent;
    this.width = this.height = 1;
    this.isFitted = true;
    this.fit();
  }

  resize(width, height) {
    this.width = width;
    this.height = height;
    if (this.isFitted) this.fit();
  }

  /** Shows the whole extent. */
  fit() {
    const [left, bottom, right, top] = this.extent;
    this.x = left / 2 + right / 2;
    this.y = bottom / 2 + top / 2;
    const room = (pixels) => Math.max(pixels - 2 * FIT_MARGIN, 16);
    this.scale = Math.min(room(this.width) / (right - left), room(this.height) / (top - bottom));
    this.fitScale = this.scale;
    this.isFitted = true;
  }

  screenX(x) {
    return (x - this.x) * this.scale + this.width / 2;
  }

  screenY(y) {
    return this.height / 2 - (y - this.y) * this.scale;
  }

  planeX(screenX) {
    return this.x + (screenX - this.width / 2) / this.scale;
  }

  planeY(screenY) {
    return this.y - (screenY - this.height / 2) / this.scale;
  }

  /** Zooms by a factor; what is at the place on the screen stays there. */
  zoom(factor, screenX = this.width / 2, screenY = this.height / 2) {
    const x = this.planeX(screenX), y = this.planeY(screenY);
    this.scale = Math.min(Math.max(this.scale * factor, this.fitScale / MOST_ZOOM),
                          this.fitScale * MOST_ZOOM);
    this.x = x - (screenX - this.width / 2) / this.scale;
    this.y = y + (screenY - this.height / 2) / this.scale;
    this.isFitted = false;
  }

  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
    this.isFitted = false;
  }
}

/** [left, bottom, right, top] of what a recording shows: its box, or where its points go but for
 * the few that go farthest. Never empty. */
function extentOf(recording) {
  let extent;
  if (recording.box !== null) {
    extent = recording.box.slice();
  } else {
    const xs = [], ys = [];
    for (let i = 0; i < recording.motions; ++i) sampleMotion(recording, i, xs, ys);
    const [left, right] = mostOf(xs), [bottom, top] = mostOf(ys);
    extent = [left, bottom, right, top];
  }
  const r = recording.radius;
  if (recording.box === null) extent = [extent[0] - r, extent[1] - r, extent[2] + r, extent[3] + r];
  for (const axis of [0, 1]) {
    const span = Math.max(extent[2] - extent[0], extent[3] - extent[1]);
    const size = extent[axis + 2] - extent[axis];
    const least = Math.max(span / 1e3, Math.abs(extent[axis]) * 1e-9) || 2;
    if (size < least) {
      extent[axis] -= least / 2;
      extent[axis + 2] += least / 2;
    }
    if (extent[axis + 2] - extent[axis] === Infinity) {
      extent[axis] /= 2;
      extent[axis + 2] /= 2;
    }
  }
  return extent;
}

function sampleMotion(recording, motion, xs, ys) {
  if (!recording.motionThere[motion]) return;
  const {motionRow, motionNext, rowTime, degree} = recording;
  const next = motionNext[motion];
  const begin = motionRow[motion] < 0 ? recording.from : rowTime[motionRow[motion]];
  const end = next < 0 ? recording.until : rowTime[motionRow[next]];
  const steps = degree === 1 ? 1 : TIMES_IN_MOTION;
  for (let i = 0; i <= steps; ++i) {
    const time = begin + (end - begin) * i / steps;
    xs.push(motionX(recording, motion, time));
    ys.push(motionY(recording, motion, time));
  }
}

/** [least, greatest] of most of the numbers, with some room. */
function mostOf(numbers) {
  if (numbers.length === 0) return [-1, 1];
  const sorted = Float64Array.from(numbers).sort();
  const last = sorted.length - 1;
  const low = sorted[Math.floor(OUTLIERS * last)], high = sorted[Math.ceil((1 - OUTLIERS) * last)];
  const room = 0.25 * (high - low);
  return [Math.max(sorted[0], low - room), Math.min(sorted[last], high + room)];
}

/**
 * Clips the segment in `ends` ([x0, y0, x1, y1]) to the rectangle from (-margin, -margin) to
 * (width + margin, height + margin). Returns whether anything is left.
 */
function clipSegment(ends, width, height, margin) {
  let enter = 0, leave = 1;
  const dx = ends[2] - ends[0], dy = ends[3] - ends[1];
  for (let side = 0; side < 4; ++side) {
    // Inside where run * t <= room.
    const run = side === 0 ? -dx : side === 1 ? dx : side === 2 ? -dy : dy;
    const room = side === 0 ? ends[0] + margin : side === 1 ? width + margin - ends[0] :
                 side === 2 ? ends[1] + margin : height + margin - ends[1];
    if (run === 0) {
      if (room < 0) return false;
    } else if (run < 0) {
      enter = Math.max(enter, room / run);
    } else {
      leave = Math.min(leave, room / run);
    }
  }
  if (!(enter < leave)) return false;
  const [x, y] = ends;
  ends[0] = x + enter * dx;
  ends[1] = y + enter * dy;
  ends[2] = x + leave * dx;
  ends[3] = y + leave * dy;
  return true;
}
