// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of the plane that the points of a recording cover, which the cameras show initially. An
// extent is [left, bottom, right, top], and never empty.
'use strict';

const OUTLIERS = 0.02;       // share of the coordinates at each end that may be outside the picture
const TIMES_IN_MOTION = 8;   // at which an accelerated motion is sampled
const TIMES_IN_RUN = 32;     // at which all points are sampled, where the camera follows them
const MOST_SORTED = 20000;   // numbers; of more, a part that is spread evenly stands for all
const MOST_FOLLOWED = 4000;  // points whose places are looked at in a sample
const MOST_GROWTH = 1.5;     // of the extent during a run for which one extent is used

/** The extent at a time: one for the whole run, unless the points spread much. */
class Extents {
  constructor(recording) {
    this.recording = recording;
    this.whole = wholeExtent(recording);
    this.samples = [];
    if (recording.box === null && recording.periodic === null && recording.until > recording.from) this.sample();
  }

  at(time) {
    const {recording, whole, samples} = this;
    if (samples.length === 0) return whole;
    const {from, until} = recording;
    const place = (time - from) / (until - from) * TIMES_IN_RUN;
    const i = Math.min(Math.max(Math.floor(place), 0), TIMES_IN_RUN - 1);
    return samples[i].map((side, k) => side + (samples[i + 1][k] - side) * (place - i));
  }

  sample() {
    const {recording, whole} = this;
    const {from, until, points} = recording;
    const playback = new Playback(recording);
    const step = Math.ceil(points / MOST_FOLLOWED);
    const samples = [];
    let least = Infinity;
    for (let i = 0; i <= TIMES_IN_RUN; ++i) {
      playback.goTo(from + (until - from) * i / TIMES_IN_RUN);
      const xs = [], ys = [];
      let radius = 0;
      for (let point = 0; point < points; point += step) {
        const motion = playback.current[point];
        if (motion < 0 || !recording.motionThere[motion]) continue;
        xs.push(motionX(recording, motion, playback.time));
        ys.push(motionY(recording, motion, playback.time));
        radius = Math.max(radius, motionRadius(recording, motion, playback.time));
      }
      const extent = extentOf(xs, ys, radius);
      samples.push(extent);
      least = Math.min(least, Math.max(extent[2] - extent[0], extent[3] - extent[1]));
    }
    // If points appear and disappear, the camera stays: it would move back and forth.
    const areSame = recording.motions === recording.starting;
    const growth = Math.max(whole[2] - whole[0], whole[3] - whole[1]) / least;
    if (areSame && growth > MOST_GROWTH) this.samples = samples;
  }
}

/** The box, or the extent of all positions in the run. */
function wholeExtent(recording) {
  if (recording.periodic !== null) return extentOfBox(recording);
  if (recording.box !== null) {
    const [left, bottom, right, top] = recording.box;
    return extentOf([left, right], [bottom, top], 0);
  }
  const xs = new Numbers(Float64Array), ys = new Numbers(Float64Array);
  let radius = recording.radius;
  for (let i = 0; i < recording.motions; ++i) {
    radius = Math.max(radius, sampleMotion(recording, i, xs, ys));
  }
  return extentOf(xs.finish(), ys.finish(), radius);
}

/** The extent of most positions, with discs of the radius. */
function extentOf(xs, ys, radius) {
  const [left, right] = mostOf(xs), [bottom, top] = mostOf(ys);
  const extent = [left - radius, bottom - radius, right + radius, top + radius];
  for (const axis of [0, 1]) {
    const span = Math.max(extent[2] - extent[0], extent[3] - extent[1]);
    const size = extent[axis + 2] - extent[axis];
    const least = Math.max(span / 1e3, Math.abs(extent[axis]) * 1e-9) || 2;
    if (size < least) {
      extent[axis] -= least / 2;
      extent[axis + 2] += least / 2;
    } else if (size === Infinity) {
      extent[axis] /= 2;
      extent[axis + 2] /= 2;
    }
  }
  return extent;
}

/** Adds the places of the motion, and returns its greatest radius. */
function sampleMotion(recording, motion, xs, ys) {
  if (!recording.motionThere[motion]) return 0;
  const {motionRow, motionNext, rowTime, degree} = recording;
  const next = motionNext[motion];
  const begin = motionRow[motion] < 0 ? recording.from : rowTime[motionRow[motion]];
  const end = next < 0 ? recording.until : rowTime[motionRow[next]];
  const steps = degree === 1 ? 1 : TIMES_IN_MOTION;
  for (let i = 0; i <= steps; ++i) {
    const time = begin + (end - begin) * i / steps;
    xs.push(motionX(recording, motion, time));
    ys.push(motionY(recording, motion, time));
  }
  return Math.max(motionRadius(recording, motion, begin), motionRadius(recording, motion, end));
}

/** [least, greatest] of most of the numbers, with a margin. */
function mostOf(numbers) {
  if (numbers.length === 0) return [-1, 1];
  const step = Math.ceil(numbers.length / MOST_SORTED);
  const sorted = Float64Array.from({length: Math.ceil(numbers.length / step)},
                                   (_, i) => numbers[step * i]).sort();
  let least = Infinity, greatest = -Infinity;
  for (let i = 0; i < numbers.length; ++i) {
    if (numbers[i] < least) least = numbers[i];
    if (numbers[i] > greatest) greatest = numbers[i];
  }
  const last = sorted.length - 1;
  const low = sorted[Math.floor(OUTLIERS * last)], high = sorted[Math.ceil((1 - OUTLIERS) * last)];
  const room = 0.25 * (high - low);
  return [Math.max(least, low - room), Math.min(greatest, high + room)];
}
