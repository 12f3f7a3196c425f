// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plays a stream of moving triangles: the recorded triangulations, whose changes have exact times,
// with colors between their corners.
'use strict';

/** The numbers of a type in base64 text, the least significant byte first. */
function decodeNumbers(text, Numbers) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const size = Numbers.BYTES_PER_ELEMENT;
  const view = new DataView(bytes.buffer);
  const get = {2: 'getInt16', 4: 'getInt32', 8: 'getFloat64'}[size];
  return Numbers.from({length: bytes.length / size}, (_, i) => view[get](i * size, true));
}

/**
 * A segment of the stream while time goes forward and backward. `corners` has three ids for each of
 * the `triangles`; `group` is the number of the group of the time.
 */
class Segment {
  constructor(json) {
    this.begin = json.begin;
    this.end = json.end;
    this.groups = json.groups.map((group) => ({
      begin: group.begin,
      end: group.end,
      ids: decodeNumbers(group.ids, Int32Array),
      places: decodeNumbers(group.places, Int32Array),  // x, y at the begin, x, y at the end
      colors: decodeNumbers(group.colors, Int16Array),  // red, green, blue; the same
    }));
    this.times = decodeNumbers(json.times, Float64Array);
    this.counts = decodeNumbers(json.counts, Int32Array);  // of removed and added triangles
    this.changes = decodeNumbers(json.changes, Int32Array);
    this.starts = new Int32Array(this.times.length + 1);
    for (let i = 0; i < this.times.length; ++i) {
      this.starts[i + 1] = this.starts[i] + 3 * (this.counts[2 * i] + this.counts[2 * i + 1]);
    }
    this.triangles = new Map();  // corners by key
    const initial = decodeNumbers(json.initial, Int32Array);
    for (let i = 0; i < initial.length; i += 3) this.add(initial, i);
    this.done = 0;  // changes that are made
    this.time = this.begin;
  }

  key(ids, i) { return `${ids[i]},${ids[i + 1]},${ids[i + 2]}`; }
  add(ids, i) { this.triangles.set(this.key(ids, i), [ids[i], ids[i + 1], ids[i + 2]]); }
  remove(ids, i) { this.triangles.delete(this.key(ids, i)); }

  execute() {
    const first = this.starts[this.done], removed = this.counts[2 * this.done];
    const last = this.starts[++this.done];
    for (let i = first; i < first + 3 * removed; i += 3) this.remove(this.changes, i);
    for (let i = first + 3 * removed; i < last; i += 3) this.add(this.changes, i);
  }

  undo() {
    const last = this.starts[this.done--];
    const first = this.starts[this.done], removed = this.counts[2 * this.done];
    for (let i = first + 3 * removed; i < last; i += 3) this.remove(this.changes, i);
    for (let i = first; i < first + 3 * removed; i += 3) this.add(this.changes, i);
  }

  /** Goes to the time; after the end, to the end. */
  goTo(time) {
    this.time = Math.min(Math.max(time, this.begin), this.end);
    while (this.done < this.times.length && this.times[this.done] <= this.time) this.execute();
    while (this.done > 0 && this.times[this.done - 1] > this.time) this.undo();
    let group = this.groups.length - 1;
    while (group > 0 && this.groups[group].begin > this.time) --group;
    this.group = this.groups[group];
  }
}

/** Draws the picture at a time, and the mesh over it. */
class Painter {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d', {alpha: false});
  }

  draw(segment, unit, width, showsMesh) {
    const {canvas, context} = this, {group, time} = segment;
    if (this.image === undefined || this.image.width !== canvas.width ||
        this.image.height !== canvas.height) {
      this.image = context.createImageData(canvas.width, canvas.height);
      this.image.data.fill(255);
    }
    const share = group.end > group.begin ? (time - group.begin) / (group.end - group.begin) : 0;
    const scale = unit * canvas.width / width;
    const vertices = new Map();
    group.ids.forEach((id, i) => {
      const {places, colors} = group;
      const between = (from, to) => from + share * (to - from);
      vertices.set(id, [between(places[4 * i], places[4 * i + 2]) * scale,
                        between(places[4 * i + 1], places[4 * i + 3]) * scale,
                        between(colors[6 * i], colors[6 * i + 3]),
                        between(colors[6 * i + 1], colors[6 * i + 4]),
                        between(colors[6 * i + 2], colors[6 * i + 5])]);
    });
    const mesh = new Path2D();
    for (const corners of segment.triangles.values()) {
      const [a, b, c] = corners.map((id) => vertices.get(id));
      fillTriangle(this.image, a, b, c);
      if (!showsMesh) continue;
      mesh.moveTo(a[0], a[1]);
      mesh.lineTo(b[0], b[1]);
      mesh.lineTo(c[0], c[1]);
      mesh.closePath();
    }
    context.putImageData(this.image, 0, 0);
    context.strokeStyle = 'rgb(255 255 255 / 40%)';
    if (showsMesh) context.stroke(mesh);
  }
}

const SLACK = 1e-6;  // in pixels, so that rounding leaves no pixel between two triangles

/** Fills the pixels whose centers are in the triangle with the linear function of its corners, which
 * are [x, y, red, green, blue]. */
function fillTriangle({data, width, height}, a, b, c) {
  const area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
  if (area === 0) return;
  const slope = (k) => ((b[k] - a[k]) * (c[1] - a[1]) - (c[k] - a[k]) * (b[1] - a[1])) / area;
  const slopes = [slope(2), slope(3), slope(4)];
  const top = Math.min(a[1], b[1], c[1]), bottom = Math.max(a[1], b[1], c[1]);
  const first = Math.max(Math.ceil(top - 0.5 - SLACK), 0);
  const last = Math.min(Math.floor(bottom - 0.5 + SLACK), height - 1);
  for (let row = first; row <= last; ++row) {
    const y = Math.min(Math.max(row + 0.5, top), bottom);
    let left = Infinity, right = -Infinity, from = null;
    for (const [p, q] of [[a, b], [b, c], [c, a]]) {
      if (y < Math.min(p[1], q[1]) || y > Math.max(p[1], q[1])) continue;
      const shares = p[1] === q[1] ? [0, 1] : [(y - p[1]) / (q[1] - p[1])];
      for (const share of shares) {
        const x = p[0] + share * (q[0] - p[0]);
        if (x < left) {
          left = x;
          from = [2, 3, 4].map((k) => p[k] + share * (q[k] - p[k]));
        }
        right = Math.max(right, x);
      }
    }
    const begin = Math.max(Math.ceil(left - 0.5 - SLACK), 0);
    const end = Math.min(Math.floor(right - 0.5 + SLACK), width - 1);
    if (end < begin) continue;
    let [red, green, blue] = from.map((value, k) => value + slopes[k] * (begin + 0.5 - left));
    for (let at = 4 * (row * width + begin), column = begin; column <= end; ++column, at += 4) {
      data[at] = red;  // rounded and clamped by the array
      data[at + 1] = green;
      data[at + 2] = blue;
      red += slopes[0];
      green += slopes[1];
      blue += slopes[2];
    }
  }
}

/** The player: what is shown, and what the controls do. */
class Player {
  constructor(json) {
    this.json = json;
    this.segments = json.segments.map((segment) => new Segment(segment));
    this.canvas = document.getElementById('picture');
    this.painter = new Painter(this.canvas);
    this.time = 0;
    this.speed = 1;
    this.plays = false;
    this.last = null;
    const element = (id) => document.getElementById(id);
    element('title').textContent = json.title;
    element('play').onclick = () => this.setPlaying(!this.plays);
    element('speed').oninput = (event) => { this.speed = Number(event.target.value); this.show(); };
    element('mesh').onchange = () => this.show();
    element('time').max = json.frames;
    element('time').oninput = (event) => { this.time = Number(event.target.value); this.show(); };
    window.addEventListener('resize', () => this.show());
    window.addEventListener('keydown', (event) => {
      if (event.key === ' ' && event.target.tagName !== 'BUTTON') this.setPlaying(!this.plays);
      if (event.key === 'm') { element('mesh').checked = !element('mesh').checked; this.show(); }
    });
    this.show();
  }

  /** The segment that the time is in: the last one that has begun. */
  segment() {
    let i = this.segments.length - 1;
    while (i > 0 && this.segments[i].begin > this.time) --i;
    return this.segments[i];
  }

  show() {
    const {json, canvas} = this;
    // As many pixels as the screen has: the picture has no size of its own.
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * devicePixelRatio));
    canvas.height = Math.max(1, Math.round(canvas.width * json.height / json.width));
    const segment = this.segment();
    segment.goTo(this.time);
    this.painter.draw(segment, json.unit, json.width, document.getElementById('mesh').checked);
    document.getElementById('time').value = this.time;
    const seconds = (this.time * json.rate[1] / json.rate[0]).toFixed(3);
    document.getElementById('clock').textContent =
      `${seconds} s, ${segment.triangles.size} triangles, speed ${this.speed}`;
  }

  setPlaying(plays) {
    this.plays = plays;
    this.last = null;
    document.getElementById('play').textContent = plays ? 'Pause' : 'Play';
    if (plays) requestAnimationFrame((now) => this.animate(now));
  }

  animate(now) {
    if (!this.plays) return;
    if (this.last !== null) {
      const frames = (now - this.last) / 1000 * this.speed * this.json.rate[0] / this.json.rate[1];
      // From the end to the begin, and backward.
      this.time = (this.time + frames % this.json.frames + this.json.frames) % this.json.frames;
    }
    this.last = now;
    this.show();
    requestAnimationFrame((next) => this.animate(next));
  }
}

window.addEventListener('load', () => {
  try {
    window.player = new Player(JSON.parse(document.getElementById('stream').textContent));
  } catch (error) {
    const message = document.getElementById('message');
    message.hidden = false;
    message.textContent = `This stream cannot be played: ${error.message}`;
  }
});
