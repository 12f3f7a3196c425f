// SPDX-License-Identifier: GPL-3.0-or-later
//
// The dialog that exports the picture as PNG or SVG, a span of time as WebM, and a link that opens the
// same view.
'use strict';

const PNG_RATIO = 2;         // pixels per CSS pixel, at least
const FILM_RATE = 30;        // frames per second
const FILM_BITS = 8e6;       // per second
const FILM_SLICE = 100;      // milliseconds, after which the encoder hands over what it has
const FILM_TYPES = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm'];

class Exporter {
  constructor(viewer) {
    this.viewer = viewer;
    this.dialog = element('export');
    this.says = element('export-says');
    this.film = null;
    this.span = null;  // of the recording, as it was last offered
    const run = {png: () => this.savePng(), svg: () => this.saveSvg(), link: () => this.copyLink(),
                 film: () => this.toggleFilm()};
    for (const [name, action] of Object.entries(run)) {
      element(`save-${name}`).addEventListener('click', () => {
        Promise.resolve().then(action).catch((error) => this.say(`This has failed: ${error.message}`));
      });
    }
    element('link').addEventListener('focus', () => element('link').select());
    this.offerSpan();
  }

  /** Offers the whole recording for a film, again if it has grown. */
  offerSpan() {
    const {from, until} = this.viewer.recording;
    element('save-film').disabled = this.filmType() === undefined || from === until;
    if (this.span === `${from} ${until}`) return;
    this.span = `${from} ${until}`;
    element('film-from').value = from;
    element('film-until').value = until;
  }

  toggle() {
    if (this.dialog.open) {
      this.dialog.close();
      return;
    }
    this.say('');
    this.offerSpan();
    element('link').value = linkTo(this.viewer);
    this.dialog.showModal();
  }

  say(text) {
    this.says.textContent = text;
  }

  /** Draws the picture, and the scale of its colors, with a painter. */
  drawWith(painter, ratio) {
    const {viewer} = this;
    const {width, height} = viewer;
    painter.begin(width, height, ratio, viewer.colors.background);
    viewer.view.draw(painter);
    const {axisLeft, axisBottom} = viewer.flatView;
    drawLegendScale(painter, viewer, 14 + axisLeft, height - 12 - axisBottom);
    painter.end();
  }

  /** A canvas with the picture. */
  canvas(ratio) {
    const canvas = document.createElement('canvas');
    const {width, height} = this.viewer;
    const context = canvas.getContext('2d');
    const draw = () => {
      sizedContext(canvas, width, height, ratio);
      this.drawWith(painter, ratio);
    };
    const painter = new CanvasPainter(context);
    return {canvas, draw};
  }

  async savePng() {
    const {canvas, draw} = this.canvas(Math.max(PNG_RATIO, window.devicePixelRatio));
    draw();
    const blob = await new Promise((done) => canvas.toBlob(done, 'image/png'));
    this.save(blob, 'png');
  }

  saveSvg() {
    const {width, height} = this.viewer;
    const context = new SvgContext(width, height);
    this.drawWith(new CanvasPainter(context), 1);
    this.save(new Blob([context.toString()], {type: 'image/svg+xml'}), 'svg');
  }

  save(blob, suffix) {
    if (blob === null || blob.size === 0) throw new Error('the browser made no picture');
    const {recording, playback} = this.viewer;
    const name = (recording.title || 'kinetri').replace(/\.[^.]*$/, '').replace(/[^\w.-]+/g, '_');
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = `${name}-t${playback.time.toPrecision(6).replace(/\.?0+$/, '')}.${suffix}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60e3);
    this.saved = blob;
    this.say(`Saved as ${link.download}.`);
  }

  async copyLink() {
    element('link').select();
    try {
      await navigator.clipboard.writeText(element('link').value);
      this.say('The link is copied.');
    } catch {
      this.say('Copy the link from the field: this page may not use the clipboard.');
    }
  }

  filmType() {
    return typeof MediaRecorder === 'undefined' ? undefined :
      FILM_TYPES.find((type) => MediaRecorder.isTypeSupported(type));
  }

  toggleFilm() {
    if (this.film !== null) {
      this.film.stop();
      return;
    }
    const {viewer} = this;
    const [from, until, seconds] = ['from', 'until', 'seconds'].map((name) => Number(element(`film-${name}`).value));
    const {recording} = viewer;
    if (!(from >= recording.from && until <= recording.until && from < until && seconds > 0)) {
      throw new Error(`expected times from ${recording.from} to ${recording.until} in order, and some seconds`);
    }
    const {canvas, draw} = this.canvas(1);
    draw();
    const chunks = [];
    const recorder = new MediaRecorder(canvas.captureStream(FILM_RATE),
                                       {mimeType: this.filmType(), videoBitsPerSecond: FILM_BITS});
    let isEncoding = false;
    recorder.addEventListener('dataavailable', ({data}) => {
      chunks.push(data);
      isEncoding ||= data.size > 0;
    });
    recorder.addEventListener('stop', () => {
      this.film = null;
      element('save-film').textContent = 'Record WebM';
      this.save(new Blob(chunks, {type: 'video/webm'}), 'webm');
    });
    this.film = recorder;
    element('save-film').textContent = 'Stop';
    recorder.start(FILM_SLICE);
    viewer.direction = 0;
    let last = performance.now(), done = 0;
    const frame = (now) => {
      if (recorder.state === 'inactive') return;
      // After a pause of the browser the film goes on where it was.
      // Time passes only once a frame is encoded: a busy browser may take longer for the first one than a
      // short film lasts.
      if (isEncoding) done += Math.min(Math.max((now - last) / 1000, 0), LONGEST_FRAME);
      last = now;
      const share = Math.min(done / seconds, 1);
      viewer.goTo(from + (until - from) * share);
      viewer.place();
      draw();
      this.say(`Recording: ${Math.round(100 * share)} %`);
      if (share < 1) requestAnimationFrame(frame);
      else recorder.stop();
    };
    requestAnimationFrame(frame);
  }
}
