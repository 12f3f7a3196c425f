// SPDX-License-Identifier: GPL-3.0-or-later
//
// The wave: the triangulation as a surface, z = height exp(-d^2 / (2 width^2)) with d the distance
// in y to the mean of the points that move, seen from above at an angle without perspective.
// Triangles are drawn from back to front, so that the near ones cover the far ones.
'use strict';

const HEIGHT_COLORS = 40;
const LIGHTS = 12;
const DEPTHS = 4096;
// Dark to light in lightness too, so that the heights can be told apart without color.
const WAVE_RAMP = [[24, 66, 106], [0, 98, 148], [0, 141, 158], [98, 186, 160], [206, 226, 170],
                   [255, 250, 228]];
const FIRST_PITCH = 0.66;  // 0: from the side, pi / 2: from above
const DARK_HEIGHT = 0.45;  // share of the height below which lines are light
const LIGHT = [-0.42, -0.46, 0.78];

class WaveView extends View {
  constructor(viewer) {
    super(viewer);
    const {points} = viewer.recording;
    this.extent = wholeExtent(viewer.recording);
    this.z = new Float64Array(points);
    this.depth = new Float64Array(points);
    this.bucketStart = new Uint32Array(DEPTHS + 1);
    this.order = new Uint32Array(0);
    this.bucket = new Uint16Array(0);
    this.fills = waveColors();
    this.fit();
  }

  resize(width, height) {
    this.width = width;
    this.height = height;
    this.findScale();
  }

  fit() {
    this.yaw = -0.5;
    this.pitch = FIRST_PITCH;
    this.magnification = 1;
    this.panX = this.panY = 0;
    this.findScale();
  }

  /** So that the whole is seen from everywhere. */
  findScale() {
    const [left, bottom, right, top] = this.extent;
    const diagonal = Math.hypot(right - left, top - bottom);
    const tall = diagonal * Math.sin(FIRST_PITCH) +
      Math.abs(this.viewer.recording.wave.height) * Math.cos(FIRST_PITCH);
    this.scale = this.magnification * Math.min(this.width / diagonal, this.height / tall);
  }

  zoom(factor) {
    this.magnification = Math.min(Math.max(this.magnification * factor, 0.1), 100);
    this.findScale();
  }

  drag(dx, dy, isPan) {
    if (isPan) {
      this.panX += dx;
      this.panY += dy;
      return;
    }
    this.yaw += dx * 0.008;
    this.pitch = Math.min(Math.max(this.pitch + dy * 0.006, 0.12), Math.PI / 2);
  }

  pointRadius() {
    return 2;
  }

  /** Drawn triangle by triangle, by the 2D context itself. */
  get usesContext() {
    return true;
  }

  draw(painter) {
    const {context} = painter;
    const {triangleList, switches} = this.viewer;
    triangleList.update();
    this.project();
    this.sortTriangles();
    context.lineJoin = 'round';
    context.lineWidth = 0.8;
    for (let i = 0; i < triangleList.triangles; ++i) this.drawTriangle(context, this.order[i]);
    if (this.viewer.selected >= 0) drawSelection(painter, this);
    drawEventsAround(painter, this);
    if (switches.ids) this.drawIds(painter);
    if (this.viewer.hoverPoint >= 0) this.drawRing(painter, this.viewer.hoverPoint, 4, this.viewer.colors.selected);
  }

  /** Computes the heights, and the positions on the screen. */
  project() {
    const {recording, playback, x, y} = this.viewer;
    const {height, width} = recording.wave;
    let sum = 0, count = 0;
    for (let point = 0; point < recording.points; ++point) {
      const motion = playback.current[point];
      if (motion < 0 || !recording.motionThere[motion] || !isMoving(recording, motion)) continue;
      sum += y[point];
      ++count;
    }
    const crest = sum / count;  // NaN where nothing moves: all is flat
    const [left, bottom, right, top] = this.extent;
    const cx = left / 2 + right / 2, cy = bottom / 2 + top / 2;
    const cosYaw = Math.cos(this.yaw), sinYaw = Math.sin(this.yaw);
    const cosPitch = Math.cos(this.pitch), sinPitch = Math.sin(this.pitch);
    for (let point = 0; point < recording.points; ++point) {
      const d = (y[point] - crest) / width;
      const z = count === 0 ? 0 : height * Math.exp(-d * d / 2);
      const px = x[point] - cx, py = y[point] - cy;
      const back = sinYaw * px + cosYaw * py;
      this.z[point] = z;
      this.sx[point] = this.width / 2 + this.panX + this.scale * (cosYaw * px - sinYaw * py);
      this.sy[point] = this.height / 2 + this.panY -
        this.scale * (back * sinPitch + (z - height / 2) * cosPitch);
      this.depth[point] = back * cosPitch - z * sinPitch;
    }
  }

  /** Sorts the triangles, farthest first, in linear time: in every frame there are many. */
  sortTriangles() {
    const {triangleList} = this.viewer;
    const {corners, triangles} = triangleList;
    const {depth, bucketStart} = this;
    if (this.order.length < triangles) {
      this.order = new Uint32Array(2 * triangles);
      this.bucket = new Uint16Array(2 * triangles);
    }
    let least = Infinity, greatest = -Infinity;
    for (let i = 0; i < 3 * triangles; ++i) {
      least = Math.min(least, depth[corners[i]]);
      greatest = Math.max(greatest, depth[corners[i]]);
    }
    const perDepth = (DEPTHS - 1) / ((greatest - least) || 1) / 3;
    bucketStart.fill(0);
    for (let i = 0; i < triangles; ++i) {
      const sum = depth[corners[3 * i]] + depth[corners[3 * i + 1]] + depth[corners[3 * i + 2]];
      const bucket = DEPTHS - 1 - Math.floor((sum - 3 * least) * perDepth);
      this.bucket[i] = bucket;
      ++bucketStart[bucket + 1];
    }
    for (let i = 0; i < DEPTHS; ++i) bucketStart[i + 1] += bucketStart[i];
    for (let i = 0; i < triangles; ++i) this.order[bucketStart[this.bucket[i]]++] = i;
  }

  drawTriangle(context, triangle) {
    const {viewer, sx, sy, z} = this;
    const {x, y, triangleList} = viewer;
    const a = triangleList.corners[3 * triangle], b = triangleList.corners[3 * triangle + 1];
    const c = triangleList.corners[3 * triangle + 2];
    const ux = x[b] - x[a], uy = y[b] - y[a], uz = z[b] - z[a];
    const vx = x[c] - x[a], vy = y[c] - y[a], vz = z[c] - z[a];
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const length = Math.sqrt(nx * nx + ny * ny + nz * nz) || 1;
    const lit = Math.max(0, (nx * LIGHT[0] + ny * LIGHT[1] + nz * LIGHT[2]) / length);
    const level = (z[a] + z[b] + z[c]) / (3 * viewer.recording.wave.height);
    const color = Math.min(HEIGHT_COLORS - 1, Math.max(0, Math.floor(level * HEIGHT_COLORS)));
    const light = Math.min(LIGHTS - 1, Math.floor(lit * LIGHTS));
    const at = color * LIGHTS + light;
    context.beginPath();
    context.moveTo(sx[a], sy[a]);
    context.lineTo(sx[b], sy[b]);
    context.lineTo(sx[c], sy[c]);
    context.closePath();
    context.fillStyle = this.fills[at] ?? this.fills[0];
    context.fill();
    context.strokeStyle = !viewer.switches.delaunay ? context.fillStyle :
      level < DARK_HEIGHT ? viewer.colors.waveLowEdge : viewer.colors.waveEdge;
    context.stroke();
  }
}

/** CSS colors by height and, for each height, by light. */
function waveColors() {
  const colors = [];
  for (let i = 0; i < HEIGHT_COLORS; ++i) {
    const place = i / (HEIGHT_COLORS - 1) * (WAVE_RAMP.length - 1);
    const k = Math.min(Math.floor(place), WAVE_RAMP.length - 2);
    const rgb = WAVE_RAMP[k].map((c, j) => c + (WAVE_RAMP[k + 1][j] - c) * (place - k));
    for (let light = 0; light < LIGHTS; ++light) {
      const strength = 0.5 + 0.56 * light / (LIGHTS - 1);
      colors.push(`rgb(${rgb.map((c) => Math.round(Math.min(255, c * strength))).join(',')})`);
    }
  }
  return colors;
}
