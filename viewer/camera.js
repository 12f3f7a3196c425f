// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flat view's camera: which part of the plane is seen. Screen coordinates are CSS pixels, y
// down; those of the plane have y up.
'use strict';

const FIT_MARGIN = 36;   // pixels; less in a small picture
const HINT_MARGIN = 42;  // at least so much at the bottom, where the hint is (style.css)
const MOST_ZOOM = 1e9;   // relative to the whole

class Camera {
  constructor(extent) {
    this.extent = extent;
    this.width = this.height = 1;
    this.left = this.bottom = 0;  // what axes take of the picture
    this.isFitted = true;
    this.fit();
  }

  resize(width, height) {
    this.width = width;
    this.height = height;
    if (this.isFitted) this.fit();
  }

  /** Shows another extent, unless the user has chosen what is shown. */
  follow(extent) {
    this.extent = extent;
    if (this.isFitted) this.fit();
  }

  /** Reserves this many pixels for axes. Returns whether that changes the view. */
  leave(left, bottom) {
    if (left === this.left && bottom === this.bottom) return false;
    this.left = left;
    this.bottom = bottom;
    if (this.isFitted) this.fit();
    return this.isFitted;
  }

  /** Shows the whole extent. */
  fit() {
    const [left, bottom, right, top] = this.extent;
    this.x = left / 2 + right / 2;
    this.y = bottom / 2 + top / 2;
    const margin = (pixels) => Math.min(FIT_MARGIN, pixels / 8);
    const beside = margin(this.width), above = margin(this.height);
    const below = Math.max(above, Math.min(HINT_MARGIN, this.height / 4), this.bottom + above / 2);
    const before = Math.max(beside, this.left + beside / 2);
    this.scale = Math.min((this.width - before - beside) / (right - left),
                          (this.height - above - below) / (top - bottom));
    this.x -= (before - beside) / 2 / this.scale;
    this.y -= (below - above) / 2 / this.scale;
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

  /** Zooms by a factor about a position on the screen. */
  zoom(factor, screenX = this.width / 2, screenY = this.height / 2) {
    const x = this.planeX(screenX), y = this.planeY(screenY);
    this.scale = Math.min(Math.max(this.scale * factor, this.fitScale / MOST_ZOOM),
                          this.fitScale * MOST_ZOOM);
    this.x = x - (screenX - this.width / 2) / this.scale;
    this.y = y + (screenY - this.height / 2) / this.scale;
    this.isFitted = false;
  }

  /** Centers the view at the position. */
  center(x, y) {
    this.x = x;
    this.y = y;
    this.isFitted = false;
  }

  /** Shows the given width of the plane, centered at the position. */
  look(x, y, planeWidth) {
    this.center(x, y);
    this.scale = this.width / planeWidth;
  }

  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
    this.isFitted = false;
  }
}

/**
 * Clips the segment in `ends` ([x0, y0, x1, y1]) to the rectangle from (-margin, -margin) to
 * (width + margin, height + margin). Returns whether anything is left.
 */
function clipSegment(ends, width, height, margin) {
  let enter = 0, leave = 1;
  const dx = ends[2] - ends[0], dy = ends[3] - ends[1];
  for (let side = 0; side < 4; ++side) {
    // Inside if run * t <= room.
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
