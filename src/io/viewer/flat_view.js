// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flat view: box, discs, edges, hull, points and their ids, and what is under the pointer. Its
// overlays are in overlays.js.
'use strict';

const LABEL_CELL = {width: 26, height: 15};  // pixels; one label each, so that they can be read

class FlatView {
  constructor(viewer) {
    this.viewer = viewer;
    this.camera = new Camera(extentOf(viewer.recording));
    this.sx = new Float64Array(viewer.recording.points);  // on the screen
    this.sy = new Float64Array(viewer.recording.points);
    this.labelled = new Uint8Array(0);
  }

  resize(width, height) {
    this.camera.resize(width, height);
  }

  draw(context) {
    const {viewer, camera} = this;
    const {switches, recording} = viewer;
    for (let point = 0; point < recording.points; ++point) {
      this.sx[point] = camera.screenX(viewer.x[point]);
      this.sy[point] = camera.screenY(viewer.y[point]);
    }
    if (recording.box !== null) this.drawBox(context);
    if (switches.discs && recording.radius > 0) this.drawDiscs(context);
    if (switches.trails) drawTrails(context, this);
    if (switches.delaunay) this.drawEdges(context);
    if (switches.voronoi) drawVoronoi(context, this);
    if (switches.hull) this.drawHull(context);
    if (switches.circle) drawCircumcircle(context, this);
    if (viewer.selected >= 0) drawSelection(context, this);
    drawEventsAround(context, this);
    this.drawPoints(context);
    if (switches.ids) this.drawIds(context);
    if (viewer.hoverPoint >= 0) this.drawHover(context, viewer.hoverPoint);
  }

  drawBox(context) {
    const [left, bottom, right, top] = this.viewer.recording.box;
    const x = this.camera.screenX(left), y = this.camera.screenY(top);
    context.strokeStyle = this.viewer.colors.box;
    context.lineWidth = 2;
    context.strokeRect(x, y, this.camera.screenX(right) - x, this.camera.screenY(bottom) - y);
  }

  drawDiscs(context) {
    const {sx, sy} = this;
    const radius = this.viewer.recording.radius * this.camera.scale;
    context.beginPath();
    for (let point = 0; point < sx.length; ++point) {
      if (!this.isSeen(sx[point], sy[point], radius)) continue;
      context.moveTo(sx[point] + radius, sy[point]);
      context.arc(sx[point], sy[point], radius, 0, 2 * Math.PI);
    }
    context.fillStyle = this.viewer.colors.discFill;
    context.fill();
    context.strokeStyle = this.viewer.colors.disc;
    context.lineWidth = 1.25;
    context.stroke();
  }

  drawEdges(context) {
    const {sx, sy} = this;
    const {playback, recording, colors, switches} = this.viewer;
    context.beginPath();
    for (let i = 0; i < playback.liveCount; ++i) {
      const a = recording.edgeA[playback.live[i]], b = recording.edgeB[playback.live[i]];
      context.moveTo(sx[a], sy[a]);
      context.lineTo(sx[b], sy[b]);
    }
    context.strokeStyle = switches.voronoi ? colors.edgeBehind : colors.edge;
    context.lineWidth = this.lineWidth();
    context.stroke();
  }

  /** Thin where there are many edges in little room. */
  lineWidth() {
    const {playback} = this.viewer;
    const room = Math.sqrt(this.camera.width * this.camera.height / (playback.liveCount + 1));
    return Math.min(1.4, Math.max(0.7, room * this.camera.scale / this.camera.fitScale / 14));
  }

  drawHull(context) {
    const {sx, sy} = this;
    const {topology} = this.viewer;
    topology.update();
    context.beginPath();
    for (let i = 0; i < topology.outerEdges; ++i) {
      const a = topology.outer[2 * i], b = topology.outer[2 * i + 1];
      context.moveTo(sx[a], sy[a]);
      context.lineTo(sx[b], sy[b]);
    }
    context.strokeStyle = this.viewer.colors.hull;
    context.lineWidth = 2;
    context.stroke();
  }

  pointRadius() {
    const {width, height, scale, fitScale} = this.camera;
    const room = Math.sqrt(width * height / (this.sx.length + 1)) * scale / fitScale;
    return Math.min(4.5, Math.max(1.6, room / 8));
  }

  drawPoints(context) {
    const {sx, sy} = this;
    const radius = this.pointRadius();
    context.beginPath();
    for (let point = 0; point < sx.length; ++point) {
      if (!this.isSeen(sx[point], sy[point], radius)) continue;
      context.moveTo(sx[point] + radius, sy[point]);
      context.arc(sx[point], sy[point], radius, 0, 2 * Math.PI);
    }
    context.fillStyle = this.viewer.colors.point;
    context.fill();
  }

  drawIds(context) {
    const {sx, sy} = this;
    const {width, height} = this.camera;
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

  /** Whether a disc on the screen is in the picture; of points that are not there it is not. */
  isSeen(x, y, radius) {
    return x >= -radius && y >= -radius && x <= this.camera.width + radius &&
      y <= this.camera.height + radius;
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

  /** The edge that is nearest to a place on the screen, within reach; or -1. */
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

  zoom(factor, x, y) {
    this.camera.zoom(factor, x, y);
  }

  drag(dx, dy) {
    this.camera.pan(dx, dy);
  }

  fit() {
    this.camera.fit();
  }
}
