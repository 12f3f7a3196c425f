// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Sturm sequence of the selected edge's certificate, as a table: the signs of its terms now, on both
// sides of the failure, and after all roots; their changes, V; and what follows from these.
'use strict';

const SIGN_TEXTS = {'-1': '\u2212', 0: '0', 1: '+'};

class SturmTable {
  constructor() {
    this.table = element('sturm');
    this.says = element('sturm-says');
    this.certificate = null;
    this.sequence = null;  // of the certificate; null where there is none
  }

  /** Shows the sequence of the certificate of a recording; `update` then fills in what depends on the
   * present time. */
  write(certificate, recording) {
    this.certificate = certificate;
    this.table.hidden = certificate.kind === 'none' || certificate.coefficients.length === 0;
    this.says.hidden = certificate.kind === 'none';
    this.sequence = this.table.hidden ? null : new SturmSequence(certificate.polynomial);
    if (this.sequence === null) {
      this.says.textContent = 'The zero polynomial has no Sturm sequence. It is never negative, so there is no event.';
      return;
    }
    this.columns = [{name: 'now', title: 'at the time shown', time: NaN}];
    const {row} = certificate.end;
    if (certificate.end.reason === 'edge') {
      const low = recording.rowLow[row], high = recording.rowHigh[row];
      const what = certificate.fails ? 'failure' : 'removal';
      this.columns.push(...low === high ?
        [{name: 'end', title: `at the ${what}`, time: low}] :
        [{name: 'lower', title: `at the binary64 number before the ${what}`, time: low},
         {name: 'upper', title: `at the binary64 number after the ${what}`, time: high}]);
    }
    this.columns.push({name: '\u221e', title: 'after all roots', time: Infinity});
    for (const column of this.columns.slice(1)) this.evaluate(column);
    this.build();
  }

  update(time) {
    if (this.sequence === null || this.columns[0].time === time) return;
    const [now] = this.columns;
    now.time = time;
    this.evaluate(now);
    now.cells.forEach((cell, k) => {
      cell.textContent = k < now.signs.length ? SIGN_TEXTS[now.signs[k]] : now.changes;
    });
    this.says.textContent = this.conclusions().join('\n');
  }

  evaluate(column) {
    const {origin} = this.certificate;
    column.signs = this.sequence.signsAt(column.time, origin);
    column.changes = this.sequence.changesAt(column.time, origin);
  }

  build() {
    const body = document.createElement('tbody');
    const head = this.row('', 'degree', this.columns.map(({name}) => name), 'th');
    this.columns.forEach(({title}, k) => {
      head.children[k + 2].title = title;
    });
    for (const column of this.columns) column.cells = [];
    const add = (row) => {
      this.columns.forEach((column, k) => column.cells.push(row.children[k + 2]));
      body.append(row);
    };
    this.sequence.terms.forEach((term, k) => {
      add(this.row(`f${subscript(k + 1)}`, term.length - 1,
                   this.columns.map(({signs}) => signs === undefined ? '' : SIGN_TEXTS[signs[k]])));
    });
    add(this.row('V', '', this.columns.map(({changes}) => changes ?? '')));
    const thead = document.createElement('thead');
    thead.append(head);
    this.table.replaceChildren(this.table.caption, thead, body);
  }

  row(name, degree, values, kind = 'td') {
    const row = document.createElement('tr');
    const cell = (type, text, scope) => {
      const made = document.createElement(type);
      made.textContent = text;
      if (type === 'th') made.scope = scope;
      row.append(made);
    };
    cell(kind === 'th' ? 'td' : 'th', name, 'row');
    cell(kind, degree, 'col');
    for (const value of values) cell(kind, value, 'col');
    return row;
  }

  /** Sentences: what the differences of V prove. */
  conclusions() {
    const {certificate, sequence} = this;
    const [now, ...others] = this.columns;
    const [infinity] = others.splice(-1);
    const lines = ['V is the number of sign changes in a column. It falls by one at each root of ' +
      'f\u2081, the certificate.'];
    const isBefore = others.length > 0 && now.time >= certificate.from && now.time < others[0].time;
    if (isBefore && certificate.fails) {
      const touches = now.changes - others[0].changes - (others.length === 1 ? 1 : 0);
      const text = touches === 0 ? 'no root before the failure' :
        `${touches === 1 ? 'one touch' : `${touches} touches`} before the failure`;
      lines.push(`V(now) \u2212 V(${others[0].name}) = ${now.changes - others[0].changes}: ` +
        `${others.length === 1 ? 'the failure itself, and ' : ''}${text}.`);
    }
    if (certificate.fails) lines.push(this.failureText(others));
    if (others.length === 0) {
      const roots = now.changes - infinity.changes;
      lines.push(`V(now) \u2212 V(\u221e) = ${roots}: ` + (roots === 0 ?
        'with these motions it never fails.' :
        `with these motions it has ${roots === 1 ? 'one root' : `${roots} roots`} after now.`));
    }
    lines.push(sequence.hasMultipleRoots ?
      'The last term is no constant: its roots are the multiple roots of f\u2081. At a root of even ' +
      'multiplicity the certificate touches zero and is positive before and after. Two flips there ' +
      'would undo each other: a touch is no event.' :
      'The last term is a constant: f\u2081 has no multiple root, and so no touch.');
    return lines;
  }

  failureText(columns) {
    const {polynomial, origin} = this.certificate;
    if (columns.length === 1) {
      const multiplicity = multiplicityAt(polynomial, columns[0].time, origin);
      return multiplicity === 0 ? '' : `At the end f\u2081 has a root of multiplicity ${multiplicity}, ` +
        `${multiplicity % 2 === 0 ? 'even: a touch' : 'odd: the failure'}.`;
    }
    const roots = columns[0].changes - columns[1].changes;
    return `V(lower) \u2212 V(upper) = ${roots}: ` + (roots === 1 ?
      'exactly one root between these two, the failure.' :
      `${roots} roots between two consecutive binary64 numbers; the failure is one of them.`);
  }
}

function subscript(k) {
  return String(k).replace(/\d/g, (digit) =>
    '\u2080\u2081\u2082\u2083\u2084\u2085\u2086\u2087\u2088\u2089'[digit]);
}
