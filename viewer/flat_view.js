// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flat view: box, discs, edges, hull and points; those that others hide are hollow, and their
// discs dashed. Its overlays are in overlays.js.
'use strict';

class FlatView extends View {
  constructor(viewer) {
    super(viewer);
    this.extents = new Extents(viewer.recording);
    this.camera = new Camera(this.extents.at(viewer.playback.time));
    this.sw = new Float64Array(viewer.recording.points);  // weights, in squared pixels
  }

  resize(width, height) {
    this.width = width;
    this.height = height;
    this.camera.resize(width, height);
  }

  draw(context) {
    const {viewer, camera} = this;
    const {switches, recording} = viewer;
    camera.follow(this.extents.at(viewer.playback.time));
    for (let point = 0; point < recording.points; ++point) {
      this.sx[point] = camera.screenX(viewer.x[point]);
      this.sy[point] = camera.screenY(viewer.y[point]);
      this.sw[point] = viewer.w[point] * camera.scale * camera.scale;
    }
    if (recording.box !== null) this.drawBox(context);
    if (recording.points === 0) this.sayEmpty(context);
    if (switches.discs && hasDiscs(recording)) this.drawAllDiscs(context);
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

  sayEmpty(context) {
    context.fillStyle = this.viewer.colors.quiet;
    context.font = '15px system-ui, sans-serif';
    context.textAlign = 'center';
    context.fillText('There are no points in this run.', this.width / 2, this.height / 2);
  }

  drawBox(context) {
    const [left, bottom, right, top] = this.viewer.recording.box;
    const x = this.camera.screenX(left), y = this.camera.screenY(top);
    context.strokeStyle = this.viewer.colors.box;
    context.lineWidth = 2;
    context.strokeRect(x, y, this.camera.screenX(right) - x, this.camera.screenY(bottom) - y);
  }

  drawAllDiscs(context) {
    const {colors} = this.viewer;
    this.traceDiscs(context, 0);
    context.fillStyle = colors.discFill;
    context.fill();
    context.strokeStyle = colors.disc;
    context.lineWidth = 1.25;
    context.stroke();
    this.traceDiscs(context, 1);
    context.strokeStyle = colors.quiet;
    context.setLineDash([4, 3]);
    context.stroke();
    context.setLineDash([]);
  }

  /** Makes a path of the discs of the points that are hidden, or of the others. */
  traceDiscs(context, isHidden) {
    const {sx, sy} = this;
    const {r, hidden} = this.viewer;
    context.beginPath();
    for (let point = 0; point < sx.length; ++point) {
      const radius = r[point] * this.camera.scale;
      if (hidden[point] !== isHidden || !this.isSeen(sx[point], sy[point], radius)) continue;
      context.moveTo(sx[point] + radius, sy[point]);
      context.arc(sx[point], sy[point], radius, 0, 2 * Math.PI);
    }
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
    const {recording, playback} = this.viewer;
    const {left, right} = playback.triangles;
    context.beginPath();
    for (let i = 0; i < playback.liveCount; ++i) {
      const edge = playback.live[i], a = recording.edgeA[edge], b = recording.edgeB[edge];
      if (left[edge] >= 0 && right[edge] >= 0) continue;
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
    return Math.min(4.5, Math.max(1.6, room / 9));
  }

  drawPoints(context) {
    const {colors} = this.viewer;
    this.tracePoints(context, 0);
    context.fillStyle = colors.point;
    context.fill();
    this.tracePoints(context, 1);
    context.fillStyle = colors.background;
    context.fill();
    context.strokeStyle = colors.quiet;
    context.lineWidth = 1.25;
    context.stroke();
  }

  /** Makes a path of the dots of the points that are hidden, or of the others. */
  tracePoints(context, isHidden) {
    const {sx, sy} = this;
    const {hidden} = this.viewer;
    const radius = this.pointRadius();
    context.beginPath();
    for (let point = 0; point < sx.length; ++point) {
      if (hidden[point] !== isHidden || !this.isSeen(sx[point], sy[point], radius)) continue;
      context.moveTo(sx[point] + radius, sy[point]);
      context.arc(sx[point], sy[point], radius, 0, 2 * Math.PI);
    }
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
