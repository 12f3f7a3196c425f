// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pointer on the picture: drag, wheel, pinch, the point under the pointer, and clicks on edges.
'use strict';

const CLICK_MOVES = 5;  // pixels that a click may move
const REACH = {mouse: 9, touch: 18, pen: 12};
const TIP_OFFSET = 16;
const MOST_NAMED = 8;  // points that coincide with the one under the pointer

class PointerInput {
  constructor(viewer) {
    this.viewer = viewer;
    this.picture = element('picture');
    this.tip = element('tip');
    this.down = new Map();  // pointers that are pressed: where they are
    this.moved = 0;
    const listen = (type, handler) => this.picture.addEventListener(type, handler.bind(this));
    listen('pointerdown', this.press);
    listen('pointermove', this.move);
    listen('pointerup', this.release);
    listen('pointercancel', this.cancel);
    listen('pointerleave', this.leave);
    this.picture.addEventListener('wheel', (event) => this.wheel(event), {passive: false});
  }

  press(event) {
    if (event.button !== 0) return;
    this.picture.setPointerCapture(event.pointerId);
    if (this.down.size === 0) this.moved = 0;
    this.down.set(event.pointerId, {x: event.offsetX, y: event.offsetY});
  }

  move(event) {
    const {viewer} = this;
    const before = this.down.get(event.pointerId);
    if (before === undefined) {
      this.point(event);
      return;
    }
    const dx = event.offsetX - before.x, dy = event.offsetY - before.y;
    this.moved += Math.abs(dx) + Math.abs(dy);
    if (this.moved <= CLICK_MOVES) return;
    this.picture.classList.add('dragging');
    viewer.selectedPoint.follows = false;
    if (this.down.size === 1) {
      viewer.view.drag(dx, dy, event.shiftKey);
    } else {
      this.pinch(event, dx, dy);
    }
    before.x = event.offsetX;
    before.y = event.offsetY;
    this.point(event);
    viewer.requestFrame();
  }

  /** One of two fingers moves. */
  pinch(event, dx, dy) {
    const {viewer} = this;
    const at = this.down.get(event.pointerId);
    const [other] = [...this.down.values()].filter((finger) => finger !== at);
    const distance = (x, y) => Math.hypot(x - other.x, y - other.y);
    const factor = distance(event.offsetX, event.offsetY) / Math.max(distance(at.x, at.y), 1);
    viewer.view.drag(dx / 2, dy / 2, true);
    if (factor > 0) {
      viewer.view.zoom(factor, (event.offsetX + other.x) / 2, (event.offsetY + other.y) / 2);
    }
  }

  release(event) {
    const wasClick = this.down.size === 1 && this.moved <= CLICK_MOVES;
    this.cancel(event);
    if (!wasClick) return;
    const {viewer} = this;
    this.point(event);
    const {kind, id} = viewer.view.thingAt(event.offsetX, event.offsetY, REACH[event.pointerType] ?? REACH.mouse);
    if (kind === 'edge') viewer.select(id);
    else if (kind === 'none') viewer.closePanels();
    else viewer.selectedPoint.select(id);
  }

  cancel(event) {
    this.down.delete(event.pointerId);
    if (this.down.size === 0) this.picture.classList.remove('dragging');
  }

  leave() {
    this.viewer.pointer = null;
    this.viewer.requestFrame();
  }

  point(event) {
    this.viewer.pointer = {x: event.offsetX, y: event.offsetY,
                           reach: REACH[event.pointerType] ?? REACH.mouse};
    this.viewer.requestFrame();
  }

  wheel(event) {
    event.preventDefault();
    const pixels = event.deltaY * [1, 16, 400][event.deltaMode];
    const factor = Math.exp(-Math.min(Math.max(pixels, -300), 300) * 0.0022);
    this.viewer.view.zoom(factor, event.offsetX, event.offsetY);
    this.viewer.requestFrame();
  }

  /** Finds the point or edge under the pointer, before each drawing, since the points move. */
  find() {
    const {viewer, picture} = this;
    const {pointer} = viewer;
    viewer.hoverPoint =
      pointer === null ? -1 : viewer.view.pointAt(pointer.x, pointer.y, pointer.reach + 2);
    const thing = pointer === null || viewer.isPlaying() || this.down.size > 0 ? NOTHING :
      viewer.view.thingAt(pointer.x, pointer.y, pointer.reach);
    viewer.hoverEdge = thing.kind === 'edge' ? thing.id : -1;
    picture.classList.toggle('pointing', thing.kind !== 'none');
  }

  /** The points that coincide with the point. */
  placeText(point) {
    const {viewer} = this;
    const others = viewer.playback.coincidentWith(point);
    if (others.length === 0) return '';
    const more = others.length > MOST_NAMED ? ` and ${others.length - MOST_NAMED} more` : '';
    return `\nsame place  ${others.slice(0, MOST_NAMED).map((other) => viewer.pointName(other)).join(', ')}${more}`;
  }

  /** The number that the point's color stands for. */
  colorText(point) {
    const {viewer} = this;
    const {coloring} = viewer;
    if (coloring === null || ['speed', 'size'].includes(coloring.quantity.id)) return '';
    const {label, isKind} = coloring.quantity, number = coloring.quantity.of(viewer, point);
    return `\n${label.toLowerCase()}  ${isKind ? kindsOf(viewer.recording)[number] :
      Number.isFinite(number) ? shortNumber(number) : 'without bounds'}`;
  }

  /** Places the tip beside the pointer, inside the picture. */
  updateTip() {
    const {viewer, tip} = this;
    const point = viewer.hoverPoint;
    tip.hidden = point < 0 || this.moved > CLICK_MOVES && this.down.size > 0;
    if (tip.hidden) return;
    const {recording, playback} = viewer;
    const motion = playback.current[point];
    const velocity = [0, 1].map((k) => motionVelocity(recording, motion, playback.time, k) +
      (viewer.images?.rate(point, k) ?? 0));
    const pair = (x, y) => `(${shortNumber(x, 7)}, ${shortNumber(y, 7)})`;
    const name = document.createElement('b');
    name.textContent = viewer.longName(point);
    tip.replaceChildren(name, `position  ${pair(viewer.x[point], viewer.y[point])}\n` +
      `velocity  ${pair(...velocity)}\nspeed  ${shortNumber(Math.hypot(...velocity))}` +
      (recording.motionSizes === null ? '' : `\nradius  ${shortNumber(viewer.r[point], 7)}`) +
      (viewer.hidden[point] === HIDDEN ? '\nhidden: it has no power cell' : '') + this.placeText(point) +
      this.colorText(point));
    const {width, height} = viewer;
    const {x, y} = viewer.pointer;
    const left = x + TIP_OFFSET + tip.offsetWidth > width ? x - TIP_OFFSET - tip.offsetWidth :
      x + TIP_OFFSET;
    const top = y + TIP_OFFSET + tip.offsetHeight > height ? y - TIP_OFFSET - tip.offsetHeight :
      y + TIP_OFFSET;
    tip.style.transform = `translate(${Math.max(left, 4)}px, ${Math.max(top, 4)}px)`;
  }
}
