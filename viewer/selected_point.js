// SPDX-License-Identifier: GPL-3.0-or-later
//
// The selected point: which it is, its edges at the time shown, and whether the camera follows it.
'use strict';

class SelectedPoint {
  constructor(viewer) {
    this.viewer = viewer;
    this.id = -1;             // -1: none
    this.edges = [];          // at the time shown
    this.event = -1;          // of the playback when the edges were found
    this.follows = false;     // whether the camera follows it
    this.showsTrail = false;  // whether its whole trail is shown
  }

  /** Selects the point; -1 selects none. */
  select(point) {
    const {viewer} = this;
    this.id = point;
    this.event = -1;
    if (point >= 0) viewer.select(-1);
    else this.follows = this.showsTrail = false;
    viewer.showSelected();
    if (viewer.filter.point >= 0 && viewer.filter.point !== point) {
      viewer.filter.point = -1;
      viewer.filterChanged();
    }
    viewer.requestFrame();
  }

  /** Selects the point next to the middle of the picture, or if one is selected, that with the next id
   * (step 1) or the one before (-1), of those that are there. */
  selectNext(step) {
    const {viewer} = this;
    const {points} = viewer.recording;
    if (this.id < 0) {
      this.select(viewer.view.pointAt(viewer.width / 2, viewer.height / 2, Infinity));
      return;
    }
    for (let i = 1; i <= points; ++i) {
      const point = (((this.id + i * step) % points) + points) % points;
      if (Number.isNaN(viewer.x[point])) continue;
      this.select(point);
      return;
    }
  }

  /** Selects the point of this id or name, or whose name begins so, and shows it. Returns whether there
   * is one. */
  find(text) {
    const {viewer} = this;
    const {names, points} = viewer.recording;
    const wanted = text.trim(), lower = wanted.toLowerCase();
    const byName = (fits) => (names === null ? -1 : names.findIndex((name) => fits(String(name).toLowerCase())));
    let point = byName((name) => name === lower);
    if (point < 0 && /^\d+$/.test(wanted) && Number(wanted) < points) point = Number(wanted);
    if (point < 0 && lower !== '') point = byName((name) => name.startsWith(lower));
    if (point < 0) return false;
    this.select(point);
    return true;
  }

  toggleFollowing() {
    this.follows = !this.follows && this.id >= 0;
    this.viewer.requestFrame();
  }

  toggleTrail() {
    this.showsTrail = !this.showsTrail && this.id >= 0;
    this.viewer.requestFrame();
  }

  /** Finds the edges at the time shown, and moves the camera. */
  update() {
    const {viewer, id} = this;
    const {playback, recording} = viewer;
    if (id < 0) {
      this.edges = [];
    } else if (this.event !== playback.event) {
      this.event = playback.event;
      this.edges = Array.from(playback.live.subarray(0, playback.liveCount)).filter((edge) =>
        recording.edgeA[edge] === id || recording.edgeB[edge] === id);
    }
    if (this.follows) viewer.flatView.center(id);
  }

  /** The other end of an edge of the point. */
  neighborAt(edge) {
    const {edgeA, edgeB} = this.viewer.recording;
    return edgeA[edge] === this.id ? edgeB[edge] : edgeA[edge];
  }
}
