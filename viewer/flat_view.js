// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flat view: box, discs, edges, hull and points; those that others hide are hollow, and their
// discs dashed. A point with which others coincide has a ring. Its overlays are in overlays.js.
'use strict';

const LEAVING = 0.45;         // strength of what is outside of a periodic box
const COINCIDENT_RING = 2.5;  // pixels from a dot to the ring about it
const TO_LEFT = 1, TO_RIGHT = 2, ABOVE = 4, BELOW = 8, ANY_SIDE = 15, FAR = 16;

class FlatView extends View {
  constructor(viewer) {
    super(viewer);
    this.extents = new Extents(viewer.recording);
    this.camera = new Camera(this.extents.at(viewer.playback.time));
    this.detail = new Detail();
    this.sw = new Float64Array(viewer.recording.points);  // weights, in squared pixels
    this.axisLeft = this.axisBottom = 0;  // what axes take of the picture
    this.sides = new Uint8Array(viewer.recording.points);  // on which the points are of the picture
  }

  resize(width, height) {
    this.width = width;
    this.height = height;
    this.camera.resize(width, height);
  }

  /** Computes where the points are on the screen. */
  project() {
    const {viewer, camera, sx, sy, sw} = this;
    const {x, y, w} = viewer;
    camera.follow(this.extents.at(viewer.playback.time));
    const {scale} = camera;
    const left = camera.width / 2 - camera.x * scale, top = camera.height / 2 + camera.y * scale;
    const {width, height, sides} = this;
    let inView = 0;
    for (let point = 0; point < sx.length; ++point) {
      const px = sx[point] = x[point] * scale + left, py = sy[point] = top - y[point] * scale;
      let side = 0;
      if (!(px >= 0)) side = px < -width ? TO_LEFT | FAR : TO_LEFT;
      else if (px > width) side = px > 2 * width ? TO_RIGHT | FAR : TO_RIGHT;
      if (!(py >= 0)) side |= py < -height ? ABOVE | FAR : ABOVE;
      else if (py > height) side |= py > 2 * height ? BELOW | FAR : BELOW;
      if (side === 0) ++inView;
      sides[point] = side;
    }
    if (viewer.recording.motionSizes !== null) {
      for (let point = 0; point < sw.length; ++point) sw[point] = w[point] * scale * scale;
    }
    this.detail.measure(this, inView);
  }

  draw(painter) {
    const {viewer} = this;
    const {switches, recording} = viewer;
    this.project();
    if (recording.box !== null) this.drawBox(painter);
    if (recording.points === 0) this.sayEmpty(painter);
    if (viewer.coloring !== null) drawColors(painter, this);
    if (switches.heat) viewer.heat.draw(painter, this);
    // What has colors reaches beyond a periodic box.
    if (recording.periodic !== null) this.drawBox(painter);
    if (switches.discs && hasDiscs(recording)) this.drawAllDiscs(painter);
    if (switches.trails) drawTrails(painter, this);
    if (switches.delaunay) this.drawEdges(painter);
    if (switches.voronoi) drawVoronoi(painter, this);
    if (switches.links) drawLinks(painter, this);
    if (switches.hull) this.drawHull(painter);
    if (switches.arrows) drawArrows(painter, this);
    if (switches.circle) drawCircumcircle(painter, this);
    if (viewer.hoverEdge >= 0) {
      strokeEdge(painter, this, viewer.hoverEdge, {color: viewer.colors.selected, width: 3, alpha: 0.45});
    }
    if (viewer.selected >= 0) drawSelection(painter, this);
    if (viewer.selectedPoint.id >= 0) drawSelectedPoint(painter, this);
    drawEventsAround(painter, this);
    viewer.drawMore(painter, this);
    this.drawPoints(painter);
    if (viewer.selectedPoint.id >= 0) drawPointRings(painter, this);
    if (switches.ids) this.drawIds(painter);
    this.axisBottom = switches.axes ? AXIS_BOTTOM : 0;
    // As wide as its labels have been at any time, so that the picture does not move back and forth.
    this.axisLeft = switches.axes ? Math.max(this.axisLeft, drawAxes(painter, this)) : 0;
    if (this.camera.leave(this.axisLeft, this.axisBottom)) viewer.requestFrame();
    if (switches.scale) drawScaleBar(painter, this);
    if (viewer.hoverPoint >= 0) this.drawRing(painter, viewer.hoverPoint, 4, viewer.colors.selected);
  }

  sayEmpty(painter) {
    painter.text('There are no points in this run.', this.width / 2, this.height / 2,
                 {color: this.viewer.colors.quiet, font: '15px system-ui, sans-serif', align: 'center'});
  }

  drawBox(painter) {
    const {camera} = this, {recording, images} = this.viewer;
    let corners;
    if (images !== null) {
      corners = images.box.corners();
    } else {
      const [left, bottom, right, top] = recording.box;
      corners = [left, top, right, top, right, bottom, left, bottom];
    }
    const batch = this.lineBatch.clear();
    for (let i = 0; i < 8; i += 2) {
      const j = (i + 2) % 8;
      this.addSegment(batch, camera.screenX(corners[i]), camera.screenY(corners[i + 1]),
                      camera.screenX(corners[j]), camera.screenY(corners[j + 1]));
    }
    painter.lines(batch, {color: this.viewer.colors.box, width: 2, cap: 'round'});
  }

  drawAllDiscs(painter) {
    const {colors} = this.viewer;
    const fill = this.viewer.coloring === null ? colors.discFill : undefined;
    painter.circles(this.discs(VISIBLE), {fill, stroke: colors.disc, width: this.detail.lineWidth()});
    painter.circles(this.discs(HIDDEN), {stroke: colors.quiet, width: 1.25, dash: [4, 3]});
    if (this.viewer.images === null) return;
    painter.circles(this.discImages(), {fill, stroke: colors.disc, width: this.detail.lineWidth(), alpha: LEAVING});
  }

  /** The other images of discs that reach into the periodic box. */
  discImages() {
    const {camera} = this, {x, y, r, hidden, images} = this.viewer;
    const batch = this.circleBatch.clear();
    for (let point = 0; point < x.length; ++point) {
      if (hidden[point] !== VISIBLE || !(r[point] > 0)) continue;
      images.box.forEachDiscImage(x[point], y[point], r[point], (imageX, imageY) => {
        const atX = camera.screenX(imageX), atY = camera.screenY(imageY), radius = r[point] * camera.scale;
        if (this.isSeen(atX, atY, radius)) batch.circle(atX, atY, radius);
      });
    }
    return batch;
  }

  /** The discs of the points that are VISIBLE, or HIDDEN. */
  discs(which) {
    const {sx, sy} = this;
    const {r, hidden} = this.viewer;
    const batch = this.circleBatch.clear();
    for (let point = 0; point < sx.length; ++point) {
      const radius = r[point] * this.camera.scale;
      if (hidden[point] !== which || !this.isSeen(sx[point], sy[point], radius)) continue;
      batch.circle(sx[point], sy[point], radius);
    }
    return batch;
  }

  drawEdges(painter) {
    const {sx, sy} = this;
    const {playback, recording, colors, switches} = this.viewer;
    const alpha = this.detail.edgeStrength(switches.voronoi);
    if (alpha === 0) return;
    if (recording.periodic !== null) {
      this.drawPeriodicEdges(painter, alpha);
      return;
    }
    const {live, liveCount} = playback, {edgeA, edgeB} = recording;
    const {sides} = this;
    const batch = this.lineBatch.clear();
    for (let i = 0; i < liveCount; ++i) {
      const edge = live[i], a = edgeA[edge], b = edgeB[edge];
      if ((sides[a] & sides[b] & ANY_SIDE) !== 0) continue;  // both on one side of the picture
      if (((sides[a] | sides[b]) & FAR) !== 0) this.addSegment(batch, sx[a], sy[a], sx[b], sy[b]);
      else batch.line(sx[a], sy[a], sx[b], sy[b]);
    }
    painter.lines(batch, {color: switches.voronoi ? colors.edgeBehind : colors.edge, alpha,
                          width: this.detail.lineWidth()});
  }

  /** Edges that leave the box are drawn at both ends, fainter, up to the images of the other ends, which have
   * faint dots. */
  drawPeriodicEdges(painter, alpha) {
    const {sx, sy} = this;
    const {playback: {live, liveCount}, recording: {edgeA, edgeB}, colors, switches} = this.viewer;
    const style = {color: switches.voronoi ? colors.edgeBehind : colors.edge, alpha,
                   width: this.detail.lineWidth()};
    const within = this.lineBatch.clear(), radius = this.pointRadius(), dots = this.circleBatch.clear();
    const leaving = [];
    for (let i = 0; i < liveCount; ++i) {
      const edge = live[i], a = edgeA[edge], b = edgeB[edge];
      this.setShift(edge);
      const {x, y} = SHIFT;
      if (x === 0 && y === 0) {
        this.addSegment(within, sx[a], sy[a], sx[b], sy[b]);
        continue;
      }
      leaving.push(edge);
      for (const [dotX, dotY] of [[sx[b] + x, sy[b] + y], [sx[a] - x, sy[a] - y]]) {
        if (this.isSeen(dotX, dotY, radius)) dots.circle(dotX, dotY, radius);
      }
    }
    painter.lines(within, style);
    const batch = this.lineBatch.clear();
    for (const edge of leaving) this.addEdge(batch, edge);
    painter.lines(batch, {...style, alpha: LEAVING * alpha});
    painter.circles(dots, {fill: colors.point, alpha: LEAVING * this.detail.dotStrength()});
  }

  drawHull(painter) {
    const {hullEdges, colors} = this.viewer;
    hullEdges.update();
    const batch = this.lineBatch.clear();
    for (const edge of hullEdges.edges) this.addEdge(batch, edge);
    painter.lines(batch, {color: colors.hull, width: 2, cap: 'round'});
  }

  pointRadius() {
    return this.detail.dotRadius();
  }

  drawPoints(painter) {
    const {colors, recording} = this.viewer;
    painter.circles(this.dots(VISIBLE), {fill: colors.point, alpha: this.detail.dotStrength()});
    if (recording.motionSizes !== null) {
      painter.circles(this.dots(HIDDEN), {fill: colors.background, stroke: colors.quiet, width: 1.25});
    }
    if (recording.coincidences > 0) painter.circles(this.rings(), {stroke: colors.point, width: 1.25});
  }

  /** The rings about points with which others coincide. */
  rings() {
    const {sx, sy} = this;
    const {coincident} = this.viewer.playback;
    const radius = this.pointRadius() + COINCIDENT_RING;
    const batch = this.circleBatch.clear();
    for (let point = 0; point < sx.length; ++point) {
      if (coincident[point] === 0 || !this.isSeen(sx[point], sy[point], radius)) continue;
      batch.circle(sx[point], sy[point], radius);
    }
    return batch;
  }

  /** The dots of the points that are VISIBLE, or HIDDEN. */
  dots(which) {
    const {sx, sy} = this;
    const {hidden} = this.viewer;
    const radius = this.pointRadius();
    const batch = this.circleBatch.clear();
    for (let point = 0; point < sx.length; ++point) {
      if (hidden[point] !== which || !this.isSeen(sx[point], sy[point], radius)) continue;
      batch.circle(sx[point], sy[point], radius);
    }
    return batch;
  }

  /** Moves the camera so that the point is in the middle. */
  center(point) {
    const {x, y} = this.viewer;
    if (!Number.isNaN(x[point])) this.camera.center(x[point], y[point]);
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
