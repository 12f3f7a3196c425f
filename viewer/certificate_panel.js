// SPDX-License-Identifier: GPL-3.0-or-later
//
// The panel of the selected edge: its certificate as a plot over time and in digits, and the event
// that ends it. The signs that it shows are exact (exact.js).
'use strict';

const SIGNS = {'-1': 'negative', 0: 'zero', 1: 'positive'};
const PLOT_POINTS = 240;
const BEYOND = 0.12;  // share of the certificate's time that the plot adds on either side

class CertificatePanel {
  constructor(viewer) {
    this.viewer = viewer;
    this.root = element('certificate');
    this.title = element('certificate-title');
    this.says = element('certificate-says');
    this.plot = element('plot');
    this.facts = element('certificate-facts');
    this.shown = null;  // the certificate that the facts are of
    this.sturm = new SturmTable();
    this.now = null;    // the element that says the present value
    this.facts.addEventListener('click', (event) => {
      const row = event.target.closest('button')?.dataset.row;
      if (row !== undefined) viewer.goToRow(Number(row));
    });
  }

  update() {
    const {certificate, selected, playback} = this.viewer;
    this.root.hidden = selected < 0;
    if (selected < 0) {
      this.shown = null;
      return;
    }
    if (this.shown !== certificate) {
      this.shown = certificate;
      this.write(certificate);
      this.sturm.write(certificate, this.viewer.recording);
    }
    const isThere = playback.where[selected] >= 0;
    this.says.textContent = isThere ? this.meaning(certificate) :
      'This edge is not there at the time shown. Below is its last certificate.';
    if (certificate.kind === 'none') return;
    const sign = signAt(certificate.polynomial, playback.time, certificate.origin);
    const value = evaluate(certificate.coefficients, playback.time - certificate.origin);
    this.now.textContent = sign === 0 ? 'zero, exactly' :
      `${SIGNS[sign]} (about ${shortNumber(value, 4)})`;
    this.sturm.update(playback.time);
    this.drawPlot(certificate);
  }

  meaning({kind, a, b, left, right, offsets}) {
    const name = (point, k) =>
      this.viewer.pointName(point) + (offsets === undefined ? '' : offsetText(...offsets[k]));
    if (kind === 'in-circle') {
      const isWeighted = this.viewer.recording.motionSizes !== null;
      const names = [a, b, left, right].map(name), corners = `${names[0]}, ${names[1]} and ${names[2]}`;
      return `Opposite corners ${names[2]} and ${names[3]}. The edge is ` +
        `${isWeighted ? 'regular' : 'Delaunay'} while ` +
        `\u2212in-circle(${names.join(', ')}) is positive: ` + (isWeighted ?
        `at the place of equal power to ${corners}, the power to ${names[3]} is greater.` :
        `while ${names[3]} is outside the circle through ${corners}.`);
    }
    if (kind === 'orientation') {
      const corners = left >= 0 ? [a, b, left] : [b, a, right];
      return `An edge of the convex hull. It stays one while orientation(` +
        `${corners.map(name).join(', ')}) is positive: while ${name(corners[2])} is on its inner ` +
        'side.';
    }
    return 'All points are collinear. This edge has no triangle; it changes only when two points ' +
      'meet.';
  }

  write(certificate) {
    const {kind, coefficients, origin} = certificate;
    this.title.textContent = `Edge ${edgeName(this.viewer, certificate.edge)}`;
    this.facts.replaceChildren();
    this.plot.hidden = kind === 'none';
    if (kind !== 'none') this.now = this.fact('Sign now', '');
    if (this.viewer.recording.thinned !== null) {
      this.fact('Note', 'this recording leaves out events: between two recorded instants the ' +
                'edge may have had other corners');
    }
    this.fact('Since', ...this.limitText(certificate.begin, false));
    this.fact('Until', ...this.limitText(certificate.end, true));
    this.writeFailure(certificate);
    if (kind === 'none') return;
    const {lifting} = certificate.polynomial;
    if (lifting > 0) {
      this.fact('Note', 'the in-circle determinant is zero at all times; with ' +
        `${['x y', 'x\u00b2', 'y\u00b2'][lifting - 1]} in its last column it decides which diagonal ` +
        'is the edge');
    }
    this.fact('Degree', coefficients.length === 0 ? 'identically zero' :
              `${coefficients.length - 1} in s = t \u2212 t\u2080`);
    this.fact('t\u2080', this.digits([String(origin)]));
    this.fact('Coefficients', this.digits(coefficients.map((c, k) =>
      `s${superscript(k)}  ${c < 0 ? '' : ' '}${c}`)));
  }

  limitText({row, reason}, isEnd) {
    const {recording} = this.viewer;
    if (row < 0) return [isEnd ? 'the end of the recording' : 'the start of the recording'];
    const event = this.link(row);
    const time = ` at t \u2248 ${shortNumber(recording.rowTime[row], 9)}`;
    if (reason === 'edge') {
      return isEnd ? ['removed by ', event, time] : ['added by ', event, time];
    }
    if (reason === 'motion') return ['a corner has a new motion, ', event, time];
    return [isEnd ? 'its corners change before it fails, ' : 'its corners changed with ', event,
            time];
  }

  /** The event that removes the edge. Its isolating interval is shown if the edge has this
   * certificate until then; otherwise another certificate fails, and only the time is shown. */
  writeFailure(certificate) {
    const {recording} = this.viewer;
    const row = certificate.removal;
    if (certificate.end.reason !== 'edge' || row < 0) {
      if (row >= 0) {
        this.fact('Edge removed', 'later, by ', this.link(row),
                  ` at t \u2248 ${shortNumber(recording.rowTime[row], 9)}`);
      }
      return;
    }
    const low = recording.rowLow[row], high = recording.rowHigh[row];
    const term = certificate.fails ? 'Fails' : 'Removed';
    if (low === high) {
      this.fact(term, 'exactly at', this.digits([String(low)], 'interval'));
    } else {
      this.fact(term, 'between two consecutive binary64 numbers',
                this.digits([`[${low},`, ` ${high}]`], 'interval'));
    }
    if (certificate.kind === 'none') return;
    const signs = [low, high].map((t) => signAt(certificate.polynomial, t, certificate.origin));
    const text = low === high ? `the certificate is ${SIGNS[signs[0]]} there` :
      `${SIGNS[signs[0]]} at the lower one, ${SIGNS[signs[1]]} at the upper one`;
    this.fact('Signs there', `${text} (exact)`);
  }

  fact(term, ...parts) {
    const dt = document.createElement('dt'), dd = document.createElement('dd');
    dt.textContent = term;
    dd.append(...parts);
    this.facts.append(dt, dd);
    return dd;
  }

  digits(lines, id) {
    const span = document.createElement('span');
    span.className = 'digits';
    if (id !== undefined) span.id = id;
    span.style.whiteSpace = 'pre-wrap';
    span.textContent = lines.join('\n');
    return span;
  }

  link(row) {
    const {recording} = this.viewer;
    const button = document.createElement('button');
    button.className = 'link';
    button.dataset.row = row;
    button.textContent = `${kindName(recording, row)} ${eventNumber(recording, row)}`;
    button.title = `${changeText(this.viewer, row)}: go there`;
    return button;
  }

  drawPlot(certificate) {
    const {viewer, plot} = this;
    const {colors, playback} = viewer;
    const width = plot.clientWidth, height = plot.clientHeight;
    const context = sizedContext(plot, width, height);
    context.clearRect(0, 0, width, height);
    const life = certificate.until - certificate.from;
    const beyond = life > 0 ? BEYOND * life : 1;
    const first = certificate.from - beyond, last = certificate.until + beyond;
    const values = new Float64Array(PLOT_POINTS + 1);
    let least = 0, greatest = 0;
    for (let i = 0; i <= PLOT_POINTS; ++i) {
      const time = first + (last - first) * i / PLOT_POINTS;
      values[i] = evaluate(certificate.coefficients, time - certificate.origin);
      if (time < certificate.from || time > certificate.until) continue;
      least = Math.min(least, values[i]);
      greatest = Math.max(greatest, values[i]);
    }
    const spread = greatest - least || 1;
    least -= 0.22 * spread;
    greatest += 0.1 * spread;
    const bottom = height - 20;
    const scale = {
      x: (time) => (time - first) / (last - first) * width,
      y: (value) => bottom - (value - least) / (greatest - least) * (bottom - 4),
      bottom, width, first, last,
    };
    this.drawAxes(context, scale, certificate);
    context.save();
    context.beginPath();
    context.rect(0, 0, width, bottom);
    context.clip();
    this.drawCurve(context, scale, values, certificate);
    context.restore();
    this.drawMarks(context, scale, certificate);
    plot.setAttribute('aria-label', `The certificate from ${shortNumber(certificate.from)} to ` +
      `${shortNumber(certificate.until)}; at ${shortNumber(playback.time)}, the time shown, it is ` +
      this.now.textContent);
  }

  drawAxes(context, scale, certificate) {
    const {colors} = this.viewer;
    const begin = scale.x(certificate.from), end = scale.x(certificate.until);
    context.fillStyle = colors.hover;
    context.fillRect(0, 0, begin, scale.bottom);
    context.fillRect(end, 0, scale.width - end, scale.bottom);
    context.strokeStyle = colors.quiet;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(0, scale.y(0));
    context.lineTo(scale.width, scale.y(0));
    context.stroke();
    context.fillStyle = colors.quiet;
    context.font = '11px system-ui, sans-serif';
    context.textAlign = 'left';
    context.fillText('0', 3, scale.y(0) - 4);
    context.fillText(shortNumber(certificate.from, 5), Math.max(begin, 2), scale.bottom + 14);
    context.textAlign = 'right';
    context.fillText(shortNumber(certificate.until, 5), Math.min(end, scale.width - 2),
                     scale.bottom + 14);
  }

  /** The curve: solid while the edge has this certificate, dashed before and after. */
  drawCurve(context, scale, values, certificate) {
    const {colors} = this.viewer;
    const begin = scale.x(certificate.from), end = scale.x(certificate.until);
    for (const [from, to, dashes] of [[0, begin, [3, 4]], [end, scale.width, [3, 4]],
                                      [begin, end, []]]) {
      context.save();
      context.beginPath();
      context.rect(from, 0, to - from, scale.bottom);
      context.clip();
      context.beginPath();
      for (let i = 0; i <= PLOT_POINTS; ++i) {
        context.lineTo(scale.width * i / PLOT_POINTS, scale.y(values[i]));
      }
      context.strokeStyle = dashes.length > 0 ? colors.quiet : colors.added;
      context.lineWidth = dashes.length > 0 ? 1.2 : 2.5;
      context.setLineDash(dashes);
      context.stroke();
      context.restore();
    }
  }

  drawMarks(context, scale, certificate) {
    const {colors, playback, recording} = this.viewer;
    if (certificate.fails) {
      const x = scale.x(recording.rowTime[certificate.end.row]), y = scale.y(0);
      context.fillStyle = colors.removed;
      context.beginPath();  // a diamond
      context.moveTo(x - 6, y);
      context.lineTo(x, y - 6);
      context.lineTo(x + 6, y);
      context.lineTo(x, y + 6);
      context.fill();
    }
    const now = Math.min(Math.max(scale.x(playback.time), 1), scale.width - 1);
    context.strokeStyle = colors.selected;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(now, 0);
    context.lineTo(now, scale.bottom);
    context.stroke();
    const s = playback.time - certificate.origin;
    const y = scale.y(evaluate(certificate.coefficients, s));
    if (!(y >= 0 && y <= scale.bottom) || scale.x(playback.time) !== now) return;
    context.fillStyle = colors.selected;
    context.beginPath();
    context.arc(now, y, 4, 0, 2 * Math.PI);
    context.fill();
  }
}

function superscript(k) {
  return String(k).replace(/\d/g, (digit) =>
    '\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079'[digit]);
}
