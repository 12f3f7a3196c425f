// SPDX-License-Identifier: GPL-3.0-or-later
//
// As much of a browser's 2D context as CanvasPainter uses, which writes SVG. Each path that is filled
// or stroked becomes an element.
'use strict';

const TEXT_ANCHORS = {left: 'start', center: 'middle', right: 'end'};

class SvgContext {
  constructor(width, height) {
    this.width = width;
    this.height = height;
    this.elements = [];
    this.path = [];
    this.dash = NO_DASH;
    Object.assign(this, {globalAlpha: 1, fillStyle: '#000000', strokeStyle: '#000000', lineWidth: 1,
                         lineCap: 'butt', lineJoin: 'round', font: LABEL_FONT, textAlign: 'left'});
  }

  beginPath() {
    this.path = [];
  }

  moveTo(x, y) {
    this.path.push(`M${short(x)} ${short(y)}`);
  }

  lineTo(x, y) {
    this.path.push(`L${short(x)} ${short(y)}`);
  }

  closePath() {
    this.path.push('Z');
  }

  /** Whole circles only, which begin at the right. */
  arc(x, y, radius) {
    const r = short(radius);
    this.path.pop();
    this.path.push(`M${short(x + radius)} ${short(y)}A${r} ${r} 0 1 1 ${short(x - radius)} ${short(y)}` +
                   `A${r} ${r} 0 1 1 ${short(x + radius)} ${short(y)}Z`);
  }

  rect(x, y, width, height) {
    this.path.push(`M${short(x)} ${short(y)}h${short(width)}v${short(height)}h${short(-width)}Z`);
  }

  setLineDash(dash) {
    this.dash = dash;
  }

  /** The attributes of a color: SVG has its alpha apart. */
  paint(name, color) {
    const [red, green, blue, alpha] = parseColor(color);
    const hex = [red, green, blue].map((part) => Math.round(255 * part).toString(16).padStart(2, '0'));
    const opacity = alpha * this.globalAlpha;
    return `${name}="#${hex.join('')}"${opacity < 1 ? ` ${name}-opacity="${short(opacity)}"` : ''}`;
  }

  stroke() {
    if (this.path.length === 0) return;
    const dash = this.dash.length > 0 ? ` stroke-dasharray="${this.dash.join(' ')}"` : '';
    const cap = this.lineCap === 'round' ? ' stroke-linecap="round"' : '';
    this.elements.push(`<path d="${this.path.join('')}" fill="none" ${this.paint('stroke', this.strokeStyle)} ` +
                       `stroke-width="${short(this.lineWidth)}"${dash}${cap}/>`);
  }

  fill() {
    if (this.path.length === 0) return;
    this.elements.push(`<path d="${this.path.join('')}" ${this.paint('fill', this.fillStyle)}/>`);
  }

  fillRect(x, y, width, height) {
    this.elements.push(`<rect x="${short(x)}" y="${short(y)}" width="${short(width)}" ` +
                       `height="${short(height)}" ${this.paint('fill', this.fillStyle)}/>`);
  }

  text(text, x, y, attributes) {
    const [, size, family] = this.font.match(/^(\S+)px (.*)$/);
    const escaped = text.replace(/[&<>]/g, (c) => ({'&': '&amp;', '<': '&lt;', '>': '&gt;'})[c]);
    this.elements.push(`<text x="${short(x)}" y="${short(y)}" font-size="${size}" font-family="${family}" ` +
                       `text-anchor="${TEXT_ANCHORS[this.textAlign]}" ${attributes}>${escaped}</text>`);
  }

  strokeText(text, x, y) {
    this.text(text, x, y, `fill="none" ${this.paint('stroke', this.strokeStyle)} ` +
              `stroke-width="${this.lineWidth}" stroke-linejoin="round"`);
  }

  fillText(text, x, y) {
    this.text(text, x, y, this.paint('fill', this.fillStyle));
  }

  /** The file. */
  toString() {
    const {width, height} = this;
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
      `viewBox="0 0 ${width} ${height}" stroke-linejoin="round">\n${this.elements.join('\n')}\n</svg>\n`;
  }
}

function short(number) {
  return String(Math.round(100 * number) / 100);
}
