// SPDX-License-Identifier: GPL-3.0-or-later
//
// The common part of the flat view and the wave view: the points' positions on the screen, their
// ids, and which point or edge is at a position on the screen.
'use strict';

const LABEL_CELL = {width: 26, height: 15};  // pixels; one label each, so that they can be read

class View {
  constructor(viewer) {
    this.viewer = viewer;
    this.width = this.height = 1;
    this.sx = new Float64Array(viewer.recording.points);  // on the screen; NaN: not there
    this.sy = new Float64Array(viewer.recording.points);
    this.labelled = new Uint8Array(0);
  }

  drawIds(context) {
    const {sx, sy, width, height} = this;
    const columns = Math.ceil(width / LABEL_CELL.width) + 1;
    const cells = columns * (Math.ceil(height / LABEL_CELL.height) + 1);
    if (this.labelled.length < cells) this.labelled = new Uint8Array(cells);
    this.labelled.fill(0);
    context.font = '11px system-ui, sans-serif';
    context.textAlign = 'left';
    context.lineWidth = 3;
    context.strokeStyle = this.viewer.colors.background;
    context.fillStyle = this.viewer.colors.text;
    context.lineJoin = 'round';
    for (let point = 0; point < sx.length; ++point) {
      if (!this.isSeen(sx[point], sy[point], 0)) continue;
      const cell = columns * Math.floor(sy[point] / LABEL_CELL.height) +
        Math.floor(sx[point] / LABEL_CELL.width);
      if (this.labelled[cell]) continue;
      this.labelled[cell] = 1;
      const name = this.viewer.pointName(point);
      context.strokeText(name, sx[point] + 6, sy[point] - 5);
      context.fillText(name, sx[point] + 6, sy[point] - 5);
    }
  }

  drawHover(context, point) {
    const radius = this.pointRadius() + 4;
    context.strokeStyle = this.viewer.colors.selected;
    context.lineWidth = 2;
    context.beginPath();
    context.arc(this.sx[point], this.sy[point], radius, 0, 2 * Math.PI);
    context.stroke();
  }

  /** Whether a disc on the screen is in the picture; false for a point that is not there. */
  isSeen(x, y, radius) {
    return x >= -radius && y >= -radius && x <= this.width + radius &&
      y <= this.height + radius;
  }

  pointAt(x, y, reach) {
    let nearest = -1, least = reach * reach;
    for (let point = 0; point < this.sx.length; ++point) {
      const dx = this.sx[point] - x, dy = this.sy[point] - y;
      const distance = dx * dx + dy * dy;
      if (distance <= least) {
        least = distance;
        nearest = point;
      }
    }
    return nearest;
  }

  /** The edge nearest to a position on the screen, within reach; or -1. */
  edgeAt(x, y, reach) {
    const {sx, sy} = this;
    const {playback, recording} = this.viewer;
    let nearest = -1, least = reach * reach;
    for (let i = 0; i < playback.liveCount; ++i) {
      const edge = playback.live[i];
      const a = recording.edgeA[edge], b = recording.edgeB[edge];
      const dx = sx[b] - sx[a], dy = sy[b] - sy[a];
      const along = ((x - sx[a]) * dx + (y - sy[a]) * dy) / (dx * dx + dy * dy);
      const t = Math.min(Math.max(along, 0), 1);
      const ex = sx[a] + t * dx - x, ey = sy[a] + t * dy - y;
      const distance = ex * ex + ey * ey;
      if (distance <= least) {
        least = distance;
        nearest = edge;
      }
    }
    return nearest;
  }
}
