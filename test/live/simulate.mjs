// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri simulate` with the module for JavaScript, for test/determinism/event_logs_test.py: the options
// and outputs that it uses, and no other.
//
// usage: node simulate.mjs MODULE simulate POINTS OPTION...
import {readFileSync, writeFileSync} from 'node:fs';
import {parseArgs} from 'node:util';

import {KineticDelaunay, load} from '../../live/kinetri.mjs';

const [module, , ...rest] = process.argv.slice(2);
const text = {type: 'string'}, flag = {type: 'boolean'};
const {values, positionals: [file]} = parseArgs({
  args: rest.map((word, i) => (rest[i - 1] === '--box' ? `_${word}` : word)),  // it may begin with a minus sign
  allowPositionals: true,
  options: {
    'until': text, 'audit': text, 'quiet': flag, 'threads': text, 'exact-only': flag, 'regular': flag, 'rim': flag,
    'box': text, 'collisions': text, 'radius': text,
    'events': text, 'initial-edges': text, 'edges': text, 'motions': text,
  },
});

function writeEdges(path, edges) {
  const lines = ['a,b'];
  for (let i = 0; i < edges.length; i += 2) lines.push(`${edges[i]},${edges[i + 1]}`);
  writeFileSync(path, `${lines.join('\n')}\n`);
}

await load(readFileSync(module));
const points = KineticDelaunay.read(readFileSync(file, 'utf8'), {
  box: values.box?.slice(1).split(',').map(Number),
  collisions: values.collisions,
  radius: values.radius === undefined ? undefined : Number(values.radius),
  regular: values.regular, rim: values.rim, exactOnly: values['exact-only'],
});
points.logEvents();
points.logMotions();
writeEdges(values['initial-edges'], points.edges());
points.advanceTo(Number(values.until));
const failures = points.audit();
writeEdges(values.edges, points.edges());
writeFileSync(values.events, points.takeEvents());
writeFileSync(values.motions, points.takeMotions());
if (failures.length > 0) {
  console.error(failures.join('\n'));
  process.exitCode = 1;
}
