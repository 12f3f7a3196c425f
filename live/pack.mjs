// SPDX-License-Identifier: GPL-3.0-or-later
//
// usage: node pack.mjs MODULE OUTPUT
//
// Writes the module as text for a page: deflated, in base64 (`unpacked` in live.js).
import {readFileSync, writeFileSync} from 'node:fs';
import {deflateRawSync} from 'node:zlib';

const [module, output] = process.argv.slice(2);
writeFileSync(output, deflateRawSync(readFileSync(module), {level: 9}).toString('base64'));
