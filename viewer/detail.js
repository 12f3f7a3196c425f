// SPDX-License-Identifier: GPL-3.0-or-later
//
// The level of detail: how large dots and how strong edges are, so that they can be told apart. It
// goes by the distance of neighboring points on the screen, if the points in view were spread
// evenly.
'use strict';

const LEAST_DOT = 0.5, GREATEST_DOT = 4.5;   // radii, in pixels
const FAINTEST_DOT = 0.25;
const DOTS_APART = 9;                        // radii of a dot between neighbors
const EDGES_FADE = 5.5, EDGES_VANISH = 2.6;  // distances of neighbors, in pixels
const ROOM_BEHIND = 3;
const MOST_CELLS = 2000, MOST_CELLS_WEBGL = 100000;  // in view, that are filled
const LEAST_WIDTH = 0.7, GREATEST_WIDTH = 1.4;

class Detail {
  constructor() {
    this.spacing = Infinity;
    this.inView = 0;
  }

  /** Of a flat view with `inView` points in the picture. */
  measure({width, height, camera}, inView) {
    // The part of the screen in which there may be points.
    const [left, bottom, right, top] = camera.extent;
    const span = (a, b, room) => Math.max(Math.min(b, room) - Math.max(a, 0), 1);
    const area = span(camera.screenX(left), camera.screenX(right), width) *
      span(camera.screenY(top), camera.screenY(bottom), height);
    this.inView = inView;
    this.spacing = Math.sqrt(area / (inView + 1));
  }

  dotRadius() {
    return Math.min(GREATEST_DOT, Math.max(LEAST_DOT, this.spacing / DOTS_APART));
  }

  /** Up to 1. Dots that nearly touch are fainter. */
  dotStrength() {
    return Math.min(1, Math.max(FAINTEST_DOT, this.spacing / 4));
  }

  /** From 0 (edges would cover each other) to 1. Edges behind other lines fade earlier. */
  edgeStrength(isBehind = false) {
    const spacing = isBehind ? this.spacing / ROOM_BEHIND : this.spacing;
    const share = (spacing - EDGES_VANISH) / (EDGES_FADE - EDGES_VANISH);
    return Math.min(Math.max(share, 0), 1);
  }

  /** Whether there is room, and time, to fill the cells. */
  showsCells(painter) {
    return this.inView <= (painter instanceof WebGLPainter ? MOST_CELLS_WEBGL : MOST_CELLS);
  }

  lineWidth() {
    return Math.min(GREATEST_WIDTH, Math.max(LEAST_WIDTH, this.spacing / 14));
  }
}
